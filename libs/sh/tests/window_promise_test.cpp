// Windows band by band against other forms of their formulas, and what minimum() and choose_window() promise
// of troughs that fall between their samples.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

// sin x / x by Viète's product of cosines.
double sinc(double x) {
  double product = 1;
  for (int k = 1; k <= 60; ++k) product *= std::cos(std::ldexp(x, -k));
  return product;
}

TEST(Window, HasItsClosedFormAtEveryBand) {
  for (const double width : {0.5, 1.0, 1.7, 4.0, 7.3, 10.0, 10.5, 11.0, 40.0, 1e3}) {
    const BandScales hanning = hanning_window(width), lanczos = lanczos_window(width);
    for (int l = 0; l <= max_degree; ++l) {
      const auto i = static_cast<std::size_t>(l);
      const double half_turns = l / width;
      const double inside = l == 0 || half_turns < 1 ? 1 : 0;
      EXPECT_NEAR(hanning[i], inside * std::pow(std::cos(0.5 * pi_d * half_turns), 2), 1e-7)
          << width << ' ' << l;
      EXPECT_NEAR(lanczos[i], inside * sinc(pi_d * half_turns), 1e-7) << width << ' ' << l;
    }
  }
}

TEST(Window, ScalesEveryCoefficientByTheFactorOfItsBand) {
  BandScales scales;
  for (std::size_t l = 0; l < scales.size(); ++l) scales[l] = 1 / (1.5f + static_cast<float>(l));
  for (const int degree : {0, 3, max_degree}) {
    const RadianceSh sh = test::random_sh(degree, 5), windowed = apply_window(sh, scales);
    ASSERT_EQ(windowed.degree(), degree);
    for (int k = 0; k < coefficient_count(degree); ++k) {
      const int l = static_cast<int>(std::sqrt(k + 0.5));
      EXPECT_EQ(windowed[k], sh[k] * scales[l]) << k;
    }
  }
}

TEST(GlossyLobe, GaussianHasItsClosedFormAtEveryBand) {
  // Eigenvalue l (l + 1) of the Laplacian, as a sum: 2 (1 + 2 + … + l).
  for (const double sigma : {0.01, 0.2, 0.7}) {
    double eigenvalue = 0;
    for (int l = 0; l <= max_degree; ++l) {
      eigenvalue += 2 * l;
      EXPECT_NEAR(std::log(gaussian_band_scale(sigma, l)), -eigenvalue * sigma * sigma / 2, 1e-12)
          << sigma << ' ' << l;
    }
  }
}

/// Adds a trough of a degree, the steepest there is: −`depth` toward `axis`, mean 0.
void add_trough(RadianceSh& sh, int channel, const vec3& axis, double depth) {
  const int degree = sh.degree();
  std::vector<float> basis(static_cast<std::size_t>(coefficient_count(degree)));
  eval_basis(degree, axis, basis);
  // Addition theorem: Σ_k Y_k² over bands 1..degree.
  const double peak = (coefficient_count(degree) - 1) / (4 * pi_d);
  for (int k = 1; k < coefficient_count(degree); ++k)
    sh[k][channel] -= static_cast<float>(depth / peak * static_cast<double>(basis[k]));
}

/// `mean` of a channel.
void add_mean(RadianceSh& sh, int channel, double mean) {
  sh[0][channel] += static_cast<float>(mean * std::sqrt(4 * pi_d));
}

// What minimum() and choose_window() sample, and the candidates' direction that lies farthest from it.
constexpr int sample_count = 2562;
vec3 direction_between_samples() {
  Pcg32 random(1);
  vec3 farthest(0);
  float smallest_cosine = 1;
  for (int i = 0; i < 400; ++i) {
    const vec3 candidate = sample_uniform_sphere(random.uniform2());
    float cosine = -1;
    for (int s = 0; s < sample_count; ++s)
      cosine = std::max(cosine, glm::dot(candidate, spherical_fibonacci(s, sample_count)));
    if (cosine < smallest_cosine) smallest_cosine = cosine, farthest = candidate;
  }
  return farthest;
}

TEST(Minimum, IsThatOfATroughInAnyDirection) {
  Pcg32 random(2);
  for (const int degree : {1, 2, 5, max_degree}) {
    for (int i = 0; i < 10; ++i) {
      RadianceSh sh(degree);
      for (int c = 0; c < 3; ++c) {
        add_trough(sh, c, sample_uniform_sphere(random.uniform2()), 1 + c);
        add_mean(sh, c, 0.5 * c);
      }
      const vec3 found = minimum(sh);
      // 1e-6 of the function's range, and rounding of 121 single-precision coefficients.
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], 0.5 * c - (1 + c), 2e-6 * (1 + c)) << degree << ' ' << c;
    }
  }
}

TEST(Minimum, IsTheDeeperOfTwoTroughsThoughASampleHitsTheOther) {
  const vec3 hidden = direction_between_samples();
  RadianceSh sh(max_degree);
  int opposite = 0;
  for (int i = 0; i < sample_count; ++i) {
    if (glm::dot(spherical_fibonacci(i, sample_count), hidden) <
        glm::dot(spherical_fibonacci(opposite, sample_count), hidden))
      opposite = i;
  }
  add_trough(sh, 1, spherical_fibonacci(opposite, sample_count), 0.985);
  add_trough(sh, 1, hidden, 1);
  const vec3 at_sample = eval(sh, spherical_fibonacci(opposite, sample_count)), deeper = eval(sh, hidden);
  ASSERT_LT(deeper.y, at_sample.y - 0.01f);
  EXPECT_NEAR(minimum(sh).y, deeper.y, 1e-3f);  // each trough tilts the other's floor a little
}

TEST(Dering, FindsATroughBetweenItsSamples) {
  const vec3 hidden = direction_between_samples();
  for (int degree = 4; degree <= max_degree; ++degree) {
    for (int c = 0; c < 3; ++c) {
      RadianceSh sh(degree);
      for (int other = 0; other < 3; ++other) add_mean(sh, other, 5);
      add_trough(sh, c, hidden, 5.01);  // 0.01 below zero, and far above it at the nearest sample
      ASSERT_LT(minimum(sh)[c], -0.009f);
      const AutoWindow window = choose_window(sh, NonNegative::radiance);
      EXPECT_TRUE(window.reached);
      ASSERT_TRUE(std::isfinite(window.width)) << "degree " << degree << ", channel " << c;
      EXPECT_GE(minimum(apply_window(sh, lanczos_window(window.width)))[c], 0) << degree;
      EXPECT_LT(minimum(apply_window(sh, lanczos_window(1.01 * window.width)))[c], 0) << degree;
    }
  }
}

TEST(Dering, LeavesAFunctionThatJustStaysAboveZero) {
  for (int degree = 1; degree <= max_degree; ++degree) {
    RadianceSh sh(degree);
    for (int c = 0; c < 3; ++c) {
      add_mean(sh, c, 5);
      add_trough(sh, c, glm::normalize(vec3(1 + c, -2, degree)), 4.999);
    }
    EXPECT_EQ(choose_window(sh, NonNegative::radiance).width, std::numeric_limits<double>::infinity());
    EXPECT_EQ(dering(sh, NonNegative::radiance), sh) << degree;
  }
}

TEST(Dering, AFunctionWithoutBandsHasTheMinimumOfItsMean) {
  RadianceSh sh(0);
  sh[0] = vec3(1, -2, 0.5f);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(minimum(sh)[c], 0.2820948f * sh[0][c]);
  EXPECT_EQ(minimum(RadianceSh()), vec3(0));
}

}  // namespace
}  // namespace ssphh::sh
