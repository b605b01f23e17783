#pragma once
/// The physical sky seen from the ground with the sun at one place.

#include <vector>

#include <ssphh/scene/sun_sky_params.h>

#include "atmosphere.h"

namespace ssphh::scene {

/// Looks its light up in a table over directions. What turns quickly with the direction, the phase functions,
/// is not in the table, nor is a night's own light left out.
class PhysicalSky {
 public:
  explicit PhysicalSky(const SunSkyParams& params);
  /// As sky_radiance(). `cos_between`: of the angle between direction and sun.
  vec3 radiance(float cos_view, float cos_between) const;

 private:
  struct Colors {
    vec3 by_air, by_haze, again;
  };
  std::vector<Colors> table_;
  float cos_sun_, sin_sun_;
};

/// As sky_radiance(), without a table: slow and exact.
vec3 physical_radiance(const SunSkyParams& params, const vec3& direction);
/// As sun_irradiance().
vec3 physical_sun(const SunSkyParams& params);

}  // namespace ssphh::scene
