#pragma once
/// Clear sky and sun.

#include <memory>

#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Unit vector toward the sun.
vec3 sun_direction(const SunSkyParams& params);

/// Radiance of the sky, without the sun's disc, in a unit direction with y > 0 [W sr⁻¹ m⁻²]. The model's
/// luminance is divided by 110 lm/W, daylight's luminous efficacy, so that the RGB's luminance is broadband
/// radiance. The physical sky is never darker than a moonless night (2.5e-4 cd/m²: airglow and stars).
vec3 sky_radiance(const SunSkyParams& params, const vec3& direction);

/// Irradiance of the sun on a plane that faces it [W/m²]. preetham: 1210 W/m² (133 klx at 110 lm/W) outside
/// of the atmosphere, dimmed by air, haze and ozone at 630, 540 and 455 nm. physical: 125 klx of a black
/// body, dimmed alike at 8 wavelengths; of a sun that sets, the share that is above the horizon.
vec3 sun_irradiance(const SunSkyParams& params);

/// The sky's image: equirectangular, the ground's radiance below the horizon [W sr⁻¹ m⁻²].
image::Image sky_image(const SunSkyParams& params);

/// Sets the environment to the sky (group "sky"), replacing any other, and adds the sun (group "sun") as a
/// directional light of angular radius 0.00465; a sun that an earlier call added goes. Throws Error for
/// parameters out of range.
void add_sun_sky(Scene& scene, const SunSkyParams& params = {});

/// A sky and its sun as they shine.
struct SunSky {
  SunSkyParams params;
  std::shared_ptr<const image::Image> image;  ///< sky_image()
  vec3 sun{0};                                ///< sun_irradiance(), 0 for a sky without sun
};

/// Throws Error as add_sun_sky.
SunSky make_sun_sky(const SunSkyParams& params);

/// The scene's light with another sky and sun in place of those that add_sun_sky() gave it: the environment's
/// image, and the directional light of group "sun", if there is one. Call it before turn_surroundings().
/// Throws Error for a scene whose environment was not computed.
void set_sun_sky(LightingState& state, const Scene& scene, const SunSky& sky);

/// Index of the scene's light that is the sun of its computed sky; −1: there is none.
int sun_light(const Scene& scene);

}  // namespace ssphh::scene
