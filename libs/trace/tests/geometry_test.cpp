/// Rays against geometry: scale, distance from the origin, instancing, alpha, sides.

#include <array>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "hand_made.h"
#include "posed_scene.h"

namespace ssphh::test {
namespace {

/// A convex body that a ray leaves must never be met again, and a closed room never be left.
TEST(Geometry, NoSelfIntersectionAtAnyScaleAndPlace) {
  int shadowed = 0, rays = 0;
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    for (const float away : {0.0f, 1e2f, 1e4f}) {
      scene::Scene scene;
      const vec3 center = away * scale * vec3(1, -0.7f, 0.3f);
      add_object(scene,
                 scene::transformed(scene::make_box(vec3(-1), vec3(1)),
                                    glm::mat4_cast(glm::normalize(quat(0.8f, 0.3f, 0.1f, 0.5f)))),
                 lambertian(vec3(1)));
      for (vec3& p : scene.meshes[0].positions) p = center + scale * p;
      const PosedScene embree(scene);
      count_shadowed(embree, center, scale, static_cast<std::uint64_t>(away + scale * 7), rays, shadowed);
    }
  }
  EXPECT_GT(rays, 20000);
  EXPECT_EQ(shadowed, 0);
}

TEST(Geometry, ClosedRoomDoesNotLeak) {
  scene::Scene scene;
  scene::Mesh room = scene::flipped(scene::make_sphere(1, 24, 12));
  add_object(scene, room, lambertian(vec3(0.5f)));
  const PosedScene embree(scene);
  trace::RayTask task;
  Pcg32 random(5);
  trace::Ray ray{vec3(0.1f, 0.2f, 0), vec3(0, 1, 0)};
  for (int i = 0; i < 20000; ++i) {
    trace::Hit hit;
    ASSERT_TRUE(embree.intersect(ray, 0, task, hit)) << "bounce " << i;
    vec3 origin;
    const shading::Surface surface = embree.surface(hit, -ray.direction, origin);
    ray = {origin,
           Frame::around(surface.geometric_normal).to_world(sample_cosine_hemisphere(random.uniform2()))};
  }
}

TEST(Geometry, MillimetresFarFromTheOriginRenderAsMetresAtIt) {
  // The same room, light scaled with the square of size: equal radiance up to noise.
  const auto room = [](float scale, const vec3& center, std::uint64_t first_seed) {
    scene::Scene scene;
    add_room(scene, lambertian(vec3(0.6f)));
    for (scene::Mesh& mesh : scene.meshes) {
      for (vec3& p : mesh.positions) p = center + scale * p;
    }
    add_light(scene, scene::LightType::point, scale * scale, center + scale * vec3(0.3f, 0.5f, 0));
    trace::RenderParams params;
    params.projection = trace::Projection::equirect;
    params.width = 24, params.height = 12;
    params.camera.world = look_at(center + scale * vec3(0.2f), center);
    Samples means;
    for (std::uint64_t seed = first_seed; seed < first_seed + 40; ++seed) {
      params.path = {3, 1, 16, seed};
      means.add(mean_of(render(scene, params).color));
    }
    return means;
  };
  const Samples near = room(1, vec3(0), 0), far = room(1000, vec3(50000, 20000, -70000), 100);
  // 70 m in millimetres round to 8 µm: 1e-5 of the room.
  EXPECT_TRUE(means_agree(near, far, {1e-3, 1}, 1e-4 * near.mean()));
}

scene::Scene many_boxes() {
  scene::Scene scene;
  const int first = add_object(scene, scene::make_sphere(0.3f, 12, 6), lambertian(vec3(0.7f, 0.5f, 0.2f)),
                               "ball", add_node(scene, "ball", vec3(-0.6f, 0, 0), looking(vec3(1, 2, 3))));
  for (int i = 0; i < 5; ++i) {
    scene::Instance copy = scene.instances[first];
    copy.node = add_node(scene, "copy", vec3(-0.5f + 0.3f * static_cast<float>(i), 0.4f, -0.2f),
                         looking(vec3(i, 1, -2)));
    scene.nodes.back().local.scale = vec3(1, i == 2 ? -0.5f : 0.6f, 0.8f);
    scene.instances.push_back(copy);
  }
  add_room(scene, lambertian(vec3(0.5f)));
  return scene;
}

/// Of the corners of a triangle in the world.
float largest_coordinate(const scene::Scene& scene, const std::vector<mat4>& world, const trace::Hit& hit) {
  const scene::Instance& instance = scene.instances[hit.instance];
  const scene::Mesh& mesh = scene.meshes[instance.mesh];
  float largest = 0;
  for (int i = 0; i < 3; ++i) {
    const vec3& corner = mesh.positions[mesh.triangles[hit.triangle][i]];
    largest = std::max(largest, trace::max_abs_component(vec3(world[instance.node] * vec4(corner, 1))));
  }
  return largest;
}

/// Of an instance's origin.
float world_distance(const scene::Scene& scene, const std::vector<mat4>& world, const trace::Hit& hit) {
  const int node = scene.instances[hit.instance].node;
  return trace::max_abs_component(vec3(world[node][3]));
}

TEST(Geometry, InstancedAndFlattenedScenesAreTheSame) {
  const scene::Scene scene = many_boxes();
  const std::vector<mat4> world = scene::world_matrices(scene);
  const PosedScene flat(scene), instanced(scene, 0, 0);
  trace::RayTask task;
  Pcg32 random(5);
  int same = 0, hits_on_copies = 0;
  constexpr int count = 5000;
  for (int i = 0; i < count; ++i) {
    const trace::Ray ray{0.9f * random.uniform() * sample_uniform_sphere(random.uniform2()),
                         sample_uniform_sphere(random.uniform2())};
    trace::Hit a, b;
    ASSERT_TRUE(flat.intersect(ray, 0, task, a));
    ASSERT_TRUE(instanced.intersect(ray, 0, task, b));
    hits_on_copies += a.instance > 0 && a.instance < 6;
    if (a.instance != b.instance || a.triangle != b.triangle) continue;
    ++same;
    EXPECT_NEAR(a.distance, b.distance, 1e-5f);
    vec3 origin_a, origin_b;
    const shading::Surface sa = flat.surface(a, -ray.direction, origin_a);
    const shading::Surface sb = instanced.surface(b, -ray.direction, origin_b);
    EXPECT_LT(glm::distance(sa.position, sb.position), 2e-5f);
    EXPECT_LT(glm::distance(sa.normal, sb.normal), 2e-4f);
    EXPECT_EQ(flat.is_back(a, ray.direction), instanced.is_back(b, ray.direction));
    // New rays start above the surface, by more where a ray goes to an instance and back.
    const float magnitude = largest_coordinate(scene, world, a), way = world_distance(scene, world, a);
    const bool copy = a.instance < 6;
    EXPECT_NEAR(glm::dot(origin_a - sa.position, sa.geometric_normal), trace::position_error(magnitude),
                2e-7f);
    EXPECT_NEAR(glm::dot(origin_b - sb.position, sb.geometric_normal),
                trace::position_error(copy ? 4 * std::max(magnitude, way) : magnitude), 2e-7f);
  }
  EXPECT_GT(hits_on_copies, 200);
  // Rays at edges may choose the other triangle.
  EXPECT_GT(same, count * 0.995);
}

/// A card with alpha between a lamp and the floor.
scene::Scene card_scene(scene::AlphaMode mode, float alpha) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  scene::Material card = lambertian(vec3(0));
  card.alpha_mode = mode, card.alpha = alpha;
  add_object(scene, scene::make_quad(vec3(-1, 1, 1), vec3(2, 0, 0), vec3(0, 0, -2)), card, "card");
  add_light(scene, scene::LightType::point, 10, vec3(0, 2, 0));
  return scene;
}

TEST(Geometry, BlendLetsLightThroughInProportion) {
  const double open = 10.0 / 4 * 0.5 / pi_d;
  EXPECT_TRUE(
      mean_is(pixels_of(render(card_scene(scene::AlphaMode::blend, 0.3f), view_point(vec3(0), 64, 1)).color),
              0.7 * open, {}, 1e-5));
}

TEST(Geometry, BlendByVertexColoursAloneLetsLightThroughInProportion) {
  scene::Scene scene = card_scene(scene::AlphaMode::blend, 1);
  for (scene::Mesh& mesh : scene.meshes) mesh.colors.assign(mesh.positions.size(), vec4(1, 1, 1, 0.3f));
  const double open = 10.0 / 4 * 0.5 / pi_d;
  EXPECT_TRUE(mean_is(pixels_of(render(scene, view_point(vec3(0), 64, 1)).color), 0.7 * open, {}, 1e-5));
}

TEST(Geometry, MaskIsAllOrNothing) {
  const double open = 10.0 / 4 * 0.5 / pi_d;
  const auto floor_radiance = [](scene::AlphaMode mode, float alpha) {
    return mean_of(render(card_scene(mode, alpha), view_point(vec3(0), 4, 1)).color);
  };
  EXPECT_NEAR(floor_radiance(scene::AlphaMode::mask, 0.4f), open, 1e-5);
  EXPECT_EQ(floor_radiance(scene::AlphaMode::mask, 0.6f), 0);
  EXPECT_EQ(floor_radiance(scene::AlphaMode::opaque, 0.3f), 0);
  EXPECT_NEAR(floor_radiance(scene::AlphaMode::blend, 0), open, 1e-5);
  EXPECT_EQ(floor_radiance(scene::AlphaMode::blend, 1), 0);
}

TEST(Geometry, WithoutChanceHalfAlphaBlocksAndLessDoesNot) {
  for (const float alpha : {0.3f, 0.4999f, 0.5f, 0.7f}) {
    const scene::Scene scene = card_scene(scene::AlphaMode::blend, alpha);
    const PosedScene embree(scene);
    trace::RayTask task;
    EXPECT_EQ(embree.occluded({vec3(0, 0.5f, 0), vec3(0, 1, 0), 1}, 0, task), alpha >= 0.5f) << alpha;
  }
}

TEST(Geometry, CameraAndAovsPassThroughAlpha) {
  trace::RenderParams params = view_down(vec3(0), 1e-3f, 32, 3);
  params.path = {0, 1, 16, 3};
  const trace::RenderState state = render(card_scene(scene::AlphaMode::blend, 0.25f), params);
  // The card (albedo 0, 2 m below the eye) in a quarter of the samples, the floor (0.5, 3 m) in the others.
  EXPECT_TRUE(mean_is(pixels_of(state.albedo), 0.75 * 0.5, {1e-3, 2}, 1e-6));
  EXPECT_TRUE(mean_is(pixels_of(state.depth), 0.25 * 2 + 0.75 * 3, {1e-3, 2}, 1e-5));
  EXPECT_NEAR(mean_of(state.coverage), 1, 1e-6);
  EXPECT_NEAR(mean_of(state.normal, 1), 1, 1e-6);
}

TEST(Geometry, AlphaOfInstancedMeshesIsTheInstances) {
  scene::Scene scene = card_scene(scene::AlphaMode::blend, 0.0f);
  scene::Instance opaque = scene.instances[1];
  scene.materials.push_back(lambertian(vec3(0)));
  opaque.material = static_cast<int>(scene.materials.size()) - 1;
  opaque.node = add_node(scene, "opaque card", vec3(10, 0, 0));
  scene.instances.push_back(opaque);
  const PosedScene instanced(scene, 0, 0);
  trace::RayTask task;
  EXPECT_FALSE(instanced.occluded({vec3(0, 0.5f, 0), vec3(0, 1, 0), 1}, 1, task));
  EXPECT_TRUE(instanced.occluded({vec3(10, 0.5f, 0), vec3(0, 1, 0), 1}, 1, task));
}

TEST(Geometry, VisibleIsBlockedByAWallOnly) {
  scene::Scene scene;
  add_object(scene, scene::make_box(vec3(-0.1f, -5, -5), vec3(0.1f, 5, 5)), lambertian(vec3(0.5f)));
  const trace::PathTracer tracer(scene);
  EXPECT_FALSE(tracer.visible(vec3(-1, 0, 0), vec3(1, 0, 0)));
  EXPECT_TRUE(tracer.visible(vec3(-1, 0, 0), vec3(-1, 3, 2)));
  // Points on the wall's surface see what is on their side, and not through the wall.
  EXPECT_TRUE(tracer.visible(vec3(-0.1f, 0, 0), vec3(-1, 1, 0)));
  EXPECT_TRUE(tracer.visible(vec3(-1, 1, 0), vec3(-0.1f, 0, 0)));
  EXPECT_FALSE(tracer.visible(vec3(-0.1f, 0, 0), vec3(1, 1, 0)));
  EXPECT_TRUE(tracer.visible(vec3(3), vec3(3))) << "an empty segment";
  EXPECT_EQ(tracer.rays_traced(), 5u);
}

TEST(Geometry, VisibleIsBlockedByWhatStandsNearAnEnd) {
  // A sheet at 1/2000 of the way from an end: five times as far as the ends are shortened.
  scene::Scene scene;
  scene::Material sheet = lambertian(vec3(0.5f));
  add_object(scene, scene::make_quad(vec3(0, -1, -1), vec3(0, 2, 0), vec3(0, 0, 2)), sheet);
  const trace::PathTracer tracer(scene);
  const vec3 near(-0.001f, 0, 0), far(1.999f, 0, 0);
  EXPECT_FALSE(tracer.visible(near, far));
  EXPECT_FALSE(tracer.visible(far, near));
}

TEST(Geometry, BackfaceFractionTellsInsideFromOutside) {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f)));
  const int ball = add_object(scene, scene::make_sphere(0.3f, 12, 6), lambertian(vec3(0.5f)), "ball",
                              add_node(scene, "ball", vec3(-0.6f, 0, 0)));
  scene::Instance mirrored = scene.instances[ball];
  mirrored.node = add_node(scene, "mirrored", vec3(0.5f, 0.5f, 0));
  scene.nodes.back().local.scale = vec3(1, -0.5f, 0.8f);
  scene.instances.push_back(mirrored);
  const trace::PathTracer tracer(scene);
  EXPECT_EQ(tracer.backface_fraction(vec3(-0.6f, 0, 0)), 1) << "in a ball";
  EXPECT_EQ(tracer.backface_fraction(vec3(0.5f, 0.5f, 0)), 1) << "in a mirrored ball";
  EXPECT_LT(tracer.backface_fraction(vec3(0.5f, -0.5f, 0.5f)), 0.01) << "in the room";
  scene.materials[1].double_sided = true;
  EXPECT_EQ(trace::PathTracer(scene).backface_fraction(vec3(-0.6f, 0, 0)), 0);
}

TEST(Geometry, ProbeInAWallOrOnASurfaceDoesNotCrash) {
  scene::Scene scene = many_boxes();
  add_light(scene, scene::LightType::point, 1, vec3(0, 0.9f, 0));
  const trace::PathTracer tracer(scene);
  for (const vec3& place :
       {vec3(-0.6f, 0, 0), vec3(0, -1, 0), vec3(1, 1, 1), vec3(0, 0.9f, 0), vec3(500, 0, 0)}) {
    const std::vector<rays::GroupRadiance> maps = tracer.incident_radiance({place, 4, {3, 1, 4, 1}}, {});
    for (const image::Image& face : maps.at(0).reflected.faces) {
      for (const float v : face.pixels) EXPECT_TRUE(std::isfinite(v) && v >= 0);
    }
  }
}

TEST(Geometry, ShadingNormalsDoNotLetLightThrough) {
  // Normals tilted by 60° on a floor that is lit from below only.
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.8f)));
  scene.meshes[0].normals.assign(scene.meshes[0].positions.size(), glm::normalize(vec3(1.7f, 1, 0)));
  add_light(scene, scene::LightType::point, 100, vec3(3, -0.5f, 0));
  add_light(scene, scene::LightType::sphere, 100, vec3(3, -2, 0), vec3(1, 0, 0), "globe").radius = 0.5f;
  EXPECT_EQ(mean_of(render(scene, view_point(vec3(0), 16, 3)).color), 0);
}

}  // namespace
}  // namespace ssphh::test
