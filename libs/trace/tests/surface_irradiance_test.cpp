/// Irradiance at surface points by paths: closed forms, honest variances, and agreement with a
/// TransportScene.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

using rays::SurfacePoint;

/// Points on the inner walls of [−1, 1]³.
std::vector<SurfacePoint> wall_points(int count, std::uint64_t seed = 1) {
  Pcg32 random(seed);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    SurfacePoint point{1.8f * random.uniform3() - 0.9f, vec3(0)};
    const int axis = i % 3;
    point.position[axis] = i % 2 ? 1.0f : -1.0f;
    point.normal[axis] = -point.position[axis];
    points.push_back(point);
  }
  return points;
}

double mean_z2(std::span<const SurfacePoint> points, const trace::PathTracer& tracer,
               const rays::PathParams& path, double exact) {
  Samples z2;
  for (const auto& e : tracer.surface_irradiance(points, path, {})) {
    const double z =
        (static_cast<double>(e.indirect.x) - exact) / std::sqrt(static_cast<double>(e.indirect_variance.x));
    z2.add(z * z);
  }
  return z2.mean();
}

TEST(SurfaceIrradiance, GlowingBoxGivesTheGeometricSum) {
  // Radiance from everywhere is Σ ρ^k: of k = 0 direct, the rest indirect.
  const scene::Scene scene = scene::make_builtin("box");
  const trace::PathTracer tracer(scene);
  for (const int depth : {1, 2, 5}) {
    double expected = 0;
    for (int k = 1; k < depth; ++k) expected += pi_d * std::pow(0.5, k);
    Samples direct, indirect;
    for (const auto& e : tracer.surface_irradiance(wall_points(60), {depth, 1, 256, 3}, {})) {
      direct.add(static_cast<double>(e.direct.x)), indirect.add(static_cast<double>(e.indirect.x));
    }
    // Sums of 16 floats of up to 6.
    EXPECT_TRUE(mean_is(direct, pi_d, {1e-3, 6}, 1e-5)) << depth;
    EXPECT_TRUE(mean_is(indirect, expected, {1e-3, 6}, 1e-5)) << depth;
  }
}

TEST(SurfaceIrradiance, IsThatOfALampAndOfTheSunBesideIt) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_light(scene, scene::LightType::point, 8, vec3(0, 2, 0)).color = vec3(1, 0.5f, 0.25f);
  add_light(scene, scene::LightType::directional, 3, vec3(0), vec3(-1, -1, 0)).color = vec3(0.1f, 0.4f, 1);
  const SurfacePoint floor{vec3(0), vec3(0, 1, 0)};
  const vec3 expected = vec3(2, 1, 0.5f) + 3 * std::sqrt(0.5f) * vec3(0.1f, 0.4f, 1);
  const auto found = trace::PathTracer(scene).surface_irradiance(std::span(&floor, 1), {1, 1, 16, 3}, {});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[0].direct[c], expected[c], 1e-5f) << c;
}

TEST(SurfaceIrradiance, TwoPathsAlreadyGiveTheirVariance) {
  // Depths 2 to 5 in the glowing box. The mean of squared errors is the mean of the variances.
  const scene::Scene scene = scene::make_builtin("box");
  const double expected = pi_d * (0.5 + 0.25 + 0.125 + 0.0625);
  for (const int paths : {2, 3}) {
    Samples excess, variance;
    for (const auto& e :
         trace::PathTracer(scene).surface_irradiance(wall_points(3000), {5, 1, paths, 3}, {})) {
      const double error = static_cast<double>(e.indirect.x) - expected;
      variance.add(static_cast<double>(e.indirect_variance.x));
      excess.add(error * error - static_cast<double>(e.indirect_variance.x));
    }
    EXPECT_GT(variance.mean(), 0.01);
    EXPECT_TRUE(mean_is(excess, 0, {1e-3, 2})) << paths << " paths, mean variance " << variance.mean();
  }
}

TEST(SurfaceIrradiance, FurnaceSeesTheSkyAlone) {
  const scene::Scene scene = scene::make_builtin("furnace");
  const trace::PathTracer tracer(scene);
  std::vector<SurfacePoint> points;
  // On the faces of the body: its triangles lie within the unit sphere.
  const scene::Mesh& mesh = scene.meshes[0];
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 61) {
    vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.triangles[t][k]];
    points.push_back({(p[0] + p[1] + p[2]) / 3.0f, glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]))});
  }
  Samples direct;
  for (const auto& e : tracer.surface_irradiance(points, {4, 2, 64, 1}, {})) {
    direct.add(static_cast<double>(e.direct.x));
    EXPECT_EQ(e.indirect, vec3(0)) << "a convex body does not light itself";
    EXPECT_EQ(e.indirect_variance, vec3(0));
  }
  EXPECT_TRUE(mean_is(direct, pi_d, {}, 1e-5));
}

/// A lamp in a room with a box in it, and a glossy wall material.
scene::Scene furnished_room() {
  scene::Scene scene;
  scene::Material walls = lambertian(vec3(0.7f, 0.5f, 0.3f));
  add_room(scene, walls);
  add_object(scene, scene::make_box(vec3(-0.5f, -1, -0.5f), vec3(0, -0.2f, 0)), lambertian(vec3(0.6f)),
             "box");
  add_object(scene, scene::make_quad(vec3(-0.3f, 0.95f, -0.3f), vec3(0.6f, 0, 0), vec3(0, 0, 0.6f)),
             lambertian(vec3(0), vec3(5)), "panel");
  add_light(scene, scene::LightType::point, 0.5f, vec3(0.5f, 0.2f, 0.6f), vec3(0, -1, 0), "bulb");
  add_light(scene, scene::LightType::sphere, 3, vec3(-0.6f, 0.3f, 0.6f), vec3(0, -1, 0), "globe").radius =
      0.1f;
  return scene;
}

TEST(SurfaceIrradiance, VarianceIsHonest) {
  // z² of estimates against the truth averages to 1, or to 15/13 by the t distribution of 16 batches.
  const scene::Scene box = scene::make_builtin("box");
  const trace::PathTracer box_tracer(box);
  const double exact = pi_d * (0.5 + 0.25);
  const double z2 = mean_z2(wall_points(600), box_tracer, {3, 1, 64, 9}, exact);
  EXPECT_GT(z2, 0.9);
  EXPECT_LT(z2, 1.45);

  // Without a closed form: differences of two seeds, in units of both variances.
  const scene::Scene room = furnished_room();
  const trace::PathTracer tracer(room);
  const auto points = wall_points(600, 4);
  const auto a = tracer.surface_irradiance(points, {4, 1, 64, 1}, {});
  const auto b = tracer.surface_irradiance(points, {4, 1, 64, 2}, {});
  Samples z, squares;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (a[i].indirect == vec3(0) && b[i].indirect == vec3(0)) continue;  // under the box
    const double d = static_cast<double>(a[i].indirect.y - b[i].indirect.y) /
                     std::sqrt(static_cast<double>(a[i].indirect_variance.y + b[i].indirect_variance.y));
    z.add(d), squares.add(d * d);
  }
  EXPECT_TRUE(mean_is(z, 0));
  EXPECT_GT(squares.mean(), 0.8);
  EXPECT_LT(squares.mean(), 1.4);
}

TEST(SurfaceIrradiance, CovariancesTellTheNoiseBetweenChannels) {
  // Between a red and a green wall, two channels' difference of two seeds, in units of what variances and
  // covariances make of it.
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::PathTracer tracer(scene);
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 600; ++i)
    points.push_back(
        {{-0.95f + 0.1f * static_cast<float>(i % 20), 0, -0.95f + 0.06f * static_cast<float>(i / 20)},
         {0, 1, 0}});
  const auto a = tracer.surface_irradiance(points, {5, 1, 256, 1}, {});
  const auto b = tracer.surface_irradiance(points, {5, 1, 256, 2}, {});
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    Samples squares;
    double together = 0, apart = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (a[i].indirect == vec3(0) || b[i].indirect == vec3(0)) continue;  // under the boxes
      const vec3 variance = a[i].indirect_variance + b[i].indirect_variance;
      const vec3 covariance = a[i].indirect_covariance + b[i].indirect_covariance;
      const vec3 d = a[i].indirect - b[i].indirect;
      const auto expected = static_cast<double>(variance[c] + variance[next] - 2 * covariance[c]);
      const auto difference = static_cast<double>(d[c] - d[next]);
      squares.add(difference * difference / expected);
      together += expected, apart += static_cast<double>(variance[c] + variance[next]);
    }
    EXPECT_GT(squares.mean(), 0.8) << c;
    EXPECT_LT(squares.mean(), 1.6) << c << ": variances from 16 batches are too small as often as too large";
    EXPECT_LT(together, 0.9 * apart) << "channels share their paths";
  }
}

TEST(SurfaceIrradiance, BatchesNeedNotDivideThePaths) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::PathTracer tracer(scene);
  const double exact = pi_d * (0.5 + 0.25);
  for (const int paths : {1, 3, 21}) {
    Samples mean;
    for (const auto& e : tracer.surface_irradiance(wall_points(300), {3, 1, paths, 5}, {})) {
      mean.add(static_cast<double>(e.indirect.x));
      EXPECT_EQ(std::isinf(e.indirect_variance.x), paths == 1);
    }
    EXPECT_TRUE(mean_is(mean, exact, {1e-3, 3}, 1e-5)) << paths;
  }
}

TEST(SurfaceIrradiance, DirectLightIsTheSumOfATransportScenesGroups) {
  const scene::Scene scene = furnished_room();
  const trace::PathTracer tracer(scene);
  const trace::TransportScene source(scene);
  const std::vector<mat4> poses(1, mat4(1));
  const auto light = source.direct_light(source.lights(0), poses);
  const auto points = wall_points(300, 8);
  std::vector<vec3> sum(points.size(), vec3(0)), one(points.size());
  for (int g = 0; g < static_cast<int>(source.light_groups().size()); ++g) {
    light->irradiance(g, points, one);
    for (std::size_t i = 0; i < points.size(); ++i) sum[i] += one[i];
  }
  const auto truth = tracer.surface_irradiance(points, {1, 1, 256, 1}, {});
  Samples difference;
  for (std::size_t i = 0; i < points.size(); ++i) {
    difference.add(static_cast<double>(sum[i].x - truth[i].direct.x));
    EXPECT_EQ(truth[i].indirect, vec3(0));
  }
  EXPECT_LT(std::sqrt(difference.variance()), 0.1) << "of about 1.5";
  EXPECT_TRUE(mean_is(difference, 0, {}, 1e-5));
}

TEST(SurfaceIrradiance, AgreesWithARenderOfTheSameWall) {
  // A Lambertian surface of albedo ρ shows ρ E/π.
  const scene::Scene scene = furnished_room();
  const trace::PathTracer tracer(scene);
  const SurfacePoint floor{vec3(0.5f, -1, -0.4f)};
  Samples direct, indirect;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto e = tracer.surface_irradiance({&floor, 1}, {4, 1, 512, seed}, {})[0];
    direct.add(static_cast<double>(e.direct.x)), indirect.add(static_cast<double>(e.indirect.x));
  }
  trace::RenderParams params = view_point(floor.position, 64, 4);
  trace::RenderState state;
  tracer.render(params, state);
  const double scale = pi_d / 0.7;
  const auto scaled = [&](const image::Image& image) {
    Samples samples;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) samples.add(scale * static_cast<double>(image.at(x, y)[0]));
    }
    return samples;
  };
  EXPECT_TRUE(means_agree(direct, scaled(state.direct), {1e-3, 2}, 1e-4));
  EXPECT_TRUE(means_agree(indirect, scaled(state.indirect), {1e-3, 2}, 1e-4));
}

TEST(SurfaceIrradiance, SameBitsForAnyThreadCountAndCancellable) {
  const scene::Scene scene = furnished_room();
  const trace::PathTracer tracer(scene);
  const auto points = wall_points(20);
  const auto all = tracer.surface_irradiance(points, {3, 1, 32, 1}, {});
  set_thread_count(1);
  const auto one = tracer.surface_irradiance(points, {3, 1, 32, 1}, {});
  set_thread_count(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(all[i].direct, one[i].direct);
    EXPECT_EQ(all[i].indirect, one[i].indirect);
    EXPECT_EQ(all[i].indirect_variance, one[i].indirect_variance);
    EXPECT_EQ(all[i].indirect_covariance, one[i].indirect_covariance);
  }
  CancelToken cancel;
  cancel.request();
  EXPECT_THROW(tracer.surface_irradiance(points, {3, 1, 32, 1}, {nullptr, &cancel}), Cancelled);
}

}  // namespace
}  // namespace ssphh::test
