#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/irradiance.h>

namespace ssphh::sh {
namespace {

// N_k of Y_k = N_k · {1, y, z, x, xy, yz, 3z²−1, xz, x²−y²}.
double polynomial_constant(int k) {
  const double root_pi = std::sqrt(pi_d);
  if (k == 0) return 0.5 / root_pi;
  if (k <= 3) return std::sqrt(3.0) / (2 * root_pi);
  if (k == 6) return std::sqrt(5.0) / (4 * root_pi);
  return std::sqrt(15.0) / ((k == 8 ? 4 : 2) * root_pi);
}

bool odd_in_x(int k) {
  return k == 3 || k == 4 || k == 7;
}

}  // namespace

int convention_max_degree(Convention convention) {
  return convention == Convention::ssphh || convention == Convention::d3dx ? max_degree : 2;
}

double convention_factor(Convention convention, int k) {
  require(k >= 0 && k < coefficient_count(convention_max_degree(convention)), "convention",
          "it does not store that coefficient");
  int l = 0;
  while (coefficient_count(l) <= k) ++l;
  switch (convention) {
    case Convention::ssphh:
    case Convention::three:
      return 1;
    case Convention::d3dx:
      return std::abs(k - coefficient_index(l, 0)) % 2 == 0 ? 1 : -1;
    case Convention::unity:
    case Convention::filament:
      return cosine_band_factor(l) / pi_d * polynomial_constant(k);
    case Convention::filament_mirrored:
      return (odd_in_x(k) ? -1 : 1) * convention_factor(Convention::filament, k);
  }
  refuse("convention", "there is none of that number");
}

std::vector<vec3> to_convention(const RadianceSh& radiance, Convention convention) {
  const int degree = std::min(radiance.degree(), convention_max_degree(convention));
  std::vector<vec3> stored;
  for (int k = 0; k < coefficient_count(degree); ++k) {
    stored.push_back(static_cast<float>(convention_factor(convention, k)) * radiance[k]);
  }
  return stored;
}

RadianceSh from_convention(std::span<const vec3> stored, Convention convention) {
  const int limit = convention_max_degree(convention);
  int degree = 0;
  while (degree < limit && static_cast<std::size_t>(coefficient_count(degree)) < stored.size()) ++degree;
  if (stored.size() != static_cast<std::size_t>(coefficient_count(degree))) {
    throw Error("coefficients",
                fmt::format("{} values are not those of a whole degree up to {}", stored.size(), limit),
                fmt::format("give (degree+1)² values: 1, 4, 9{}", limit > 2 ? " … 121" : ""));
  }
  RadianceSh radiance(degree);
  for (int k = 0; k < coefficient_count(degree); ++k) {
    const vec3& value = stored[k];
    if (!is_finite(value)) throw Error("coefficients", fmt::format("value {} is not finite", k));
    radiance[k] = value / static_cast<float>(convention_factor(convention, k));
  }
  return radiance;
}

}  // namespace ssphh::sh
