#include <cmath>

#include <ssphh/core/math.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/zh3.h>

namespace ssphh::sh {
namespace {

constexpr int first = coefficient_index(2, -2), count = 5;

/// Coefficients in band 2 of the lobe about `axis` whose only coefficient is 1: a unit vector, since
/// Σ_m Y_2m(axis)² = 5/4π.
std::array<float, count> unit_lobe(const vec3& axis) {
  std::array<float, static_cast<std::size_t>(coefficient_count(2))> basis;
  eval_basis(2, axis, basis);
  std::array<float, count> lobe;
  for (int m = 0; m < count; ++m) lobe[m] = std::sqrt(4 * pi / 5) * basis[first + m];
  return lobe;
}

}  // namespace

std::optional<vec3> zh3_axis(const std::array<vec3, 4>& linear) {
  const glm::dvec3 axis(luminance(linear[3]), luminance(linear[1]), luminance(linear[2]));
  const double length = glm::length(axis);
  if (!(length > 0)) return std::nullopt;
  return vec3(axis / length);
}

Zh3 zh3_about(const std::array<vec3, 4>& linear, const RadianceSh& radiance) {
  require(radiance.degree() >= 2, "ZH3", "the function needs bands 0 to 2");
  Zh3 zh3{linear, vec3(0)};
  const std::optional<vec3> axis = zh3_axis(linear);
  if (!axis) return zh3;
  const std::array<float, count> lobe = unit_lobe(*axis);
  for (int m = 0; m < count; ++m) zh3.zonal += lobe[m] * radiance[first + m];
  return zh3;
}

Zh3 zh3_from(const RadianceSh& radiance) {
  require(radiance.degree() >= 2, "ZH3", "the function needs bands 0 to 2");
  return zh3_about({radiance[0], radiance[1], radiance[2], radiance[3]}, radiance);
}

RadianceSh to_sh(const Zh3& zh3) {
  RadianceSh radiance(2);
  for (int k = 0; k < 4; ++k) radiance[k] = zh3.linear[k];
  const std::optional<vec3> axis = zh3_axis(zh3.linear);
  if (!axis) return radiance;
  const std::array<float, count> lobe = unit_lobe(*axis);
  for (int m = 0; m < count; ++m) radiance[first + m] = lobe[m] * zh3.zonal;
  return radiance;
}

}  // namespace ssphh::sh
