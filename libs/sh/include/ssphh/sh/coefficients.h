#pragma once
/// Spherical harmonics coefficients as values. Basis, index and irradiance conventions:
/// docs/conventions.md#spherical-harmonics.

#include <vector>

#include <ssphh/core/error.h>
#include <ssphh/core/math.h>

namespace ssphh::sh {

inline constexpr int max_degree = 10;

/// Number of coefficients of all bands 0..degree.
constexpr int coefficient_count(int degree) {
  return (degree + 1) * (degree + 1);
}
inline constexpr int max_coefficient_count = coefficient_count(max_degree);

/// Index of Y_lm, l = 0..degree, m = −l..l.
constexpr int coefficient_index(int l, int m) {
  return l * (l + 1) + m;
}

/// RGB coefficients of a spherical function, in coefficient_index order. `Quantity` keeps radiance [W sr⁻¹
/// m⁻²] and irradiance [W m⁻²] apart: one becomes the other only by irradiance_from_radiance (cosine
/// convolution, A_l).
template <class Quantity>
struct RgbSh {
  std::vector<vec3> values;

  RgbSh() = default;
  /// All zero. `degree` must be 0..max_degree.
  explicit RgbSh(int degree) : values(static_cast<std::size_t>(coefficient_count(degree)), vec3(0)) {
    SSPHH_CHECK(degree >= 0 && degree <= max_degree);
  }

  bool empty() const { return values.empty(); }
  /// −1 when empty.
  int degree() const {
    int d = -1;
    while (coefficient_count(d + 1) <= static_cast<int>(values.size())) ++d;
    return d;
  }
  vec3& operator[](int k) { return values[static_cast<std::size_t>(k)]; }
  const vec3& operator[](int k) const { return values[static_cast<std::size_t>(k)]; }

  /// ⊕ of the paper: the sum of two functions. Both must have the same degree.
  RgbSh& operator+=(const RgbSh& other) {
    SSPHH_CHECK(values.size() == other.values.size());
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

/// SH of incident radiance L_i(ω), ω pointing away from the probe.
using RadianceSh = RgbSh<RadianceQuantity>;
/// SH of irradiance E(n).
using IrradianceSh = RgbSh<IrradianceQuantity>;

}  // namespace ssphh::sh
