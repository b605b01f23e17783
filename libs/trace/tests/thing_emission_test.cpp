/// What a thing sends out, against closed forms; and the SPHL that shines in its place, against the thing.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/thing_alone.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/thing_emission.h>

#include "error_message.h"

namespace ssphh::trace {
namespace {

using glm::dvec3;
using test::message_of;

int add_node(scene::Scene& s, const std::string& name, const scene::Transform& local, int parent = -1) {
  scene::Node node;
  node.name = name, node.parent = parent, node.local = local;
  s.nodes.push_back(node);
  return static_cast<int>(s.nodes.size()) - 1;
}

void add_mesh(scene::Scene& s, scene::Mesh mesh, const vec3& albedo, const vec3& emission, int node) {
  scene::Material material;
  material.base_color = albedo, material.specular = 0, material.emission = emission;
  s.materials.push_back(material);
  mesh.material = static_cast<int>(s.materials.size()) - 1;
  s.meshes.push_back(std::move(mesh));
  s.instances.push_back({static_cast<int>(s.meshes.size()) - 1, node, -1, ""});
}

scene::Transform placed(const vec3& at, float turn = 0) {
  return {at, glm::angleAxis(turn, glm::normalize(vec3(1, 2, 0.5f))), vec3(1)};
}

TEST(ThingEmission, OfAGlowingBallIsItsDiscTimesItsRadianceInAllDirections) {
  scene::Scene s;
  const int node = add_node(s, "ball", placed({3, 1, -2}, 0.7f));
  const vec3 radiance(5, 3, 1);
  add_mesh(s, scene::make_sphere(0.5f, 128, 64), vec3(0), radiance, node);
  const ThingEmission seen = thing_emission(s, node, 0, {.degree = 4, .image_size = 16});
  const float intensity = pi * 0.25f * 5;
  // Of 200 pixels 50 lie at the edge, where paths hit or miss: with 16 each 0.4 % of one direction's light,
  // and a tenth of that of all directions'
  EXPECT_NEAR(seen.intensity[0].x / std::sqrt(4 * pi), intensity, 2e-3f * intensity);
  EXPECT_NEAR(seen.intensity[0].y / seen.intensity[0].x, 0.6f, 1e-4f);
  EXPECT_NEAR(seen.intensity[0].z / seen.intensity[0].x, 0.2f, 1e-4f);
  for (int k = 1; k < 25; ++k) EXPECT_NEAR(seen.intensity[k].x, 0, 0.01f * intensity) << k;
  EXPECT_LT(glm::length(seen.center), 1e-3f);
  EXPECT_NEAR(seen.radius, 0.5f, 1e-3f);
}

// Red above, blue below: E = L · area times the clamped cosines, whose coefficients are known.
TEST(ThingEmission, OfTwoGlowingSquaresBackToBackHasTheirLobesInTheNodesAxes) {
  scene::Scene s;
  const int node = add_node(s, "panel", placed({-1, 0, 4}, 1.1f));
  add_mesh(s, scene::make_quad({-0.1f, 0.001f, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}), vec3(0), {6, 0, 0}, node);
  add_mesh(s, scene::make_quad({-0.1f, -0.001f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}), vec3(0), {0, 0, 2},
           node);
  const ThingEmission seen = thing_emission(s, node, 0, {.degree = 3});
  const float area = 0.04f, least = 0.01f * 6 * area;
  EXPECT_NEAR(seen.intensity[0].x, 6 * area * std::sqrt(pi) / 2, least);
  EXPECT_NEAR(seen.intensity[1].x, 6 * area * std::sqrt(pi / 3), least);
  EXPECT_NEAR(seen.intensity[0].z, 2 * area * std::sqrt(pi) / 2, least);
  EXPECT_NEAR(seen.intensity[1].z, -2 * area * std::sqrt(pi / 3), least);
  for (const int k : {2, 3, 4, 5, 7}) EXPECT_NEAR(seen.intensity[k].x, 0, least) << k;
  EXPECT_EQ(seen.intensity[0].y, 0);
  EXPECT_LT(glm::length(seen.center), 2e-3f);
}

TEST(ThingEmission, OfLampsIsTheirOwnWhereNothingHidesThem) {
  scene::Scene s;
  const int node = add_node(s, "lantern", placed({0, 5, 0}));
  scene::Light bulb;
  bulb.node = add_node(s, "bulb", placed({0.3f, 0, 0}), node);
  bulb.color = {1, 0.5f, 0.25f}, bulb.intensity = 8, bulb.range = 2;
  s.lights.push_back(bulb);
  const ThingEmission free = thing_emission(s, node, 0, {.degree = 5});
  EXPECT_NEAR(free.intensity[0].x / std::sqrt(4 * pi), 8, 1e-3f);
  EXPECT_NEAR(free.intensity[0].z / std::sqrt(4 * pi), 2, 1e-3f);
  for (int k = 1; k < 36; ++k) EXPECT_NEAR(free.intensity[k].x, 0, 1e-3f) << k;
  EXPECT_LT(glm::distance(free.center, vec3(0.3f, 0, 0)), 1e-4f);
  EXPECT_EQ(free.radius, 0.1f);
  // A black plate that spans the half space of −x, but for what lies beyond its edge
  add_mesh(s, scene::make_quad({0, -50, -50}, {0, 100, 0}, {0, 0, 100}), vec3(0), vec3(0), node);
  const ThingEmission half = thing_emission(s, node, 0, {.degree = 5, .image_size = 8});
  EXPECT_NEAR(half.intensity[0].x / std::sqrt(4 * pi), 4, 0.1f);
  EXPECT_GT(half.intensity[3].x, 0);
}

/// A lantern: a small panel, red on one side and blue on the other, a ball that is lit by it and an arm that
/// holds it; in a room of other colours.
scene::Scene lantern_in_room(int& node, float& radius) {
  scene::Scene s;
  const int world = add_node(s, "room", {});
  scene::Mesh room = scene::make_box({-2, -1.5f, -2}, {2, 1.5f, 2});
  for (uvec3& t : room.triangles) std::swap(t.y, t.z);
  for (vec3& n : room.normals) n = -n;
  add_mesh(s, room, {0.5f, 0.6f, 0.4f}, vec3(0), world);
  node = add_node(s, "lantern", placed({0.2f, 0.1f, -0.3f}, 0.9f));
  add_mesh(s, scene::make_quad({-0.04f, 0.001f, 0.04f}, {0.08f, 0, 0}, {0, 0, -0.08f}), vec3(0.3f),
           {60, 20, 5}, node);
  add_mesh(s, scene::make_quad({-0.04f, -0.001f, -0.04f}, {0.08f, 0, 0}, {0, 0, 0.08f}), vec3(0.3f),
           {4, 10, 40}, node);
  scene::Mesh ball = scene::make_sphere(0.05f);
  for (vec3& p : ball.positions) p += vec3(0.15f, 0.1f, 0);
  add_mesh(s, ball, {0.8f, 0.8f, 0.2f}, vec3(0), node);
  add_mesh(s, scene::make_box({-0.3f, -0.01f, -0.01f}, {-0.05f, 0.01f, 0.01f}), vec3(0.4f), vec3(0), node);
  scene::validate(s);
  radius = 0.32f;
  return s;
}

/// What the thing sends out, at `node` in place of all that glows there.
scene::Scene stand_in_for(const scene::Scene& lit, const ThingEmission& seen, int node) {
  scene::Scene s = lit;
  for (scene::Material& material : s.materials) material.emission = vec3(0);
  scene::Light& light = s.lights.emplace_back();
  light.type = scene::LightType::sphl, light.radius = seen.radius;
  light.emission.frames = {seen.intensity};
  light.node = add_node(s, "light", {seen.center, quat(1, 0, 0, 0), vec3(1)}, node);
  return s;
}

/// Points of the inside of a box, in all directions from `center`.
std::vector<rays::SurfacePoint> points_of_walls(const vec3& center, const vec3& min, const vec3& max) {
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 200; ++i) {
    const vec3 d = spherical_fibonacci(i, 200);
    vec3 ways;
    for (int c = 0; c < 3; ++c)
      ways[c] =
          ((d[c] > 0 ? max : min)[c] - center[c]) / std::copysign(std::max(std::abs(d[c]), 1e-6f), d[c]);
    const int axis = ways.x < ways.y ? (ways.x < ways.z ? 0 : 2) : (ways.y < ways.z ? 1 : 2);
    vec3 normal(0);
    normal[axis] = d[axis] > 0 ? -1.0f : 1.0f;
    points.push_back({center + ways[axis] * d, normal});
  }
  return points;
}

/// Of the SPHL's irradiance: r.m.s. error over r.m.s., the noise of the thing's taken off, and the mean's
/// error.
struct Difference {
  dvec3 rms{0}, mean{0};
};

Difference difference(const std::vector<rays::IrradianceEstimate>& thing,
                      const std::vector<rays::IrradianceEstimate>& sphl) {
  dvec3 sum(0), sum2(0), less(0), less2(0);
  for (std::size_t i = 0; i < thing.size(); ++i) {
    const dvec3 a(thing[i].direct + thing[i].indirect), b(sphl[i].direct + sphl[i].indirect);
    sum += a, sum2 += a * a, less += b - a, less2 += (b - a) * (b - a) - dvec3(thing[i].indirect_variance);
  }
  return {glm::sqrt(glm::max(less2, 0.0) / sum2), less / sum};
}

TEST(ThingEmission, LightsWallsAsTheThingItselfBeyondTwoOfItsRadii) {
  int node = 0;
  float radius = 0;
  const scene::Scene lit = lantern_in_room(node, radius);
  // Paths start anywhere within a pixel: fewer pixels are as true, and noisier
  const ThingEmission seen = thing_emission(lit, node, 0, {.image_size = 16});
  EXPECT_LT(seen.radius, radius);
  const scene::Scene stand_in = stand_in_for(lit, seen, node);
  const vec3 center(scene::world_matrices(lit)[node] * vec4(seen.center, 1));
  const auto points = points_of_walls(center, {-2, -1.5f, -2}, {2, 1.5f, 2});
  for (const rays::SurfacePoint& point : points) EXPECT_GT(glm::distance(point.position, center), 2 * radius);
  rays::PathParams path{.max_depth = 8, .spp = 1024};
  // Walls that reflect nothing: what arrives left the thing, perhaps by its ball.
  const auto with_walls = [](scene::Scene s, const vec3& albedo) {
    s.materials[0].base_color = albedo;
    return s;
  };
  const scene::Scene dark = with_walls(lit, vec3(0)), dark_stand_in = with_walls(stand_in, vec3(0));
  auto thing = PathTracer(dark).surface_irradiance(points, path, {});
  auto sphl = PathTracer(dark_stand_in).surface_irradiance(points, path, {});
  const Difference alone = difference(thing, sphl);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(alone.rms[c], 0.05) << c;
    EXPECT_LT(std::abs(alone.mean[c]), 0.02) << c;
  }
  // All of it, bounces from the walls and from the thing, which stands there dark, included
  path.spp = 256;
  thing = PathTracer(lit).surface_irradiance(points, path, {});
  sphl = PathTracer(stand_in).surface_irradiance(points, path, {});
  const Difference all = difference(thing, sphl);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(all.mean[c], 0, 0.05) << c;
}

/// Irradiance of `point` by what is within a ball, from a picture of it: paths that set out for it.
dvec3 irradiance_by_view(const PathTracer& tracer, const rays::SurfacePoint& point, const vec3& center,
                         float radius, const rays::PathParams& path) {
  constexpr int size = 16;
  const vec3 to = glm::normalize(center - point.position);
  const float half = radius / glm::distance(center, point.position),
              slope = half / std::sqrt(1 - half * half);
  const Frame frame = Frame::around(-to);
  RenderParams view;
  view.width = view.height = size;
  view.camera.camera.yfov = 2 * std::atan(slope);
  view.camera.world =
      mat4(vec4(frame.x, 0), vec4(frame.y, 0), vec4(-to, 0), vec4(point.position + 1e-3f * point.normal, 1));
  view.path = path;
  RenderState state;
  tracer.render(view, state, {});
  const image::Image picture = resolve(state.color, state.passes_done);
  dvec3 sum(0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const vec2 at = slope * ((vec2(x, y) + 0.5f) * (2.0f / size) - 1.0f);
      const vec3 ray = to + at.x * frame.x - at.y * frame.y;
      const float length = glm::length(ray), pixel = 4 * slope * slope / (size * size);
      sum += dvec3(picture.rgb(x, y)) *
             static_cast<double>(pixel * glm::dot(ray, point.normal) / std::pow(length, 4.0f));
    }
  }
  return sum;
}

// Caustics: no shadow ray goes through water, so all of the tank's light is found by chance, and as an SPHL's
// it has no noise.
TEST(ThingEmission, WavesProjectTheirLightOntoWallsAsTheirSphlDoes) {
  scene::Scene room = scene::make_builtin("fishtank");
  const int tank = scene::find_node(room, "tank");
  for (scene::Material& m : room.materials)
    if (m.name == "plaster" || m.name == "wood" || m.name == "red") m.base_color = vec3(0);
  constexpr int depth = 12;
  const auto compared = [&](float time, float sphl_time) {
    const ThingEmission seen =
        thing_emission(room, tank, sphl_time, {.image_size = 16, .path = {.max_depth = depth, .spp = 4}});
    const scene::Scene stand_in = stand_in_for(room, seen, tank);
    const vec3 center(scene::world_matrices(room, time)[tank] * vec4(seen.center, 1));
    auto points = points_of_walls(center, {-2, 0, -2}, {2, 2.6f, 2});
    std::erase_if(
        points, [&](const rays::SurfacePoint& p) { return p.position.y < center.y; });  // the stand's shadow
    for (const rays::SurfacePoint& point : points)
      EXPECT_GT(glm::distance(point.position, center), 2 * seen.radius);
    const auto sphl = PathTracer(stand_in, time).surface_irradiance(points, {.max_depth = 1, .spp = 1}, {});
    std::vector<rays::IrradianceEstimate> thing(points.size());
    const PathTracer tracer(room, time);
    for (std::size_t i = 0; i < points.size(); ++i)
      thing[i].direct = vec3(irradiance_by_view(tracer, points[i], center, seen.radius,
                                                {.max_depth = depth, .spp = 8, .seed = i}));
    return difference(thing, sphl);
  };
  for (const float time : {0.0f, 1.0f}) {
    const Difference less = compared(time, time);
    for (int c = 0; c < 3; ++c) {
      EXPECT_LT(less.rms[c], 0.05) << c;
      EXPECT_LT(std::abs(less.mean[c]), 0.02) << c;
    }
  }
  EXPECT_GT(compared(0, 1).rms.y, 0.05) << "waves move it";
}

TEST(ThingEmission, FollowsWhatMovesAndTurns) {
  scene::Scene s;
  const int node = add_node(s, "car", placed({0, 0, 0}));
  s.nodes[0].local.rotation = quat(1, 0, 0, 0);
  scene::Light lamp;
  lamp.type = scene::LightType::spot, lamp.intensity = 5, lamp.outer_cone = 0.8f;
  lamp.node = add_node(s, "lamp", placed({0, 0, -1}), node);
  s.nodes[1].local.rotation = quat(1, 0, 0, 0);
  s.lights.push_back(lamp);
  const quat turned = glm::angleAxis(pi / 2, vec3(0, 1, 0));
  s.animations.push_back({"drive",
                          {{node,
                            scene::AnimationPath::rotation,
                            scene::Interpolation::linear,
                            {0, 1},
                            {{0, 0, 0, 1}, {turned.x, turned.y, turned.z, turned.w}}}}});
  const ThingEmission before = thing_emission(s, node, 0, {}), after = thing_emission(s, node, 1, {});
  for (std::size_t k = 0; k < before.intensity.values.size(); ++k)
    EXPECT_LT(glm::distance(before.intensity.values[k], after.intensity.values[k]), 0.02f) << k;
  EXPECT_LT(glm::distance(after.center, vec3(0, 0, -1)), 1e-4f);
}

TEST(ThingEmission, RefusesWhatSendsOutNothing) {
  scene::Scene s;
  const int dark = add_node(s, "stone", {}), empty = add_node(s, "empty", {});
  add_mesh(s, scene::make_box(vec3(0), vec3(1)), vec3(0.5f), vec3(0), dark);
  s.environment.emplace();
  EXPECT_EQ(message_of([&] { thing_emission(s, dark, 0, {.image_size = 4}); }),
            "node \"stone\": it sends out no light of its own (lamps and glowing meshes at the node or below "
            "it do)");
  EXPECT_EQ(message_of([&] { thing_emission(s, empty, 0, {}); }),
            "node \"empty\": nothing stands there that could send out light");
  EXPECT_EQ(message_of([&] { thing_emission(s, 7, 0, {}); }), "emission of a thing: there is no such node");
  EXPECT_EQ(message_of([&] { thing_emission(s, dark, 0, {.degree = 11}); }),
            "emission of a thing: the degree must be 0..10");
  EXPECT_EQ(message_of([&] { scene::find_node(s, "stove"); }),
            "node \"stove\": the scene has none of that name (there are: stone)");
  add_node(s, "stone", {});
  EXPECT_EQ(message_of([&] { scene::find_node(s, "stone"); }),
            "node \"stone\": 2 nodes have that name (there are: stone)");
}

TEST(ThingEmission, OfAFlatLampIsItsAreaTimesItsRadianceByTheCosine) {
  scene::Scene s;
  const int node = add_node(s, "panel", placed({3, 1, -2}, 0.7f));
  scene::Light& lamp = s.lights.emplace_back();
  lamp.name = "panel", lamp.node = node, lamp.type = scene::LightType::rectangle;
  lamp.size = {1.5f, 1}, lamp.intensity = 4;
  const ThingEmission seen = thing_emission(s, node, 0, {.degree = 2});
  // Of I = 6 max(−z, 0): means of I and of −z I are 6/4 and 6/6. Pixels at the edge are hit or missed.
  EXPECT_NEAR(seen.intensity[0].x / std::sqrt(4 * pi), 1.5f, 0.015f);
  EXPECT_NEAR(seen.intensity[2].x / (std::sqrt(4 * pi) * std::sqrt(3.0f)), -1, 0.01f);
  EXPECT_NEAR(seen.radius, 0.5f * std::sqrt(3.25f), 0.01f);
}

TEST(BuriedLamps, AreThoseInsideOfBodies) {
  scene::Scene s;
  add_node(s, "box", {});
  add_mesh(s, scene::make_box(vec3(-1), vec3(1)), vec3(0.5f), vec3(0), 0);
  for (const float x : {0.2f, 3.0f}) {
    scene::Light lamp;
    lamp.name = x < 1 ? "in" : "out", lamp.type = scene::LightType::sphl, lamp.radius = 0.1f;
    lamp.emission.frames = {sh::IntensitySh(0)};
    lamp.node = add_node(s, lamp.name, {{x, 0, 0}, quat(1, 0, 0, 0), vec3(1)});
    s.lights.push_back(lamp);
  }
  EXPECT_EQ(buried_lamps(s, PathTracer(s), 0), std::vector<std::string>{"in"});
}

}  // namespace
}  // namespace ssphh::trace
