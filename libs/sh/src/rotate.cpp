#include <cmath>
#include <cstdlib>

#include <ssphh/core/math.h>
#include <ssphh/sh/rotate.h>

namespace ssphh::sh {
namespace {

// One step of the recursion: band l from band l − 1 and band 1, all row-major with indices −l..l.
struct BandStep {
  int l;
  const double* first;     // band 1
  const double* previous;  // band l − 1

  double r1(int m, int n) const { return first[(m + 1) * 3 + n + 1]; }
  double below(int m, int n) const { return previous[(m + l - 1) * (2 * l - 1) + n + l - 1]; }

  double p(int i, int a, int b) const {
    if (b == l) return r1(i, 1) * below(a, l - 1) - r1(i, -1) * below(a, 1 - l);
    if (b == -l) return r1(i, 1) * below(a, 1 - l) + r1(i, -1) * below(a, l - 1);
    return r1(i, 0) * below(a, b);
  }
  double u_term(int m, int n) const { return p(0, m, n); }
  double v_term(int m, int n) const {
    if (m == 0) return p(1, 1, n) + p(-1, -1, n);
    if (m > 0) return m == 1 ? std::sqrt(2.0) * p(1, 0, n) : p(1, m - 1, n) - p(-1, 1 - m, n);
    return m == -1 ? std::sqrt(2.0) * p(-1, 0, n) : p(1, m + 1, n) + p(-1, -m - 1, n);
  }
  double w_term(int m, int n) const {
    return m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, 1 - m, n);
  }
  double element(int m, int n) const {
    const int a = std::abs(m);
    const double denominator = std::abs(n) == l ? 2.0 * l * (2 * l - 1) : (l + n) * (l - n);
    const double zero = m == 0 ? 1 : 0;
    const double u = std::sqrt((l + m) * (l - m) / denominator);
    const double v = 0.5 * std::sqrt((1 + zero) * (l + a - 1) * (l + a) / denominator) * (1 - 2 * zero);
    const double w = -0.5 * std::sqrt((l - a - 1) * (l - a) / denominator) * (1 - zero);
    // A factor of zero marks terms whose indices lie outside the band below.
    double sum = 0;
    if (u != 0) sum += u * u_term(m, n);
    if (v != 0) sum += v * v_term(m, n);
    if (w != 0) sum += w * w_term(m, n);
    return sum;
  }
};

template <class Sh>
Sh apply_bands(const Rotation& rotation, const Sh& sh) {
  require(sh.degree() <= rotation.degree(), "rotation", "the function's degree is over the rotation's");
  Sh result = sh;
  for (int l = 0; l <= sh.degree(); ++l) {
    for (int m = -l; m <= l; ++m) {
      glm::dvec3 sum(0);
      for (int n = -l; n <= l; ++n)
        sum += rotation.element(l, m, n) * glm::dvec3(sh[coefficient_index(l, n)]);
      result[coefficient_index(l, m)] = vec3(sum);
    }
  }
  return result;
}

}  // namespace

Rotation::Rotation(int degree, const glm::dmat3& matrix) : degree_(degree) {
  require_degree(degree, "rotation");
  const glm::dmat3 product = matrix * glm::transpose(matrix);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r)
      require(std::abs(product[c][r] - (c == r ? 1 : 0)) < 1e-4, "rotation", "the matrix is not orthogonal");
  }
  int size = 0;
  for (int l = 0; l <= degree; ++l) size += (2 * l + 1) * (2 * l + 1);
  elements_.reserve(static_cast<std::size_t>(size));
  elements_.push_back(1);
  // Band 1 is the matrix itself in the order y, z, x of Y₁₋₁, Y₁₀, Y₁₁ (GLM indexes [column][row]).
  constexpr int axis[3] = {1, 2, 0};
  double first[9];
  for (int m = 0; m < 3; ++m) {
    for (int n = 0; n < 3; ++n) first[m * 3 + n] = matrix[axis[n]][axis[m]];
  }
  if (degree >= 1) elements_.insert(elements_.end(), first, first + 9);
  for (int l = 2; l <= degree; ++l) {
    const BandStep step{l, first, band(l - 1)};
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) elements_.push_back(step.element(m, n));
    }
  }
}

Rotation::Rotation(int degree, const quat& rotation)
    : Rotation(degree, glm::mat3_cast(glm::normalize(glm::dquat(rotation)))) {}

Rotation Rotation::about_axis(int degree, const vec3& axis, double angle) {
  return Rotation(degree, glm::mat3_cast(glm::angleAxis(angle, glm::normalize(glm::dvec3(axis)))));
}

RadianceSh Rotation::apply(const RadianceSh& sh) const {
  return apply_bands(*this, sh);
}
IrradianceSh Rotation::apply(const IrradianceSh& sh) const {
  return apply_bands(*this, sh);
}

RadianceSh rotate(const RadianceSh& sh, const quat& rotation) {
  return sh.empty() ? sh : Rotation(sh.degree(), rotation).apply(sh);
}

}  // namespace ssphh::sh
