#pragma once
/// What a computed sky and its sun are computed from.

#include <optional>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/math.h>
#include <ssphh/scene/sun_position.h>

namespace ssphh::scene {

/// `preetham`: Preetham, Shirley & Smits, A Practical Analytic Model for Daylight, 1999; by day alone.
/// `physical`: light scattered in air, haze and ozone around a round earth; dusk and night, too.
enum class SkyModel { preetham, physical };
constexpr auto enum_table(SkyModel) {
  using enum SkyModel;
  return std::to_array<EnumName<SkyModel>>({{preetham, "preetham"}, {physical, "physical"}});
}

struct SunSkyParams {
  float elevation = pi / 4;  ///< of the sun above the horizon, radians; 0…π/2, physical from −π/2
  float azimuth = pi / 6;    ///< of the sun, radians from +x toward +z
  float turbidity = 3;       ///< haze: 2 very clear, 10 hazy
  vec3 ground_albedo{0.2f};  ///< a Lambertian plane below the horizon, lit by sun and sky
  bool sun = true;           ///< also the sun itself, as a directional light
  int width = 512;           ///< pixels of the sky's image; half as high
  SkyModel model = SkyModel::preetham;
  std::optional<SunTime> time{};  ///< that elevation and azimuth were found from, by at_time()

  friend bool operator==(const SunSkyParams&, const SunSkyParams&) = default;
};

/// The same sky with the sun where it stands at a time. Throws Error as sun_position.
SunSkyParams at_time(SunSkyParams params, const SunTime& time);

}  // namespace ssphh::scene
