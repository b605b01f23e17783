#include <array>
#include <cmath>
#include <cstdlib>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/quadrature.h>
#include <ssphh/sh/triple_product.h>

namespace ssphh::sh {
namespace {

// ∫ of three factors cos mφ (m ≥ 0) or sin |m|φ (m < 0) over the circle, divided by 2π.
double azimuth_mean(int a, int b, int c) {
  // Each factor is (e^{iφ|m|} ± e^{−iφ|m|}) / 2 or / 2i: sum the sign patterns whose orders add up to 0.
  const int orders[3] = {std::abs(a), std::abs(b), std::abs(c)};
  const int sines = (a < 0 ? 1 : 0) + (b < 0 ? 1 : 0) + (c < 0 ? 1 : 0);
  if (sines % 2 == 1) return 0;
  double sum = 0;
  for (int pattern = 0; pattern < 8; ++pattern) {
    int order = 0;
    double sign = 1;
    for (int f = 0; f < 3; ++f) {
      const bool negative = (pattern >> f & 1) != 0;
      order += negative ? -orders[f] : orders[f];
      if (negative && (f == 0 ? a : f == 1 ? b : c) < 0) sign = -sign;
    }
    if (order == 0) sum += sign;
  }
  return (sines == 2 ? -1 : 1) * sum / 8;  // i⁻² = −1
}

}  // namespace

TripleProductTensor::TripleProductTensor(int degree_i, int degree_j, int degree_k)
    : degree_i_(degree_i), degree_j_(degree_j), degree_k_(degree_k) {
  for (const int degree : {degree_i, degree_j, degree_k}) require_degree(degree, "triple product");

  // Polar factors: Y_l|m| at azimuth 0, at every node. The product of three is a polynomial of degree ≤ 30 in
  // z whenever the azimuth integral is not 0 (then the powers of sin θ are even).
  const LineQuadrature rule = gauss_legendre((degree_i + degree_j + degree_k) / 2 + 1);
  const std::size_t nodes = rule.nodes.size();
  std::vector<std::array<double, max_coefficient_count>> polar(nodes);
  for (std::size_t q = 0; q < nodes; ++q) {
    const double z = rule.nodes[q];
    eval_basis(max_degree, glm::dvec3(std::sqrt(1 - z * z), 0, z), polar[q]);
  }
  const auto add = [&](int li, int mi, int lj, int mj, int lk, int mk) {
    const double azimuth = azimuth_mean(mi, mj, mk);
    if (azimuth == 0) return;
    const auto node = [](int l, int m) {
      return static_cast<std::size_t>(coefficient_index(l, std::abs(m)));
    };
    double sum = 0;
    for (std::size_t q = 0; q < nodes; ++q) {
      sum += rule.weights[q] * polar[q][node(li, mi)] * polar[q][node(lj, mj)] * polar[q][node(lk, mk)];
    }
    const double value = 2 * pi_d * azimuth * sum;
    if (std::abs(value) < 1e-12) return;
    const auto index = [](int l, int m) { return static_cast<std::uint8_t>(coefficient_index(l, m)); };
    entries_.push_back({index(li, mi), index(lj, mj), index(lk, mk), static_cast<float>(value)});
  };

  for (int li = 0; li <= degree_i; ++li) {
    for (int mi = -li; mi <= li; ++mi) {
      for (int lj = 0; lj <= degree_j; ++lj) {
        for (int mj = -lj; mj <= lj; ++mj) {
          // Triangle inequality and parity leave every second band from |li − lj| on.
          for (int lk = std::abs(li - lj); lk <= std::min(li + lj, degree_k); lk += 2) {
            for (int mk = -lk; mk <= lk; ++mk) add(li, mi, lj, mj, lk, mk);
          }
        }
      }
    }
  }
}

}  // namespace ssphh::sh
