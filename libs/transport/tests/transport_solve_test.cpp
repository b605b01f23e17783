/// Solver and projector against slow references, packing against its stated errors.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/transport/gbuffer.h>
#include <ssphh/transport/projection.h>
#include <ssphh/transport/solve.h>

namespace ssphh::transport {
namespace {

/// A random closed or open network with its dense matrix.
struct RandomNetwork {
  std::vector<Link> links;
  LinkRows rows;
  std::vector<vec3> albedo;
  std::vector<Irradiance4> direct;
  std::vector<std::vector<double>> dense;  ///< F

  RandomNetwork(std::size_t count, std::size_t per_row, float row_sum, float largest_albedo,
                std::uint64_t seed)
      : albedo(count), direct(count), dense(count, std::vector<double>(count, 0)) {
    Pcg32 rng(seed);
    links.reserve(count * per_row);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < per_row; ++k) {
        const auto j = static_cast<std::uint32_t>(rng.uniform() * static_cast<float>(count));
        links.push_back({j, row_sum / static_cast<float>(per_row)});
        dense[i][j] += double(links.back().weight);
      }
      albedo[i] = largest_albedo * rng.uniform3();
      direct[i] = vec4(rng.uniform3(), 0);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const Link> row(links.data() + i * per_row, per_row);
      rows.rows.push_back({row.first(per_row / 2), row.subspan(per_row / 2)});
    }
  }

  /// E = (I − Fρ)⁻¹ Fρ E_direct by Gaussian elimination.
  std::vector<double> exact(int channel) const {
    const std::size_t n = albedo.size();
    std::vector<std::vector<double>> a(n, std::vector<double>(n + 1, 0));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double t = dense[i][j] * double(albedo[j][channel]);
        a[i][j] = (i == j ? 1 : 0) - t;
        a[i][n] += t * double(direct[j][channel]);
      }
    }
    for (std::size_t p = 0; p < n; ++p) {
      std::size_t best = p;
      for (std::size_t i = p + 1; i < n; ++i) {
        if (std::abs(a[i][p]) > std::abs(a[best][p])) best = i;
      }
      std::swap(a[p], a[best]);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == p) continue;
        const double f = a[i][p] / a[p][p];
        for (std::size_t j = p; j <= n; ++j) a[i][j] -= f * a[p][j];
      }
    }
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = a[i][n] / a[i][i];
    return x;
  }
};

TEST(TransportSolve, EqualsGaussianElimination) {
  for (const float largest : {0.3f, 0.7f, 0.95f}) {
    const RandomNetwork network(60, 12, 1, largest, 7);
    std::vector<Irradiance4> indirect;
    const Contraction bounds = contraction(network.rows, network.albedo);
    Solver solver;
    const SolveReport report =
        solver.solve(network.rows, network.albedo, network.direct, bounds.upper, {1e-5f, 300}, indirect);
    EXPECT_TRUE(report.converged);
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> exact = network.exact(c);
      for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(double(indirect[i][c]), exact[i], 1e-4 * exact[i] + 1e-6) << largest << " " << i;
    }
  }
}

TEST(TransportSolve, ClosedBoxOfEqualAlbedoReachesTheGeometricSeries) {
  // Every surfel sees all others with weights that sum to 1 and gets E_direct = 1: E = ρ / (1 − ρ).
  for (const float rho : {0.5f, 0.8f, 0.95f}) {
    RandomNetwork network(40, 40, 1, 1, 3);
    std::fill(network.albedo.begin(), network.albedo.end(), vec3(rho));
    std::fill(network.direct.begin(), network.direct.end(), Irradiance4(1, 1, 1, 0));
    const Contraction bounds = contraction(network.rows, network.albedo);
    EXPECT_NEAR(bounds.upper, double(rho), 1e-5);
    EXPECT_NEAR(bounds.lower, double(rho), 1e-5);
    std::vector<Irradiance4> indirect;
    Solver solver;
    const SolveReport report =
        solver.solve(network.rows, network.albedo, network.direct, bounds.upper, {1e-5f, 300}, indirect);
    for (const Irradiance4& e : indirect) EXPECT_NEAR(e.x, rho / (1 - rho), 2e-4f * rho / (1 - rho));
    EXPECT_LT(report.iterations, rho > 0.9f ? 60 : 25) << "plain iteration would take 220 and 13..50";
  }
}

TEST(TransportSolve, ContractionEnclosesTheSpectralRadius) {
  const RandomNetwork network(50, 9, 0.9f, 0.8f, 11);
  const Contraction bounds = contraction(network.rows, network.albedo, 30);
  // The radius by many steps of the dense power iteration.
  std::vector<double> x(50, 1), y(50);
  double radius = 0;
  for (int step = 0; step < 500; ++step) {
    double norm = 0;
    for (std::size_t i = 0; i < 50; ++i) {
      y[i] = 0;
      for (std::size_t j = 0; j < 50; ++j)
        y[i] += network.dense[i][j] * double(max_component(network.albedo[j])) * x[j];
      norm = std::max(norm, y[i]);
    }
    radius = norm;
    for (std::size_t i = 0; i < 50; ++i) x[i] = y[i] / norm;
  }
  EXPECT_LE(bounds.lower, radius + 1e-12);
  EXPECT_GE(bounds.upper, radius - 1e-12);
  EXPECT_LT(bounds.upper - bounds.lower, 0.05 * radius);
}

TEST(TransportSolve, SameBitsForAnyNumberOfThreadsAndOneStepFromTheAnswer) {
  const RandomNetwork network(3000, 40, 0.98f, 0.9f, 5);
  const double bound = contraction(network.rows, network.albedo).upper;
  std::vector<std::vector<Irradiance4>> results;
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    std::vector<Irradiance4> indirect;
    Solver solver;
    solver.solve(network.rows, network.albedo, network.direct, bound, {}, indirect);
    results.push_back(indirect);
  }
  set_thread_count(0);
  EXPECT_EQ(results[0], results[1]);
  Solver solver;
  EXPECT_LE(
      solver.solve(network.rows, network.albedo, network.direct, bound, {2e-3f, 300}, results[0]).iterations,
      2)
      << "a warm start has little to do";
}

TEST(TransportSolve, AnEmptyNetworkAndDarknessGiveNothing) {
  Solver solver;
  std::vector<Irradiance4> indirect;
  EXPECT_TRUE(solver.solve({}, {}, {}, 0, {}, indirect).converged);
  RandomNetwork network(10, 3, 1, 0.5f, 2);
  std::fill(network.direct.begin(), network.direct.end(), Irradiance4(0));
  EXPECT_TRUE(solver.solve(network.rows, network.albedo, network.direct, 0.5, {}, indirect).converged);
  for (const Irradiance4& e : indirect) EXPECT_EQ(e, Irradiance4(0));
}

TEST(DirectionProjector, EqualsTheSumOverDirections) {
  Pcg32 rng(1);
  for (const int count : {8, 97, 384}) {
    std::vector<vec3> directions;
    for (int q = 0; q < count; ++q) directions.push_back(spherical_fibonacci(q, count));
    for (const int degree : {0, 1, 2, 4, 10}) {
      const DirectionProjector projector(degree, directions);
      std::vector<float> radiance(3 * projector.stride(), 0.0f);
      std::vector<glm::dvec3> expected(static_cast<std::size_t>(sh::coefficient_count(degree)),
                                       glm::dvec3(0));
      std::vector<double> basis(expected.size());
      for (std::size_t q = 0; q < directions.size(); ++q) {
        const vec3 light = rng.uniform3();
        for (std::size_t c = 0; c < 3; ++c)
          radiance[c * projector.stride() + q] = light[static_cast<glm::length_t>(c)];
        sh::eval_basis(degree, glm::normalize(glm::dvec3(directions[q])), basis);
        for (std::size_t k = 0; k < basis.size(); ++k)
          expected[k] += 4 * pi_d / count * basis[k] * glm::dvec3(light);
      }
      sh::RadianceSh out(degree);
      projector.project(radiance, out);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        for (glm::length_t c = 0; c < 3; ++c)
          EXPECT_NEAR(double(out.values[k][c]), expected[k][c], 2e-5) << count << " " << degree << " " << k;
      }
    }
  }
}

TEST(PackedHit, KeepsNormalAndAlbedoWithinTheStatedErrors) {
  EmissionPalette palette;
  float worst_angle = 0, worst_albedo = 0;
  Pcg32 rng(4);
  for (int i = 0; i < 20000; ++i) {
    rays::RayHit hit;
    hit.normal = i < 6 ? vec3(i == 0, i == 1, i == 2) - vec3(i == 3, i == 4, i == 5)
                       : sample_uniform_sphere(rng.uniform2());
    hit.albedo = rng.uniform3();
    hit.distance = rng.uniform();
    hit.back = i % 2;
    const PackedHit packed = pack_hit(hit, 3, palette);
    worst_angle = std::max(worst_angle, glm::length(glm::cross(unpack_normal(packed), hit.normal)));
    EXPECT_GT(glm::dot(unpack_normal(packed), hit.normal), 0.9f);
    worst_albedo = std::max(worst_albedo, max_component(glm::abs(unpack_albedo(packed) - hit.albedo)));
    EXPECT_EQ(packed.distance, hit.distance);
    EXPECT_EQ((packed.albedo_and_back >> 30) & 1, hit.back ? 1u : 0u);
    EXPECT_EQ(packed.part, 3);
  }
  EXPECT_LT(glm::degrees(worst_angle), 0.01f);
  EXPECT_LT(worst_albedo, 5e-4f);
}

TEST(EmissionPalette, FindsWhatWasAddedAndKeepsGroupsWhenFull) {
  EmissionPalette palette;
  EXPECT_EQ(palette.add(vec3(0), 0), 0);
  EXPECT_EQ(palette.add(vec3(1), -1), 0);
  const std::uint16_t lamp = palette.add({4, 2, 1}, 1);
  EXPECT_EQ(palette.add({4, 2, 1}, 1), lamp);
  EXPECT_NE(palette.add({4, 2, 1}, 2), lamp);
  EXPECT_EQ(palette.find({4, 2, 1}, 1), lamp);
  EXPECT_EQ(palette.find({5, 2, 1}, 1), 0);
  EXPECT_EQ(palette[lamp].radiance, vec3(4, 2, 1));
  Pcg32 rng(1);
  for (int i = 0; i < 200000; ++i) {
    const vec3 radiance = 0.1f + 10.0f * rng.uniform3();
    const std::uint16_t index = palette.add(radiance, i % 3);
    ASSERT_EQ(palette[index].group, i % 3);
  }
  EXPECT_EQ(palette.size(), 65536u);
}

}  // namespace
}  // namespace ssphh::transport
