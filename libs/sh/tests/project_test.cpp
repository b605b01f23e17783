#include <gtest/gtest.h>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using test::random_sh;

struct Cube {
  int size, channels;
  std::vector<float> texels[6];

  CubeFaces faces() const { return {texels[0], texels[1], texels[2], texels[3], texels[4], texels[5]}; }
};

template <class Radiance>
Cube make_cube(int size, int channels, const Radiance& radiance) {
  Cube cube{size, channels, {}};
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const vec3 c = radiance(texel_direction(face, x, y, size));
        cube.texels[face].insert(cube.texels[face].end(), {c.x, c.y, c.z});
        if (channels == 4) cube.texels[face].push_back(1e9f);  // alpha must not be read as light
      }
    }
  }
  return cube;
}

// Texel by texel in double precision.
RadianceSh project_cube_slowly(int degree, const Cube& cube) {
  std::array<double, max_coefficient_count> basis{};
  std::array<glm::dvec3, max_coefficient_count> sums{};
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < cube.size; ++y) {
      for (int x = 0; x < cube.size; ++x) {
        eval_basis(degree, glm::normalize(glm::dvec3(texel_direction(face, x, y, cube.size))), basis);
        const float* p = &cube.texels[face][(y * cube.size + x) * cube.channels];
        for (std::size_t k = 0; k < basis.size(); ++k) {
          sums[k] += basis[k] * texel_solid_angle(x, y, cube.size) * glm::dvec3(p[0], p[1], p[2]);
        }
      }
    }
  }
  RadianceSh sh(degree);
  for (int k = 0; k < coefficient_count(degree); ++k) sh[k] = vec3(sums[k]);
  return sh;
}

TEST(ProjectCube, EqualsTheSlowSumForOddEvenAndRaggedSizes) {
  for (const int size : {1, 2, 3, 5, 8, 13, 16, 22, 64}) {
    for (const int channels : {3, 4}) {
      // Independent noise in every texel: any mix-up of texels, faces or signs shows.
      Pcg32 random(static_cast<std::uint64_t>(size));
      const Cube cube = make_cube(size, channels, [&](const vec3&) { return random.uniform3(); });
      const RadianceSh fast = project_cube(max_degree, size, cube.faces(), channels);
      // Sums of terms up to 4π · 1.3 in single-precision lanes.
      EXPECT_LT(largest_difference(fast, project_cube_slowly(max_degree, cube)), 1e-5f)
          << size << ' ' << channels;
    }
  }
}

TEST(ProjectCube, LowDegreesAreThePrefixOfHighOnes) {
  Pcg32 random(9);
  const Cube cube = make_cube(16, 3, [&](const vec3&) { return random.uniform3(); });
  const RadianceSh full = project_cube(max_degree, 16, cube.faces());
  for (int degree = 0; degree < max_degree; ++degree) {
    const RadianceSh sh = project_cube(degree, 16, cube.faces());
    for (int k = 0; k < coefficient_count(degree); ++k) EXPECT_EQ(sh[k], full[k]) << degree << ' ' << k;
  }
}

TEST(ProjectCube, ConstantFieldHasOnlyBandZero) {
  const Cube cube = make_cube(64, 3, [](const vec3&) { return vec3(1, 2, 0.5f); });
  const RadianceSh sh = project_cube(max_degree, 64, cube.faces());
  // Solid angles sum to 4π to 1e-6.
  EXPECT_LT(largest_difference(sh[0], vec3(1, 2, 0.5f) * std::sqrt(4 * pi)), 1e-5f);
  for (int l = 1; l <= max_degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      // Texel centres do not integrate high even bands exactly: the error falls with size² and is 2e-4 here.
      EXPECT_LT(max_component(glm::abs(sh[coefficient_index(l, m)])), 2e-3f) << l << ' ' << m;
    }
  }
}

TEST(ProjectCube, RecoversABandLimitedFunction) {
  const RadianceSh truth = random_sh(4, 5);
  const auto error = [&](int size) {
    const Cube cube = make_cube(size, 3, [&](const vec3& d) { return eval(truth, d); });
    return largest_difference(project_cube(4, size, cube.faces()), truth);
  };
  // Midpoint rule: second order in the texel's size. A factor 4 per halving, 3 allowed.
  EXPECT_LT(error(64), 2e-3f);
  EXPECT_LT(3 * error(64), error(32));
}

TEST(ProjectCube, IsTheSameBitsEveryTime) {
  Pcg32 random(4);
  const Cube cube = make_cube(20, 3, [&](const vec3&) { return random.uniform3(); });
  EXPECT_EQ(project_cube(7, 20, cube.faces()), project_cube(7, 20, cube.faces()));
}

TEST(ProjectCube, OneBadTexelIsNotHidden) {
  Cube cube = make_cube(8, 3, [](const vec3&) { return vec3(1); });
  cube.texels[3][17] = NAN;
  EXPECT_FALSE(is_finite(project_cube(2, 8, cube.faces())[0]));
}

TEST(ProjectSamples, EqualsTheDoublePrecisionSum) {
  Pcg32 random(6);
  for (const std::size_t count : {0u, 1u, 8u, 100u, 5000u}) {
    std::vector<vec3> directions, radiance;
    std::vector<float> weights;
    std::vector<double> double_weights;
    std::array<glm::dvec3, max_coefficient_count> sums{};
    std::array<double, max_coefficient_count> basis{};
    for (std::size_t i = 0; i < count; ++i) {
      directions.push_back(vec3(test::random_direction(random)));
      radiance.push_back(random.uniform3());
      weights.push_back(random.uniform() / static_cast<float>(count));
      double_weights.push_back(static_cast<double>(weights.back()));
      eval_basis(max_degree, glm::dvec3(directions.back()), basis);
      for (std::size_t k = 0; k < basis.size(); ++k) {
        sums[k] += double_weights.back() * basis[k] * glm::dvec3(radiance.back());
      }
    }
    const RadianceSh sh = project(max_degree, directions, weights, radiance);
    for (int k = 0; k < max_coefficient_count; ++k) {
      // Weights sum to about ½: single-precision rounding of terms below 1.
      EXPECT_LT(largest_difference(sh[k], vec3(sums[k])), 2e-6f);
    }
    EXPECT_EQ(project(max_degree, directions, double_weights, radiance), sh);
  }
}

TEST(ProjectFunction, QuadratureIsExactForBandLimitedFunctions) {
  const RadianceSh truth = random_sh(max_degree, 7);
  const RadianceSh sh =
      project(max_degree, sphere_quadrature(2 * max_degree), [&](const vec3& d) { return eval(truth, d); });
  // Single-precision evaluation of 121 terms of size ~1.
  EXPECT_LT(largest_difference(sh, truth), 2e-5f);
}

TEST(ProjectFunction, StratifiedSamplesAreUnbiased) {
  const auto lobe = [](const vec3& d) { return vec3(std::exp(4 * (d.y - 1)), d.x * d.x, 1); };
  const RadianceSh truth = project(3, sphere_quadrature(60), lobe);
  constexpr int runs = 200;
  std::array<glm::dvec3, 16> sum{}, square{};
  for (int run = 0; run < runs; ++run) {
    const RadianceSh sh = project(3, stratified_sphere_samples(8, static_cast<std::uint64_t>(run)), lobe);
    for (std::size_t k = 0; k < 16; ++k) {
      sum[k] += glm::dvec3(sh.values[k]);
      square[k] += glm::dvec3(sh.values[k]) * glm::dvec3(sh.values[k]);
    }
  }
  for (std::size_t k = 0; k < 16; ++k) {
    for (int c = 0; c < 3; ++c) {
      const double mean = sum[k][c] / runs;
      const double variance = std::max(0.0, square[k][c] / runs - mean * mean) / (runs - 1);
      // 48 two-sided tests at 4.5 σ: a false alarm in 3e-4 of seeds. 1e-6: rounding where the variance is 0.
      EXPECT_NEAR(mean, static_cast<double>(truth.values[k][c]), 4.5 * std::sqrt(variance) + 1e-6)
          << k << ' ' << c;
    }
  }
}

TEST(ProjectFunction, StratificationBeatsIndependentSamples) {
  const auto smooth = [](const vec3& d) { return vec3(d.y * d.y); };
  const double truth = 4 * pi_d / 3 / std::sqrt(4 * pi_d);
  constexpr int side = 16, runs = 100;
  double square = 0;
  for (int run = 0; run < runs; ++run) {
    const double error =
        static_cast<double>(
            project(0, stratified_sphere_samples(side, static_cast<std::uint64_t>(run)), smooth)[0].x) -
        truth;
    square += error * error / runs;
  }
  // Independent samples: Var(y²) (4π Y₀₀)² / side² with Var(y²) = 1/5 − 1/9. Stratification removes most of
  // it.
  const double independent = (1.0 / 5 - 1.0 / 9) * 4 * pi_d / (side * side);
  EXPECT_LT(square, 0.1 * independent);
}

TEST(Reconstruct, BatchEqualsSingle) {
  const RadianceSh sh = random_sh(6, 8);
  const std::vector<vec3> directions = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
  std::vector<vec3> out(3);
  eval(sh, directions, out);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(out[i], eval(sh, directions[i]));
  EXPECT_EQ(eval(RadianceSh(), vec3(0, 0, 1)), vec3(0));
}

}  // namespace
}  // namespace ssphh::sh
