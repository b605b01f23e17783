#pragma once
/// Clear sky and sun (Preetham, Shirley & Smits, A Practical Analytic Model for Daylight, 1999).

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// The model was fitted to turbidities 2…10 and a sun above the horizon.
struct SunSkyParams {
  float elevation = pi / 4;  ///< of the sun above the horizon, radians, 0…π/2
  float azimuth = pi / 6;    ///< of the sun, radians from +x toward +z
  float turbidity = 3;       ///< haze: 2 very clear, 10 hazy
  vec3 ground_albedo{0.2f};  ///< a Lambertian plane below the horizon, lit by sun and sky
  bool sun = true;           ///< also the sun itself, as a directional light
  int width = 512;           ///< pixels of the sky's image; half as high
};

/// Unit vector toward the sun.
vec3 sun_direction(const SunSkyParams& params);

/// Radiance of the sky, without the sun's disc, in a unit direction with y > 0 [W sr⁻¹ m⁻²]. The model's
/// luminance is divided by 110 lm/W, daylight's luminous efficacy, so that the RGB's luminance is broadband
/// radiance.
vec3 sky_radiance(const SunSkyParams& params, const vec3& direction);

/// Irradiance of the sun on a plane that faces it [W/m²]: 1210 W/m² (133 klx at 110 lm/W) outside of the
/// atmosphere, dimmed by air, haze and ozone at 630, 540 and 455 nm.
vec3 sun_irradiance(const SunSkyParams& params);

/// Sets the environment to the sky (group "sky"), replacing any other, and adds the sun (group "sun") as a
/// directional light of angular radius 0.00465. Throws Error for parameters out of range.
void add_sun_sky(Scene& scene, const SunSkyParams& params = {});

}  // namespace ssphh::scene
