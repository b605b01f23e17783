#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/sh/quadrature.h>

namespace ssphh::sh {
namespace {

glm::dvec3 direction(double z, double azimuth) {
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

}  // namespace

LineQuadrature gauss_legendre(int count) {
  require(count >= 1, "Gauss-Legendre quadrature", "it needs at least one node");
  LineQuadrature rule;
  for (int i = count; i >= 1; --i) {
    // Newton's iteration on P_count from Tricomi's estimate of the i-th root.
    double x = std::cos(pi_d * (i - 0.25) / (count + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p = 1, older = 0;
      for (int l = 1; l <= count; ++l) {
        const double next = ((2 * l - 1) * x * p - (l - 1) * older) / l;
        older = p;
        p = next;
      }
      derivative = count * (older - x * p) / (1 - x * x);
      const double step = p / derivative;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.nodes.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * derivative * derivative));
  }
  return rule;
}

SphereQuadrature sphere_quadrature(int exact_degree) {
  require(exact_degree >= 0, "sphere quadrature", "the degree must not be negative");
  const LineQuadrature polar = gauss_legendre(exact_degree / 2 + 1);
  const int azimuths = exact_degree + 1;
  SphereQuadrature rule;
  for (std::size_t i = 0; i < polar.nodes.size(); ++i) {
    for (int j = 0; j < azimuths; ++j) {
      rule.directions.push_back(direction(polar.nodes[i], 2 * pi_d * (j + 0.5) / azimuths));
      rule.weights.push_back(polar.weights[i] * 2 * pi_d / azimuths);
    }
  }
  return rule;
}

SphereQuadrature stratified_sphere_samples(int side, std::uint64_t seed) {
  require(side >= 1, "sphere samples", "there must be at least one cell");
  Pcg32 random(seed);
  const double cell = 1.0 / side;
  SphereQuadrature samples;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const vec2 u = random.uniform2();
      samples.directions.push_back(direction(1 - 2 * (i + static_cast<double>(u.x)) * cell,
                                             2 * pi_d * (j + static_cast<double>(u.y)) * cell));
      samples.weights.push_back(4 * pi_d * cell * cell);
    }
  }
  return samples;
}

}  // namespace ssphh::sh
