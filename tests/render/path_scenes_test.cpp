/// The path tracer on whole scenes: built-in ones with known answers, turned ones, and real ones.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/sh/project.h>
#include <ssphh/trace/path_tracer.h>

#include "shared_scenes.h"
#include "turned_scene.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

/// Pixels of the red channel of a small picture from the scene's own camera.
Samples picture(const scene::Scene& scene, const trace::PathTracer& tracer, int max_depth,
                std::uint64_t seed = 1) {
  trace::RenderParams params;
  params.width = 32, params.height = 18;
  params.camera = scene::camera_pose(scene, "");
  params.path = {max_depth, 1, 16, seed};
  trace::RenderState state;
  tracer.render(params, state);
  Samples samples;
  for (std::size_t i = 0; i < state.color.pixels.size(); i += 3)
    samples.add(static_cast<double>(state.color.pixels[i]));
  return samples;
}

TEST(PathScenes, BuiltinBoxGivesTheGeometricSum) {
  const scene::Scene box = scene::make_builtin("box");
  const trace::PathTracer tracer(box);
  double expected = 0;
  for (int n = 0; n <= 4; ++n) {
    expected += std::pow(0.5, n);
    EXPECT_TRUE(mean_is(picture(box, tracer, n), expected, {1e-3, 6}, 2e-6)) << "depth " << n;
  }
  EXPECT_TRUE(mean_is(picture(box, tracer, 1 << 20), 2, {1e-3, 6}, 2e-6));
}

TEST(PathScenes, ProbeInTheBuiltinBoxHoldsBandZeroOnly) {
  const scene::Scene box = scene::make_builtin("box");
  const trace::PathTracer tracer(box);
  // Independent probes at one place: mean and variance of each coefficient.
  std::vector<Samples> coefficients(9);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const rays::CubeRequest request{vec3(0.1f, 0, -0.1f), 8, {3, 1, 2, seed}};
    std::vector<double> sum(9);
    for (const rays::GroupRadiance& group : tracer.incident_radiance(request, {})) {
      for (const image::CubeMap* map : {&group.emitted, &group.reflected}) {
        sh::CubeFaces faces;
        for (std::size_t f = 0; f < 6; ++f) faces[f] = map->faces[f].pixels;
        const sh::RadianceSh sh = sh::project_cube(2, map->size, faces);
        for (int k = 0; k < 9; ++k) sum[k] += static_cast<double>(sh[k].x);
      }
    }
    for (std::size_t k = 0; k < 9; ++k) coefficients[k].add(sum[k]);
  }
  const double radiance = 1 + 0.5 + 0.25 + 0.125;
  EXPECT_TRUE(mean_is(coefficients[0], radiance * std::sqrt(4 * pi_d), {1e-3, 9}, 1e-5));
  for (std::size_t k = 1; k < 9; ++k) EXPECT_TRUE(mean_is(coefficients[k], 0, {1e-3, 9}, 1e-5)) << k;
}

TEST(PathScenes, BuiltinFurnaceShowsItsAlbedo) {
  // Wherever the body is seen, it reflects the albedo image's share of the surrounding radiance of 1; beside
  // it, 1.
  const scene::Scene furnace = scene::make_builtin("furnace");
  trace::RenderParams params;
  params.width = 32, params.height = 18;
  params.camera = scene::camera_pose(furnace, "");
  params.path = {1, 1, 64, 3};
  trace::RenderState state;
  trace::PathTracer(furnace).render(params, state);
  Samples ratio, background;
  for (std::size_t i = 0; i < state.coverage.pixels.size(); ++i) {
    if (state.coverage.pixels[i] == 1)
      ratio.add(static_cast<double>(state.color.pixels[3 * i] / state.albedo.pixels[3 * i]));
    if (state.coverage.pixels[i] == 0) background.add(static_cast<double>(state.color.pixels[3 * i]));
  }
  ASSERT_GT(ratio.count(), 50u);
  ASSERT_GT(background.count(), 50u);
  // Smooth normals on a faceted body lose the light that its facets hide at the rim: 1 %.
  EXPECT_TRUE(mean_is(ratio, 1, {1e-3, 2}, 0.01));
  EXPECT_TRUE(mean_is(background, 1, {1e-3, 2}, 1e-6));
}

/// Sum of the reflected light's texels at a place in room B of builtin:two-rooms.
double light_in_room_b(float time) {
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  double sum = 0;
  for (const rays::GroupRadiance& group :
       trace::PathTracer(rooms, time).incident_radiance({vec3(1.6f, 1.5f, -0.9f), 8, {6, 1, 8, 2}}, {})) {
    for (const image::Image& face : group.reflected.faces) {
      for (const float v : face.pixels) sum += static_cast<double>(v);
    }
  }
  return sum;
}

TEST(PathScenes, RoomBehindAShutDoorIsBlackAndLitWhenItOpens) {
  EXPECT_EQ(light_in_room_b(0), 0);
  EXPECT_GT(light_in_room_b(1), 1);
}

TEST(PathScenes, TurningSceneAndCameraTogetherChangesNothing) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  const scene::Scene tilted = turned(scene, glm::normalize(quat(0.8f, 0.3f, -0.4f, 0.2f)));
  const trace::PathTracer of_scene(scene), of_tilted(tilted);
  Samples before, after;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    before.add(picture(scene, of_scene, 3, seed).mean());
    after.add(picture(tilted, of_tilted, 3, 1000 + seed).mean());
  }
  EXPECT_GT(before.mean(), 0.001);
  EXPECT_TRUE(means_agree(before, after, {1e-3, 1}, 1e-5 * before.mean()));
}

TEST(PathScenes, HotelRoomInMillimetresFarAwayRendersWithoutAcne) {
  SSPHH_SHARED_SCENE(file, "hotel-room/scene-decoded.glb");
  scene::Scene scene = scene_io::load_scene(file.string());
  scene.lights.clear();
  for (scene::Material& material : scene.materials) material.emission = vec3(0);
  scene::Environment sky;
  scene.environment = sky;
  // Everything under a sky of 1 reflects no more than 1: acne would darken, leaks cannot brighten.
  const Samples samples = picture(scene, trace::PathTracer(scene), 1);
  EXPECT_GT(samples.mean(), 0.02);
  EXPECT_LT(samples.mean(), 1.01);
}

}  // namespace
}  // namespace ssphh::test
