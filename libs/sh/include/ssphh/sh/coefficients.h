#pragma once
/// Spherical harmonics coefficients as values. Basis, index and irradiance conventions:
/// docs/conventions.md#spherical-harmonics.

#include <vector>

#include <ssphh/core/require.h>
#include <ssphh/core/vectors.h>

namespace ssphh::sh {

inline constexpr int max_degree = 10;

/// Number of coefficients of all bands 0..degree.
constexpr int coefficient_count(int degree) {
  return (degree + 1) * (degree + 1);
}
inline constexpr int max_coefficient_count = coefficient_count(max_degree);

/// The degree whose functions have at most so many coefficients; −1: none.
constexpr int degree_of(std::size_t coefficients) {
  int degree = -1;
  while (static_cast<std::size_t>(coefficient_count(degree + 1)) <= coefficients) ++degree;
  return degree;
}

/// Throws Error unless the degree is 0..max_degree.
inline void require_degree(int degree, const char* where) {
  require(degree >= 0 && degree <= max_degree, where, "the degree must be 0..10");
}

/// Index of Y_lm, l = 0..degree, m = −l..l.
constexpr int coefficient_index(int l, int m) {
  return l * (l + 1) + m;
}

/// RGB coefficients of a spherical function, in coefficient_index order. `Quantity` keeps radiance [W sr⁻¹
/// m⁻²], irradiance [W m⁻²] and radiant intensity [W sr⁻¹] apart: radiance becomes irradiance only by
/// irradiance_from_radiance (cosine convolution, A_l).
template <class Quantity>
struct RgbSh {
  std::vector<vec3> values;

  RgbSh() = default;
  /// All zero. Throws Error unless `degree` is 0..max_degree.
  explicit RgbSh(int degree) {
    require_degree(degree, "spherical harmonics");
    values.assign(static_cast<std::size_t>(coefficient_count(degree)), vec3(0));
  }

  bool empty() const { return values.empty(); }
  /// −1 when empty.
  int degree() const { return degree_of(values.size()); }
  vec3& operator[](int k) { return values[k]; }
  const vec3& operator[](int k) const { return values[k]; }

  /// ⊕ of the paper: the sum of two functions. Throws Error unless both have the same degree.
  RgbSh& operator+=(const RgbSh& other) {
    require(values.size() == other.values.size(), "sum of spherical functions", "their degrees differ");
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += other.values[k];
    return *this;
  }
  RgbSh& operator*=(const vec3& factor) {
    for (vec3& v : values) v *= factor;
    return *this;
  }
  friend bool operator==(const RgbSh&, const RgbSh&) = default;
};

struct RadianceQuantity {};
struct IrradianceQuantity {};
struct IntensityQuantity {};

/// SH of incident radiance L_i(ω), ω pointing away from the probe.
using RadianceSh = RgbSh<RadianceQuantity>;
/// SH of irradiance E(n).
using IrradianceSh = RgbSh<IrradianceQuantity>;
/// SH of radiant intensity I(ω), ω pointing away from the lamp.
using IntensitySh = RgbSh<IntensityQuantity>;

}  // namespace ssphh::sh
