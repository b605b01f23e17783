#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>

#include "method_fixtures.h"

namespace ssphh {
namespace {

/// The environment alone, turned by a quarter and a bit: exact within noise, the mesh's coarseness and the
/// degree, which the sky's is below.
TEST(Prt, RotatingEnvironmentIsThatOfPathTracing) {
  const scene::Scene scene = scene::make_builtin("court");
  test::MadeMethod made("prt", {"places=scene", "interreflect=4", "degree=2", "edge=0.3", "rays=128"}, scene);
  const std::vector<rays::SurfacePoint> points = test::points_of(scene, 200);
  scene::LightingState state = rays::lighting_at(made.source, 0);
  for (const float turn : {0.0f, 1.8f}) {
    state.environment_rotation = turn;
    const std::vector<rays::IrradianceEstimate> truth =
        test::truth_at(test::scene_in(scene, state), 0, points, 5, 256);
    const study::LookupError error = study::lookup_error(made.irradiance(state, points), truth);
    EXPECT_NEAR(error.luminance.ratio, 1, 0.03) << turn;
    EXPECT_LT(error.luminance.mean_error, 0.08) << turn;
    // The light of the other rotation is not this one.
    state.environment_rotation = -turn;
    if (turn == 0) continue;
    EXPECT_GT(study::lookup_error(made.irradiance(state, points), truth).luminance.mean_error,
              2 * error.luminance.mean_error);
  }
}

TEST(Prt, EnvironmentInTheProbesFollowsRotationToo) {
  const scene::Scene scene = scene::make_builtin("court");
  scene::Scene other = scene;
  other.environment->rotation = 0.7f;
  const std::vector<std::string> coarse = {"places=scene", "directions=128", "surfel_size=0.4"};
  test::MadeMethod made("irradiance-volume", coarse, scene), loaded("irradiance-volume", coarse, other);
  const std::vector<rays::SurfacePoint> points = test::points_of(scene, 50);
  scene::LightingState state = rays::lighting_at(made.source, 0);
  made.irradiance(state, points);
  state.environment_rotation = 0.7f;
  const std::vector<vec3> now = made.irradiance(state, points);
  state.environment_rotation = 0;
  const std::vector<vec3> expected = loaded.irradiance(state, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(now[i][c], expected[i][c], 2e-3f * expected[i][c]);
}

TEST(Prt, EdgesAreAFourteenthOfTheScenesRadiusUnlessTold) {
  const scene::Scene scene = scene::make_builtin("box");
  const auto triangles = [&](double edge) {
    const test::MadeMethod made("prt",
                                {"places=scene", "degree=0", "rays=16", "interreflect=0", "directions=16",
                                 "surfel_size=0.5", fmt::format("edge={}", edge)},
                                scene);
    for (const auto& [name, value] : made.method->numbers())
      if (name == "triangles") return value;
    return 0.0;
  };
  const double radius = std::sqrt(3.0), usual = triangles(0);
  EXPECT_EQ(usual, triangles(radius / 14));
  EXPECT_GT(usual, triangles(radius / 13)) << "edges are halved: between these two lies a step";
}

TEST(Prt, MovingThingsAreLitFromTheProbes) {
  const scene::Scene scene = scene::make_builtin("court");
  test::MadeMethod made("prt", {"places=scene", "degree=2", "edge=0.5", "rays=64"}, scene);
  const std::vector<rays::SurfacePoint> still = test::points_of(scene, 200);
  std::vector<rays::SurfacePoint> moving = still;
  for (rays::SurfacePoint& point : moving) point.moves = true;
  const std::vector<rays::IrradianceEstimate> truth = test::truth_at(scene, 0, still, 5, 128);
  const scene::LightingState state = rays::lighting_at(made.source, 0);
  // Six probes for a court: coarse, but the energy is there.
  EXPECT_NEAR(study::lookup_error(made.irradiance(state, moving), truth).luminance.ratio, 1, 0.35);
  EXPECT_LT(study::lookup_error(made.irradiance(state, still), truth).luminance.mean_error,
            study::lookup_error(made.irradiance(state, moving), truth).luminance.mean_error);
}

TEST(Prt, LampsByProbesAndErrorsFallWithMoreOfThem) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const std::vector<rays::SurfacePoint> points = test::points_of(scene, 200);
  const std::vector<rays::IrradianceEstimate> truth = test::truth_at(scene, 0, points, 25, 128);
  std::vector<double> errors;
  for (const std::string probes : {"8", "512"}) {
    test::MadeMethod made(
        "prt",
        {"places=grid", "probes=" + probes, "directions=256", "rays=64", "edge=0.2", "surfel_size=0.08"},
        scene);
    errors.push_back(test::absolute_error(made.irradiance(rays::lighting_at(made.source, 0), points), truth));
  }
  // Measured: 0.147 and 0.120, of which 0.08 are the truth's own noise.
  EXPECT_LT(errors[1], 0.9 * errors[0]);
}

TEST(Prt, RefusesAnEnvironmentThatSharesItsGroup) {
  scene::Scene scene = scene::make_builtin("court");
  scene::Light& lamp = scene.lights.emplace_back();
  lamp.name = "lamp", lamp.group = "environment", lamp.node = 0;
  EXPECT_THROW(test::MadeMethod("prt", {"places=scene"}, scene), Error);
  test::MadeMethod made("prt", {"places=scene", "environment=probes", "edge=2", "rays=16", "surfel_size=0.5"},
                        scene);
}

}  // namespace
}  // namespace ssphh
