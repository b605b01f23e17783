#pragma once
/// Preetham, Shirley & Smits, A Practical Analytic Model for Daylight, 1999.

#include <ssphh/scene/sun_sky_params.h>

namespace ssphh::scene {

class PreethamSky {
 public:
  /// `params` are in the model's range.
  explicit PreethamSky(const SunSkyParams& params);
  /// As sky_radiance(). `cos_between`: of the angle between direction and sun.
  vec3 radiance(float cos_view, float cos_between) const;

 private:
  /// Perez' five parameters for one of Y, x, y (appendix A.2).
  struct Perez {
    double a, b, c, d, e;
    double at(double cos_theta, double gamma, double cos_gamma) const;
  };
  Perez luminance_, x_, y_;
  double zenith_luminance_, zenith_x_, zenith_y_;  // cd/m²; chromaticities
  double sun_zenith_angle_;
};

/// As sun_irradiance().
vec3 preetham_sun(const SunSkyParams& params);

}  // namespace ssphh::scene
