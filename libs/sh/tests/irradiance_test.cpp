#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>

#include "known_vectors.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;

const vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// Values of the published coefficients, computed elsewhere to six digits: tolerance 1e-5.
void expect_on_axes(const RadianceSh& radiance, const vec3 (&expected)[6]) {
  for (int i = 0; i < 6; ++i) {
    EXPECT_LT(largest_difference(irradiance(radiance, axes[i]), expected[i]), 1e-5f) << "axis " << i;
    EXPECT_LT(largest_difference(irradiance_polynomial(radiance, axes[i]), expected[i]), 1e-5f)
        << "axis " << i;
  }
}

TEST(Irradiance, OfGraceCathedralIsAsPublished) {
  expect_on_axes(test::grace_cathedral(), {{.529906f, .330607f, .395827f},
                                           {1.127795f, .444442f, .376507f},
                                           {1.051097f, .792188f, 1.265791f},
                                           {.242690f, .076084f, .027812f},
                                           {.274503f, .153835f, .131316f},
                                           {.969833f, .527063f, .682684f}});
}

TEST(Irradiance, OfStPetersIsAsPublished) {
  expect_on_axes(test::st_peters_basilica(), {{.343752f, .260451f, .236318f},
                                              {.272836f, .214773f, .215575f},
                                              {.558566f, .412177f, .352078f},
                                              {.198533f, .118223f, .094083f},
                                              {.251332f, .184499f, .168351f},
                                              {.301948f, .205222f, .170551f}});
}

// The three ways of computing it, over the whole sphere.
TEST(Irradiance, PolynomialAndMatrixEqualTheConvolution) {
  for (const RadianceSh& probe :
       {test::grace_cathedral(), test::eucalyptus_grove(), test::st_peters_basilica()}) {
    const IrradianceSh convolved = irradiance_from_radiance(probe);
    const IrradianceMatrices matrices = irradiance_matrices(probe);
    for (int i = 0; i < 500; ++i) {
      const vec3 n = spherical_fibonacci(i, 500);
      const vec3 truth = irradiance(probe, n);
      // Eight-digit constants and single precision.
      EXPECT_LT(largest_difference(irradiance_polynomial(probe, n), truth), 1e-6f);
      EXPECT_LT(largest_difference(irradiance(matrices, n), truth), 1e-6f);
      EXPECT_LT(largest_difference(eval(convolved, n), truth), 1e-6f);
    }
  }
}

TEST(Irradiance, OfEucalyptusGroveMatchesTheRoundedTableOfThePaper) {
  // The same probe to the two digits of the paper's table, here L00, L1-1, L20: rounding below half a digit.
  const RadianceSh probe = test::eucalyptus_grove();
  EXPECT_LT(largest_difference(probe[0], vec3(.38f, .43f, .45f)), 0.005f);
  EXPECT_LT(largest_difference(probe[1], vec3(.29f, .36f, .41f)), 0.005f);
  EXPECT_LT(largest_difference(probe[6], vec3(-.09f, -.13f, -.15f)), 0.005f);
}

TEST(Irradiance, PolynomialTakesMissingBandsAsZero) {
  RadianceSh constant(0);
  constant[0] = vec3(std::sqrt(4 * pi));
  EXPECT_LT(largest_difference(irradiance_polynomial(constant, axes[2]), vec3(pi)), 1e-5f);
  EXPECT_EQ(irradiance_polynomial(RadianceSh(), axes[2]), vec3(0));
  EXPECT_EQ(irradiance(RadianceSh(), axes[2]), vec3(0));
}

TEST(CosineBandFactor, EqualsTheLegendreIntegralOfTheClampedCosine) {
  // A_l = 2π ∫₀¹ t P_l(t) dt; the integrand is a polynomial, so 8 nodes on [0, 1] are exact.
  const LineQuadrature rule = gauss_legendre(8);
  for (int l = 0; l <= max_degree; ++l) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double t = 0.5 * (rule.nodes[i] + 1);
      sum += 0.5 * rule.weights[i] * 2 * pi_d * t * std::legendre(static_cast<unsigned>(l), t);
    }
    EXPECT_NEAR(cosine_band_factor(l), sum, 1e-14) << l;
  }
  EXPECT_DOUBLE_EQ(cosine_band_factor(4), -pi_d / 24);
  EXPECT_DOUBLE_EQ(cosine_band_factor(6), pi_d / 64);
}

TEST(Irradiance, EqualsTheIntegralOverTheHemisphere) {
  const RadianceSh radiance = test::random_sh(max_degree, 3);
  const LineQuadrature polar = gauss_legendre(12);
  for (const vec3& n : {glm::normalize(vec3(1, 2, -1)), vec3(0, 0, 1), vec3(-1, 0, 0)}) {
    // Degree 11 polynomial in cosθ once the azimuth is summed: 12 nodes on [0, 1] and 21 azimuths are exact.
    const Frame frame = Frame::around(n);
    vec3 sum(0);
    for (std::size_t i = 0; i < polar.nodes.size(); ++i) {
      const float z = static_cast<float>(0.5 * (polar.nodes[i] + 1)), r = std::sqrt(1 - z * z);
      for (int j = 0; j < 21; ++j) {
        const float azimuth = 2 * pi * static_cast<float>(j) / 21;
        const vec3 d = frame.to_world({r * std::cos(azimuth), r * std::sin(azimuth), z});
        sum += eval(radiance, d) * (z * static_cast<float>(0.5 * polar.weights[i]) * 2.0f * pi / 21.0f);
      }
    }
    // Single precision over 252 terms of size ~5.
    EXPECT_LT(largest_difference(irradiance(radiance, n), sum), 5e-5f);
  }
}

TEST(Irradiance, OfAConstantFieldIsPiTimesRadiance) {
  RadianceSh radiance(max_degree);
  radiance[0] = vec3(2, 1, 0.5f) * std::sqrt(4 * pi);
  for (const vec3& n : axes)
    EXPECT_LT(largest_difference(irradiance(radiance, n), pi * vec3(2, 1, 0.5f)), 1e-5f);
}

}  // namespace
}  // namespace ssphh::sh
