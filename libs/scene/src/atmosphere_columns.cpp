/// How much there is in the way of light.

#include <algorithm>
#include <cmath>

#include "atmosphere.h"

namespace ssphh::scene {
namespace {

constexpr int heights = 64, angles = 256;
constexpr double top_radius = earth_radius + atmosphere_height;
const double farthest = std::sqrt(top_radius * top_radius - earth_radius * earth_radius);

double way_out(double radius, double cos_zenith) {
  const double below = radius * cos_zenith;
  return -below + std::sqrt(std::max(0.0, below * below + (top_radius - radius) * (top_radius + radius)));
}

/// By midpoints that are the denser the nearer to the start they are.
Columns integrate_out(double radius, double cos_zenith) {
  constexpr int steps = 400;
  const double length = way_out(radius, cos_zenith);
  glm::dvec3 sum(0);
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](double x) { return length * (x / steps) * (x / steps); };
    const double t = at(i + 0.5), width = at(i + 1) - at(i);
    const double r = std::sqrt(radius * radius + t * t + 2 * radius * t * cos_zenith);
    const Columns here = densities_at(r - earth_radius);
    sum += width * glm::dvec3(here.air, here.haze, here.ozone);
  }
  return {static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)};
}

/// Of directions that do not meet the earth, by the way out and the distance to the horizon (Bruneton &
/// Neyret, Precomputed Atmospheric Scattering, 2008).
std::vector<Columns> make_column_table() {
  std::vector<Columns> table;
  for (int i = 0; i < heights; ++i) {
    const double to_horizon = farthest * i / (heights - 1);
    const double radius = std::sqrt(to_horizon * to_horizon + earth_radius * earth_radius);
    const double shortest = top_radius - radius, longest = to_horizon + farthest;
    for (int j = 0; j < angles; ++j) {
      const double length = std::max(shortest + (longest - shortest) * j / (angles - 1), 1e-3);
      const double cos_zenith =
          (top_radius * top_radius - radius * radius - length * length) / (2 * radius * length);
      table.push_back(integrate_out(radius, std::clamp(cos_zenith, -1.0, 1.0)));
    }
  }
  return table;
}

}  // namespace

Columns densities_at(double height) {
  constexpr double ozone_middle = 25'000, ozone_half_width = 15'000;
  const double h = std::max(height, 0.0);
  return {static_cast<float>(std::exp(-h / 8400)), static_cast<float>(std::exp(-h / 1200)),
          static_cast<float>(std::max(0.0, 1 - std::abs(h - ozone_middle) / ozone_half_width) /
                             ozone_half_width)};
}

Columns columns_above(double height, double cos_zenith) {
  static const std::vector<Columns> table = make_column_table();
  const double radius = earth_radius + std::clamp(height, 0.0, atmosphere_height);
  const double to_horizon = std::sqrt(std::max(0.0, radius * radius - earth_radius * earth_radius));
  const double shortest = top_radius - radius, longest = to_horizon + farthest;
  const double share = (way_out(radius, cos_zenith) - shortest) / (longest - shortest);
  const double x = std::clamp(to_horizon / farthest, 0.0, 1.0) * (heights - 1),
               y = std::clamp(share, 0.0, 1.0) * (angles - 1);
  const int i = std::min(static_cast<int>(x), heights - 2), j = std::min(static_cast<int>(y), angles - 2);
  const auto s = static_cast<float>(x - i), t = static_cast<float>(y - j);
  const Columns* const c = &table[i * angles + j];
  const auto mixed = [&](float Columns::*of) {
    return (1 - s) * ((1 - t) * c[0].*of + t * c[1].*of) +
           s * ((1 - t) * c[angles].*of + t * c[angles + 1].*of);
  };
  return {mixed(&Columns::air), mixed(&Columns::haze), mixed(&Columns::ozone)};
}

double horizon_cos_zenith(double height) {
  const double share = earth_radius / (earth_radius + std::max(height, 0.0));
  return -std::sqrt(std::max(0.0, 1 - share * share));
}

float visible_sun(double height, double cos_zenith) {
  // Angles differ by more than their cosines
  const double horizon = horizon_cos_zenith(height);
  if (std::abs(cos_zenith - horizon) > sun_radius) return cos_zenith > horizon ? 1 : 0;
  // The disc's lower and upper edge, by angles from the horizon
  const double above = std::acos(horizon) - std::acos(std::clamp(cos_zenith, -1.0, 1.0));
  const double x = std::clamp(above / sun_radius, -1.0, 1.0);
  return static_cast<float>(0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi_d);
}

}  // namespace ssphh::scene
