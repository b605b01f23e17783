#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>

#include "method_fixtures.h"

namespace ssphh {
namespace {

double error_of(test::MadeMethod& made, std::span<const scene::SurfacePoint> points,
                std::span<const scene::IrradianceEstimate> truth) {
  return gi::lookup_error(made.irradiance(gi::frame_at(made.source, 0), points), truth).mean_error;
}

TEST(IrradianceVolume, ErrorsFallWithMoreProbes) {
  for (const std::string name : {"cornell", "gallery1"}) {
    const scene::Scene scene = scene::make_builtin(name);
    const std::vector<scene::SurfacePoint> points = test::points_of(scene, 200);
    const std::vector<scene::IrradianceEstimate> truth = test::truth_at(scene, 0, points, 25, 128);
    for (const std::string interpolation : {"tetrahedra", "trilinear"}) {
      std::vector<double> errors;
      for (const int probes : {8, 64, 512}) {
        test::MadeMethod made("irradiance-volume",
                              {"places=grid", "probes=" + std::to_string(probes),
                               "interpolation=" + interpolation, "directions=256"},
                              scene);
        errors.push_back(error_of(made, points, truth));
      }
      // Measured: see docs/methods/irradiance-volume.md. Half the error is far from noise at 200 points.
      EXPECT_LT(errors[2], 0.6 * errors[0]) << name << " " << interpolation;
      EXPECT_LT(errors[2], errors[1]) << name << " " << interpolation;
    }
  }
}

TEST(IrradianceVolume, LeaksThroughAShutDoor) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const std::vector<scene::SurfacePoint> points = test::points_of(scene, 400);
  const trace::PathTracer tracer(scene, 0);
  const gi::LeakParams params{.path = {.max_depth = 25, .passes = 1, .spp = 64, .seed = 1}};
  const gi::TruthAtPoints truth = gi::trace_truth(tracer, points, params);
  ASSERT_GT(truth.dark, 100u);
  test::MadeMethod volume("irradiance-volume", {}, scene), ssphh("ssphh", {"weights=mls"}, scene);
  const gi::FrameState state = gi::frame_at(volume.source, 0);
  // Its cells reach through the wall; lookups that ask for visibility do not leak at all.
  EXPECT_GT(gi::leak_ratio(volume.irradiance(state, points), truth), 0.005);
  EXPECT_LE(gi::leak_ratio(ssphh.irradiance(state, points), truth), 1e-5);
}

TEST(IrradianceVolume, ASecondUpdateIsThatOfAFreshOne) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const std::vector<scene::SurfacePoint> points = test::points_of(scene, 100);
  const std::vector<std::string> settings = {"probes=40"};
  test::MadeMethod kept("irradiance-volume", settings, scene), fresh("irradiance-volume", settings, scene);
  gi::FrameState state = gi::frame_at(kept.source, 0);
  kept.irradiance(state, points);
  state = gi::frame_at(kept.source, 0.6f);
  state.lights[0].world[3].x += 0.3f;
  state.group_scales[0] = {2, 1, 0.5f};
  const std::vector<vec3> now = kept.irradiance(state, points), expected = fresh.irradiance(state, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(now[i][c], expected[i][c], 2e-3f * expected[i][c] + 1e-5f);
}

TEST(IrradianceVolume, RefusesWhatItCannotDo) {
  const scene::Scene scene = scene::make_builtin("cornell");
  EXPECT_THROW(test::MadeMethod("irradiance-volume", {"interpolation=trilinear"}, scene), Error);
  EXPECT_THROW(test::MadeMethod("irradiance-volume", {"places=grid", "spacing=0.0001"}, scene), Error);
  scene::Scene bare = scene;
  bare.sphls.clear();
  EXPECT_THROW(test::MadeMethod("irradiance-volume", {"places=scene"}, bare), Error);
}

}  // namespace
}  // namespace ssphh
