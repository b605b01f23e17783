#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/zonal.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using test::random_sh;

double bump(double cos_theta) {
  return std::exp(3 * (cos_theta - 1));
}

TEST(Zonal, CoefficientsAreTheProjectionOfTheLobe) {
  const ZonalSh zonal = zonal_from_function(max_degree, bump);
  const RadianceSh truth = project(max_degree, sphere_quadrature(80), [](const vec3& d) {
    return vec3(static_cast<float>(bump(static_cast<double>(d.z))));
  });
  for (int l = 0; l <= max_degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double expected = m == 0 ? zonal[l] : 0;
      EXPECT_NEAR(truth[coefficient_index(l, m)].x, expected, 1e-6)
          << l << ' ' << m;  // lobe rounded to float
    }
  }
}

TEST(Zonal, EvaluatesToTheSameAsTheFullSeries) {
  const ZonalSh zonal = zonal_from_function(8, bump);
  std::vector<float> full(coefficient_count(8));
  rotate_zonal(zonal, vec3(0, 0, 1), full);
  RadianceSh sh(8);
  for (int k = 0; k < coefficient_count(8); ++k) sh[k] = vec3(full[k]);
  for (int i = 0; i < 50; ++i) {
    const vec3 d = spherical_fibonacci(i, 50);
    EXPECT_NEAR(eval(sh, d).x, eval_zonal(zonal, static_cast<double>(d.z)), 1e-5);  // single precision
  }
}

TEST(Zonal, RotationPointsTheLobeAlongItsAxis) {
  const vec3 axis = glm::normalize(vec3(-1, 2, 0.5f));
  std::vector<float> turned(max_coefficient_count);
  rotate_zonal(zonal_from_function(max_degree, bump), axis, turned);
  const RadianceSh truth = project(max_degree, sphere_quadrature(80), [&](const vec3& d) {
    return vec3(static_cast<float>(bump(static_cast<double>(glm::dot(d, axis)))));
  });
  for (int k = 0; k < max_coefficient_count; ++k) {
    EXPECT_NEAR(turned[k], truth[k].x, 2e-6) << k;  // single precision
  }
}

TEST(Zonal, ConvolutionEqualsTheIntegral) {
  const RadianceSh sh = random_sh(5, 1);
  const RadianceSh convolved = convolve(sh, zonal_from_function(5, bump));
  const SphereQuadrature rule = sphere_quadrature(60);
  for (const vec3& d : {vec3(0, 1, 0), glm::normalize(vec3(1, 1, -2))}) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < rule.directions.size(); ++i) {
      sum += rule.weights[i] * bump(glm::dot(rule.directions[i], glm::dvec3(d))) *
             glm::dvec3(eval(sh, vec3(rule.directions[i])));
    }
    EXPECT_LT(largest_difference(eval(convolved, d), vec3(sum)), 1e-5f);  // single precision
  }
}

TEST(Zonal, CosineLobeConvolvesToIrradiance) {
  const RadianceSh sh = random_sh(max_degree, 2);
  const RadianceSh convolved = convolve(sh, zonal_cosine_lobe(max_degree));
  const IrradianceSh irradiance = irradiance_from_radiance(sh);
  for (int k = 0; k < max_coefficient_count; ++k)
    EXPECT_LT(largest_difference(convolved[k], irradiance[k]), 1e-6f);
  const ZonalSh numeric = zonal_from_function(
      max_degree, [](double x) { return x; }, 0.0, 8);
  for (std::size_t l = 0; l <= max_degree; ++l)
    EXPECT_NEAR(numeric[l], zonal_cosine_lobe(max_degree)[l], 1e-13);
}

TEST(Zonal, ConvolutionWithFewerBandsDropsTheRest) {
  const RadianceSh convolved = convolve(random_sh(4, 1), zonal_cosine_lobe(1));
  for (int k = 4; k < coefficient_count(4); ++k) EXPECT_EQ(convolved[k], vec3(0));
}

// The GGX lobe by brute force over the reflected direction: density D(θ/2) cos θ, θ from the mirror
// direction.
double ggx_band_scale_brute_force(double alpha, int l) {
  constexpr int steps = 400000;
  double sum = 0, norm = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) / steps * pi_d / 2, h = std::cos(theta / 2);
    const double d = h * h * (alpha * alpha - 1) + 1;
    const double weight = std::cos(theta) * std::sin(theta) / (d * d);
    sum += weight * std::legendre(static_cast<unsigned>(l), std::cos(theta));
    norm += weight;
  }
  return sum / norm;
}

TEST(GlossyLobe, BandScalesEqualBruteForceIntegration) {
  for (const double alpha : {0.02, 0.1, 0.5, 1.0}) {
    for (const int l : {0, 1, 4, 10}) {
      // Midpoint rule with 4e5 steps over a peak 0.02 wide.
      EXPECT_NEAR(ggx_band_scale(alpha, l), ggx_band_scale_brute_force(alpha, l), 1e-6) << alpha << ' ' << l;
    }
  }
}

TEST(GlossyLobe, FullyRoughGgxIsTheCosineLobe) {
  // α = 1: D is constant, so only n·l is left.
  for (int l = 0; l <= max_degree; ++l)
    EXPECT_NEAR(ggx_band_scale(1, l), cosine_band_factor(l) / pi_d, 1e-9) << l;
}

TEST(GlossyLobe, TableKeepsItsStatedError) {
  for (int i = 1; i <= 1000; ++i) {
    const float roughness = static_cast<float>(i) / 1000;
    const auto scales = glossy_band_scales(roughness);
    const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
    for (int l = 0; l <= max_degree; ++l) {
      ASSERT_NEAR(scales[l], ggx_band_scale(alpha, l), 1e-3) << roughness << ' ' << l;
    }
  }
}

TEST(GlossyLobe, NarrowsToTheMirrorAndFallsWithRoughnessAndBand) {
  for (int l = 0; l <= max_degree; ++l) {
    EXPECT_EQ(glossy_band_scale(0, l), 1.0f);
    EXPECT_EQ(glossy_band_scale(-1, l), 1.0f);
    EXPECT_EQ(glossy_band_scale(7, l), glossy_band_scale(1, l));
    for (const float roughness : {0.1f, 0.3f, 0.5f}) {
      EXPECT_LE(glossy_band_scale(roughness + 0.1f, l), glossy_band_scale(roughness, l));
    }
  }
  for (int l = 1; l <= max_degree; ++l) EXPECT_LT(glossy_band_scale(0.4f, l), glossy_band_scale(0.4f, l - 1));
}

TEST(GlossyLobe, LookupIsTheConvolvedFunction) {
  const RadianceSh sh = random_sh(6, 3);
  const vec3 mirror = glm::normalize(vec3(1, -2, 0.3f));
  RadianceSh scaled = sh;
  for (int l = 0; l <= 6; ++l) {
    for (int m = -l; m <= l; ++m) scaled[coefficient_index(l, m)] *= glossy_band_scale(0.5f, l);
  }
  EXPECT_LT(largest_difference(eval_glossy(sh, mirror, 0.5f), eval(scaled, mirror)), 1e-5f);
  EXPECT_LT(largest_difference(eval_glossy(sh, mirror, 0), eval(sh, mirror)), 1e-5f);
}

TEST(GlossyLobe, GaussianIsTheHeatKernelOfItsVariance) {
  // For small σ the lobe exp(−θ²/2σ²) in the tangent plane: compare numerically at σ = 0.05.
  const double sigma = 0.05;
  const ZonalSh zonal = zonal_from_function(
      4, [&](double c) { return std::exp((c - 1) / (sigma * sigma)) / (2 * pi_d * sigma * sigma); }, 0.5,
      200);
  for (int l = 0; l <= 4; ++l) {
    const double scale = zonal[l] * std::sqrt(4 * pi_d / (2 * l + 1)) / (zonal[0] * std::sqrt(4 * pi_d));
    // The two differ by terms of order σ⁴ l⁴.
    EXPECT_NEAR(scale, gaussian_band_scale(sigma, l), 1e-3) << l;
  }
}

}  // namespace
}  // namespace ssphh::sh
