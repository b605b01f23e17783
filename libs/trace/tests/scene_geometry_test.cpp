/// One set of acceleration structures for all poses and all who trace rays.

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "hand_made.h"
#include "posed_scene.h"
#include "robot.h"

namespace ssphh::test {
namespace {

// What stands on a geometry goes wherever its owner goes.
static_assert(std::is_nothrow_move_constructible_v<trace::PathTracer> &&
              std::is_nothrow_move_assignable_v<trace::PathTracer>);
static_assert(std::is_nothrow_move_constructible_v<trace::TransportScene> &&
              std::is_nothrow_move_assignable_v<trace::TransportScene>);

using trace::SceneGeometry;

vec3 random_point(const scene::Bounds& bounds, Pcg32& random) {
  return bounds.min + random.uniform3() * (bounds.max - bounds.min);
}

/// Rays in the posed geometry meet what they meet in the scene flattened whole.
void posed_is_flattened(const scene::Scene& scene, std::uint64_t flatten_limit) {
  int on_parts = 0;
  for (const float time : {0.0f, 0.3f, 1.0f}) {
    const scene::Scene still = frozen(scene, time);
    const PosedScene posed(scene, time, flatten_limit), whole(still);
    const scene::Bounds bounds = scene::world_bounds(scene, scene::world_matrices(scene, time));
    Pcg32 random(11);
    trace::RayTask task;
    int differ = 0;
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
      trace::Ray ray{random_point(bounds, random), sample_uniform_sphere(random.uniform2())};
      if (i % 3 == 0) ray.t_max = random.uniform();
      trace::Hit a, b;
      const bool hit = posed.intersect(ray, 0, task, a);
      // Rays that graze an edge may go either way: rounding.
      if (hit != whole.intersect(ray, 0, task, b) || hit != posed.occluded(ray, 0, task) ||
          (hit && (a.instance != b.instance || a.triangle != b.triangle))) {
        ++differ;
        continue;
      }
      if (!hit) continue;
      on_parts += a.instance > 0;
      EXPECT_NEAR(a.distance, b.distance, 2e-5f);
      vec3 origin_a, origin_b;
      const shading::Surface sa = posed.surface(a, -ray.direction, origin_a);
      const shading::Surface sb = whole.surface(b, -ray.direction, origin_b);
      EXPECT_LT(glm::distance(sa.position, sb.position), 2e-5f);
      EXPECT_LT(glm::distance(sa.geometric_normal, sb.geometric_normal), 2e-5f);
      EXPECT_LT(glm::distance(sa.normal, sb.normal), 2e-4f);
      EXPECT_EQ(sa.emission, sb.emission);
      EXPECT_EQ(posed.is_back(a, ray.direction), whole.is_back(b, ray.direction));
      // New rays start above the surface, by more where rays go to a part's frame and back.
      const float above = glm::dot(origin_a - sa.position, sa.geometric_normal);
      EXPECT_GT(above, 0.9f * glm::dot(origin_b - sb.position, sb.geometric_normal));
      EXPECT_LT(above, 1e-4f);
    }
    EXPECT_LE(differ, 5) << time;
  }
  EXPECT_GT(on_parts, 300);
}

TEST(SceneGeometry, ADoorIsWhereItsPoseIs) {
  posed_is_flattened(scene::make_builtin("two-rooms"), SceneGeometry::default_flatten_limit);
}

TEST(SceneGeometry, PartsOnPartsAreWhereTheirPosesAre) {
  posed_is_flattened(robot(), SceneGeometry::default_flatten_limit);
}

/// A ball with uneven scales that stands still and flies, and hangs on an arm.
scene::Scene many_balls() {
  scene::Scene scene = robot();
  const int first = add_object(scene, scene::make_sphere(0.2f, 12, 6), lambertian(vec3(0.7f, 0.5f, 0.2f)),
                               "ball", add_node(scene, "ball", vec3(-0.6f, 0.3f, 0)));
  const int arm = 2;
  for (const int parent : {-1, arm, 1}) {
    scene::Instance copy = scene.instances[first];
    copy.node = add_node(scene, "copy", vec3(0.4f, 0.1f, -0.2f), looking(vec3(1, 1, -2)));
    scene.nodes.back().parent = parent;
    scene.nodes.back().local.scale = vec3(1, parent < 0 ? -0.5f : 0.6f, 0.8f);
    scene.instances.push_back(copy);
  }
  return scene;
}

TEST(SceneGeometry, PartsShareMeshes) {
  posed_is_flattened(many_balls(), 0);
}

/// A convex body that a ray leaves must never be met again, wherever its pose takes it.
TEST(SceneGeometry, NoSelfIntersectionOfMovingBodies) {
  int shadowed = 0, rays = 0;
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    for (const float away : {0.0f, 1e2f, 1e4f}) {
      scene::Scene scene;
      const vec3 center = away * scale * vec3(1, -0.7f, 0.3f);
      const int node = add_node(scene, "body", center, glm::normalize(quat(0.8f, 0.3f, 0.1f, 0.5f)));
      scene.nodes.back().local.scale = vec3(scale, 0.7f * scale, -scale);
      add_object(scene, scene::make_box(vec3(-1), vec3(1)), lambertian(vec3(1)), "", node);
      scene.animations.push_back({"",
                                  {{node,
                                    scene::AnimationPath::translation,
                                    scene::Interpolation::linear,
                                    {0},
                                    {vec4(center, 0)}}}});
      const PosedScene posed(scene);
      count_shadowed(posed, center, scale, static_cast<std::uint64_t>(away + scale * 7), rays, shadowed);
    }
  }
  EXPECT_GT(rays, 20000);
  EXPECT_EQ(shadowed, 0);
}

/// A card at the height of 1 m that its animation scales.
scene::Scene scaled_card(const vec3& scale) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  const int node = add_node(scene, "card", vec3(0, 1, 0));
  add_object(scene, scene::make_quad(vec3(-1, 0, 1), vec3(2, 0, 0), vec3(0, 0, -2)), lambertian(vec3(0.5f)),
             "", node);
  scene.animations.push_back(
      {"", {{node, scene::AnimationPath::scale, scene::Interpolation::linear, {0}, {vec4(scale, 0)}}}});
  return scene;
}

TEST(SceneGeometry, WhatIsScaledToNothingIsNotThere) {
  for (const vec3& scale : {vec3(1), vec3(0), vec3(1, 0, 1), vec3(0, 1, 1)}) {
    const scene::Scene scene = scaled_card(scale);
    const auto geometry = std::make_shared<const SceneGeometry>(scene);
    const trace::PathTracer tracer(geometry, scene);
    const trace::TransportScene source(geometry, scene);
    const vec3 above(0.2f, 2, 0.1f), below(0.2f, 0.5f, 0.1f);
    const bool there = scale == vec3(1);
    EXPECT_EQ(tracer.visible(above, below), !there);
    const rays::PosedWorld world(source, 0);
    EXPECT_EQ(world.visible(above, below), !there);
    EXPECT_EQ(world.bounds().max.y, there ? 1 : 0);
  }
}

TEST(SceneGeometry, OneServesEveryTimeAndBothInterfaces) {
  const scene::Scene scene = robot();
  const std::uint64_t before = SceneGeometry::builds();
  const auto geometry = std::make_shared<const SceneGeometry>(scene);
  const trace::TransportScene source(geometry, scene), own_source(scene);
  EXPECT_EQ(SceneGeometry::builds(), before + 2);
  const std::vector<rays::SurfacePoint> points = {{{-1, 0.5f, 0.3f}, {1, 0, 0}},
                                                  {{1, 0.6f, -0.3f}, {-1, 0, 0}}};
  std::uint64_t own_builds = 0;
  for (const float time : {0.0f, 0.4f}) {
    const trace::PathTracer tracer(geometry, scene, time), own_tracer(scene, time);
    EXPECT_EQ(SceneGeometry::builds(), before + 2 + ++own_builds);
    const auto traced = tracer.surface_irradiance(points, {4, 1, 64, 3}, {}),
               own_traced = own_tracer.surface_irradiance(points, {4, 1, 64, 3}, {});
    std::vector<mat4> poses;
    for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, time));
    std::vector<vec3> direct(points.size()), own_direct(points.size());
    source.direct_light(source.lights(time), poses)->irradiance(0, points, direct);
    own_source.direct_light(source.lights(time), poses)->irradiance(0, points, own_direct);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(traced[i].direct, own_traced[i].direct);
      EXPECT_EQ(traced[i].indirect, own_traced[i].indirect);
      EXPECT_GT(traced[i].indirect.x, 0);
      EXPECT_EQ(direct[i], own_direct[i]);
      EXPECT_GT(direct[i].x, 0);
    }
  }
}

TEST(SceneGeometry, OutlivesWhoBroughtIt) {
  const scene::Scene scene = robot();
  auto geometry = std::make_shared<const SceneGeometry>(scene);
  const std::weak_ptr<const SceneGeometry> watched = geometry;
  {
    const trace::PathTracer tracer(geometry, scene);
    geometry.reset();
    EXPECT_FALSE(tracer.visible(vec3(0), vec3(0, 3, 0)));
    EXPECT_FALSE(watched.expired());
  }
  EXPECT_TRUE(watched.expired());
}

TEST(SceneGeometry, KeepsASharedSceneAlive) {
  auto scene = std::make_shared<const scene::Scene>(robot());
  const std::weak_ptr<const scene::Scene> watched = scene;
  trace::SharedGeometry geometry = trace::geometry_of(scene);
  EXPECT_NO_THROW(trace::PathTracer(geometry, *scene));
  scene.reset();
  EXPECT_FALSE(watched.expired());
  geometry.reset();
  EXPECT_TRUE(watched.expired());
  EXPECT_EQ(message_of([] { trace::geometry_of(nullptr); }), "scene geometry: there is no scene");
}

TEST(SceneGeometry, ServesTheSceneUnderOtherLights) {
  const scene::Scene scene = robot();
  const auto geometry = std::make_shared<const SceneGeometry>(scene);
  scene::LightingState state = rays::lighting_at(trace::TransportScene(geometry, scene), 0.2f);
  state.lights[0].world[3].x += 0.1f, state.lights[0].intensity = 3;
  state.group_scales.assign(state.group_scales.size(), vec3(0.5f, 2, 1));
  const scene::Scene lit = scene::with_lighting(scene, state);
  trace::RenderParams params = view_down(vec3(0), 1.5f, 12);
  params.path = {4, 1, 4, 9};
  trace::RenderState shared, own;
  trace::PathTracer(geometry, lit, 0.2f).render(params, shared);
  trace::PathTracer(lit, 0.2f).render(params, own);
  EXPECT_EQ(shared.color.pixels, own.color.pixels);
  EXPECT_GT(mean_of(shared.color), 0);
}

TEST(SceneGeometry, RefusesScenesWithOtherSurfaces) {
  const scene::Scene scene = many_balls();
  const auto geometry = std::make_shared<const SceneGeometry>(scene);
  const auto said = [&](auto change) {
    scene::Scene other = scene;
    change(other);
    const std::string tracer = message_of([&] { trace::PathTracer(geometry, other); });
    EXPECT_EQ(message_of([&] { trace::TransportScene(geometry, other); }), tracer);
    return tracer;
  };
  using scene::Scene;
  EXPECT_EQ(said([](Scene&) {}), "no error");
  EXPECT_EQ(said([](Scene& s) { s.materials[0].base_color = vec3(0.1f), s.lights[0].intensity = 7; }),
            "no error");
  EXPECT_EQ(said([](Scene& s) { s.animations[0].channels[0].values[1].x += 0.1f; }), "no error")
      << "other poses of the same parts";
  EXPECT_EQ(said([](Scene& s) { s.nodes[1].local.translation.x += 1; }), "no error") << "animated anyway";

  const std::string refused =
      "scene geometry: it was built for a scene with other surfaces (build one for this scene)";
  EXPECT_EQ(said([](Scene& s) { s.meshes[1].positions[2].x += 0.1f; }), refused);
  EXPECT_EQ(said([](Scene& s) { std::swap(s.meshes[1].triangles[0].x, s.meshes[1].triangles[0].y); }),
            refused);
  EXPECT_EQ(said([](Scene& s) { s.instances[1].mesh = 0; }), refused);
  EXPECT_EQ(said([](Scene& s) { s.instances.pop_back(); }), refused);
  EXPECT_EQ(said([](Scene& s) { s.meshes.push_back(s.meshes[0]); }), refused);
  EXPECT_EQ(said([](Scene& s) { s.nodes[0].local.translation.x += 1; }), refused) << "the room moved";
  EXPECT_EQ(said([](Scene& s) { s.animations.clear(); }), refused) << "the parts are others";
  EXPECT_EQ(said([](Scene& s) {
              s.materials[0].alpha_mode = scene::AlphaMode::blend, s.materials[0].alpha = 0.5f;
            }),
            refused)
      << "rays do not ask for its coverage";
  EXPECT_EQ(message_of([&] { trace::PathTracer(nullptr, scene); }), "scene geometry: there is none");
}

TEST(SceneGeometry, RefusesTexturesThatItsRecordsDoNotHold) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  scene.textures.push_back({"grey", 1, 1, {128, 128, 128, 255}});
  scene.meshes[0].uvs[0].assign(scene.meshes[0].positions.size(), vec2(0.5f));
  const auto geometry = std::make_shared<const SceneGeometry>(scene);
  scene::Scene textured = scene;
  textured.materials[0].emission_texture.texture = 0;
  EXPECT_THROW(trace::PathTracer(geometry, textured), Error);
  EXPECT_NO_THROW(trace::PathTracer(std::make_shared<const SceneGeometry>(textured), scene));
}

}  // namespace
}  // namespace ssphh::test
