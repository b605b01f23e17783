#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <gtest/gtest.h>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/quadrature.h>

#include "random_sh.h"
#include "reference.h"

namespace ssphh::sh {
namespace {

struct Polar {
  double theta, phi;
};

glm::dvec3 direction(const Polar& p) {
  return {std::sin(p.theta) * std::cos(p.phi), std::sin(p.theta) * std::sin(p.phi), std::cos(p.theta)};
}

std::vector<Polar> polar_grid() {
  std::vector<Polar> grid;
  for (int i = 0; i <= 12; ++i) {
    for (int j = 0; j < 16; ++j) grid.push_back({pi_d * i / 12, 2 * pi_d * (j + 0.3) / 16});
  }
  return grid;
}

TEST(EvalBasis, FollowsTheStatedSignsAndOrder) {
  std::array<float, 9> y{};
  const vec3 n = glm::normalize(vec3(1, 2, 3));
  eval_basis(2, n, y);
  // One rounding of constants and products each: 1e-6.
  EXPECT_NEAR(y[0], 0.2820948f, 1e-6);
  EXPECT_NEAR(y[1], 0.4886025f * n.y, 1e-6);
  EXPECT_NEAR(y[2], 0.4886025f * n.z, 1e-6);
  EXPECT_NEAR(y[3], 0.4886025f * n.x, 1e-6);
  EXPECT_NEAR(y[4], 1.0925484f * n.x * n.y, 1e-6);
  EXPECT_NEAR(y[5], 1.0925484f * n.y * n.z, 1e-6);
  EXPECT_NEAR(y[6], 0.3153916f * (3 * n.z * n.z - 1), 1e-6);
  EXPECT_NEAR(y[7], 1.0925484f * n.x * n.z, 1e-6);
  EXPECT_NEAR(y[8], 0.5462742f * (n.x * n.x - n.y * n.y), 1e-6);
}

TEST(EvalBasis, EqualsBoostForAllBands) {
  std::array<double, max_coefficient_count> y{};
  for (const Polar& p : polar_grid()) {
    eval_basis(max_degree, direction(p), y);
    for (int l = 0; l <= max_degree; ++l) {
      for (int m = 0; m <= l; ++m) {
        // Boost's complex Y_lm carries the Condon–Shortley sign (−1)^m; the real basis is √2 Re and √2 Im
        // without it.
        const std::complex<double> complex =
            boost::math::spherical_harmonic(static_cast<unsigned>(l), m, p.theta, p.phi);
        const double scale = (m % 2 ? -1 : 1) * (m == 0 ? 1 : std::sqrt(2.0));
        // Rounding of the recurrence in double precision.
        ASSERT_NEAR(y[coefficient_index(l, m)], scale * complex.real(), 1e-13) << l << ' ' << m;
        if (m > 0) {
          ASSERT_NEAR(y[coefficient_index(l, -m)], scale * complex.imag(), 1e-13) << l << ' ' << -m;
        }
      }
    }
  }
}

TEST(EvalBasis, EqualsTheSlowReference) {
  std::array<double, max_coefficient_count> y{};
  for (const Polar& p : polar_grid()) {
    eval_basis(max_degree, direction(p), y);
    for (int l = 0; l <= max_degree; ++l) {
      for (int m = -l; m <= l; ++m) {
        // The reference's explicit sum cancels up to ~1e3 between terms: 1e-12.
        ASSERT_NEAR(y[coefficient_index(l, m)], reference_basis(l, m, p.theta, p.phi), 1e-12)
            << l << ' ' << m;
      }
    }
  }
}

TEST(EvalBasis, SinglePrecisionKeepsItsStatedError) {
  Pcg32 random(1);
  std::array<double, max_coefficient_count> exact{};
  std::array<float, max_coefficient_count> fast{};
  for (int i = 0; i < 2000; ++i) {
    const vec3 d = vec3(test::random_direction(random));
    eval_basis(max_degree, glm::dvec3(d), exact);  // the same, slightly denormalised direction
    eval_basis(max_degree, d, fast);
    for (std::size_t k = 0; k < exact.size(); ++k) ASSERT_NEAR(fast[k], exact[k], 2e-6) << k;
  }
}

TEST(EvalBasis, BatchEqualsSingleForEveryCountAndDegree) {
  Pcg32 random(2);
  for (const int degree : {0, 1, 2, 5, 10}) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 33u}) {
      std::vector<float> x(count), y(count), z(count);
      std::vector<float> out(count * static_cast<std::size_t>(coefficient_count(degree)) + 1, 42.0f);
      for (std::size_t i = 0; i < count; ++i) {
        const vec3 d = vec3(test::random_direction(random));
        x[i] = d.x, y[i] = d.y, z[i] = d.z;
      }
      eval_basis(degree, x, y, z, out);
      std::array<float, max_coefficient_count> single{};
      for (std::size_t i = 0; i < count; ++i) {
        eval_basis(degree, vec3(x[i], y[i], z[i]), single);
        for (std::size_t k = 0; k < static_cast<std::size_t>(coefficient_count(degree)); ++k) {
          // Same formula; the compiler may fuse multiply-adds differently.
          ASSERT_NEAR(out[k * count + i], single[k], 1e-6);
        }
      }
      EXPECT_EQ(out.back(), 42.0f) << "wrote past the end";
    }
  }
}

TEST(EvalBasis, IsOrthonormal) {
  const SphereQuadrature rule = sphere_quadrature(2 * max_degree);
  constexpr std::size_t count = max_coefficient_count;
  std::vector<double> gram(count * count, 0.0);
  std::array<double, count> y{};
  for (std::size_t i = 0; i < rule.directions.size(); ++i) {
    eval_basis(max_degree, rule.directions[i], y);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) gram[a * count + b] += rule.weights[i] * y[a] * y[b];
    }
  }
  for (std::size_t a = 0; a < count; ++a) {
    // The rule is exact for these products: rounding only.
    for (std::size_t b = 0; b < count; ++b)
      ASSERT_NEAR(gram[a * count + b], a == b ? 1 : 0, 1e-12) << a << ' ' << b;
  }
}

TEST(EvalBasis, ObeysTheAdditionTheorem) {
  Pcg32 random(3);
  std::array<double, max_coefficient_count> ya{}, yb{};
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 a = test::random_direction(random), b = test::random_direction(random);
    eval_basis(max_degree, a, ya);
    eval_basis(max_degree, b, yb);
    for (int l = 0; l <= max_degree; ++l) {
      double sum = 0;
      for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) {
        sum += ya[k] * yb[k];
      }
      const double legendre = std::legendre(static_cast<unsigned>(l), glm::clamp(glm::dot(a, b), -1.0, 1.0));
      EXPECT_NEAR(sum, (2 * l + 1) / (4 * pi_d) * legendre, 1e-13);
    }
  }
}

TEST(GaussLegendre, IsExactForPolynomials) {
  for (int count = 1; count <= 24; ++count) {
    const LineQuadrature rule = gauss_legendre(count);
    for (int power = 0; power < 2 * count; ++power) {
      double sum = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        sum += rule.weights[i] * std::pow(rule.nodes[i], power);
      EXPECT_NEAR(sum, power % 2 ? 0.0 : 2.0 / (power + 1), 1e-14) << count << ' ' << power;
    }
  }
}

}  // namespace
}  // namespace ssphh::sh
