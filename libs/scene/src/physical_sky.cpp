#include "physical_sky.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

constexpr int elevation_nodes = 40, azimuth_nodes = 28;

/// Airglow and stars of a moonless night, 2.5e-4 cd/m² (21.6 magnitudes per square second of arc).
constexpr float night = 2.5e-4f / 110;

/// Radians above the horizon, dense near it.
double elevation_node(int i) {
  const double x = static_cast<double>(i) / (elevation_nodes - 1);
  return pi_d / 2 * x * x;
}

std::shared_ptr<const Atmosphere> air_of(const SunSkyParams& params) {
  return shared_atmosphere(params.turbidity, params.ground_albedo);
}

}  // namespace

PhysicalSky::PhysicalSky(const SunSkyParams& params)
    : table_(elevation_nodes * azimuth_nodes),
      cos_sun_(std::sin(params.elevation)),
      sin_sun_(std::cos(params.elevation)) {
  const auto air = air_of(params);
  parallel_for(elevation_nodes, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const double elevation = elevation_node(static_cast<int>(e)), cos_view = std::sin(elevation);
      for (int a = 0; a < azimuth_nodes; ++a) {
        const double azimuth = pi_d * a / (azimuth_nodes - 1);  // from the sun's
        const double between = cos_view * static_cast<double>(cos_sun_) +
                               std::cos(elevation) * static_cast<double>(sin_sun_) * std::cos(azimuth);
        const SkyParts parts = air->scattered(cos_view, static_cast<double>(cos_sun_), between);
        table_[e * azimuth_nodes + static_cast<std::size_t>(a)] = {
            sunlight_color(parts.by_air), sunlight_color(parts.by_haze), sunlight_color(parts.again)};
      }
    }
  });
}

vec3 PhysicalSky::radiance(float cos_view, float cos_between) const {
  const float view = std::clamp(cos_view, 0.0f, 1.0f);
  const float x = std::sqrt(std::asin(view) / (pi / 2)) * (elevation_nodes - 1);
  // The azimuth from the sun's; of no weight where either stands in the zenith
  const float across = std::sqrt(std::max(1 - view * view, 0.0f)) * sin_sun_;
  const float turned = across > 1e-6f ? std::clamp((cos_between - view * cos_sun_) / across, -1.0f, 1.0f) : 0;
  const float y = std::acos(turned) / pi * (azimuth_nodes - 1);
  const int i = std::min(static_cast<int>(x), elevation_nodes - 2),
            j = std::min(static_cast<int>(y), azimuth_nodes - 2);
  const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
  const Colors* const at = &table_[i * azimuth_nodes + j];
  const auto mixed = [&](vec3 Colors::*of) {
    return (1 - s) * ((1 - t) * at[0].*of + t * at[1].*of) +
           s * ((1 - t) * at[azimuth_nodes].*of + t * at[azimuth_nodes + 1].*of);
  };
  const auto between = static_cast<double>(cos_between);
  return vec3(night) + static_cast<float>(air_phase(between)) * mixed(&Colors::by_air) +
         static_cast<float>(haze_phase(between)) * mixed(&Colors::by_haze) + mixed(&Colors::again);
}

vec3 physical_radiance(const SunSkyParams& params, const vec3& direction) {
  const auto between = static_cast<double>(glm::dot(direction, sun_direction(params)));
  return vec3(night) +
         sunlight_color(air_of(params)->radiance(static_cast<double>(direction.y),
                                                 std::sin(static_cast<double>(params.elevation)), between));
}

vec3 physical_sun(const SunSkyParams& params) {
  return sunlight_color(air_of(params)->sunlight(0, std::sin(static_cast<double>(params.elevation))));
}

}  // namespace ssphh::scene
