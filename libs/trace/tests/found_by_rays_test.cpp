/// Which rays need not look for lights: none that finds one.

#include "../src/found_by_rays.h"

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "../src/tracer_data.h"
#include "hand_made.h"

namespace ssphh::trace {
namespace {

scene::Scene lamps_of_all_forms(Pcg32& random) {
  scene::Scene scene;
  const auto place = [&] { return 4.0f * random.uniform3() - 2.0f; };
  test::add_light(scene, scene::LightType::sphere, 1, place()).radius = 0.3f;
  test::add_light(scene, scene::LightType::rectangle, 1, place(), random.uniform3() - vec3(0.5f)).size = {
      0.7f, 0.4f};
  test::add_object(scene, scene::make_quad(place(), {0.5f, 0, 0}, {0, 0, 0.5f}),
                   test::lambertian(vec3(0), vec3(1)), "flat");
  test::add_object(
      scene, scene::transformed(scene::make_box(vec3(-0.2f), vec3(0.2f)), glm::translate(mat4(1), place())),
      test::lambertian(vec3(0), vec3(1)), "box");
  return scene;
}

bool finds_light(const TracerData& data, const Ray& ray) {
  bool found = false;
  data.lights.intersect_lamps(ray.origin, ray.direction, ray.t_max, [&](const auto&) { found = true; });
  RayTask task;
  Hit hit;
  return found || data.geometry.intersect(ray, Passage(0), task, hit);
}

TEST(FoundByRays, NoRayThatFindsALightIsLeftOut) {
  Pcg32 random(11);
  int finding = 0, left_out = 0;
  for (int i = 0; i < 20; ++i) {
    const scene::Scene scene = lamps_of_all_forms(random);
    const TracerData data(std::make_shared<const SceneGeometry>(scene), scene, 0);
    const FoundByRays found(data.lights);
    EXPECT_TRUE(found.any());
    for (int k = 0; k < 2000; ++k) {
      Ray ray{6.0f * random.uniform3() - 3.0f, sample_uniform_sphere(random.uniform2())};
      if (k % 4 == 0) {  // along an axis, from a lamp's own height
        ray.direction = vec3(0);
        ray.direction[k / 4 % 3] = k / 12 % 2 ? 1.0f : -1.0f;
        const scene::Bounds& box = data.lights.emitter(k / 24 % data.lights.emitter_count()).extent;
        ray.origin = glm::mix(box.min, box.max, vec3(k % 8 == 0 ? 0.0f : random.uniform()));
        ray.origin -= 3.0f * ray.direction;
      }
      const bool finds = finds_light(data, ray), on = found.on(ray);
      EXPECT_TRUE(on || !finds) << "scene " << i << ", ray " << k;
      finding += finds, left_out += !on;
    }
  }
  EXPECT_GT(finding, 2000);
  EXPECT_GT(left_out, 20000);
}

TEST(FoundByRays, TheSkyIsEverywhereAndAPointNowhere) {
  const Ray ray{vec3(0, 1, 0), vec3(0, 0, 1)};
  scene::Scene scene;
  test::add_light(scene, scene::LightType::point, 1, vec3(0, 1, 3));
  const auto world = scene::world_matrices(scene, 0);
  EXPECT_FALSE(FoundByRays(shading::LightSet(scene, world)).any());
  test::add_constant_sky(scene, vec3(1));
  EXPECT_TRUE(FoundByRays(shading::LightSet(scene, world)).on(ray));
}

TEST(FoundByRays, ManyLampsAreNotAskedOneByOne) {
  const Ray away{vec3(0), vec3(0, -1, 0)};
  scene::Scene scene;
  for (int i = 0; i < 17; ++i) {
    const auto world = scene::world_matrices(scene, 0);
    EXPECT_FALSE(FoundByRays(shading::LightSet(scene, world)).on(away));
    test::add_light(scene, scene::LightType::sphere, 1, vec3(i, 5, 0)).radius = 0.1f;
  }
  const auto world = scene::world_matrices(scene, 0);
  EXPECT_TRUE(FoundByRays(shading::LightSet(scene, world)).on(away));
}

/// Rays that end in the dark are not counted: they are not traced.
TEST(FoundByRays, TheLastRayOfAPathIsNotTracedInVain) {
  scene::Scene scene;
  test::add_floor(scene, test::lambertian(vec3(0.5f)));
  test::add_light(scene, scene::LightType::sphere, 1, vec3(0, 5, 0)).radius = 0.01f;
  const PathTracer tracer(scene);
  rays::CubeRequest request;
  request.position = vec3(0, 1, 0);
  request.face_size = 8;
  request.path = {.max_depth = 1, .passes = 1, .spp = 16, .seed = 3};
  const auto before = tracer.rays_traced();
  (void)tracer.incident_radiance(request, {});
  // Camera rays, shadow rays of those that meet the floor, and next to no more
  const double paths = 6 * 8 * 8 * 16;
  EXPECT_LT(static_cast<double>(tracer.rays_traced() - before), 1.52 * paths);
}

}  // namespace
}  // namespace ssphh::trace
