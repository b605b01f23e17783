#pragma once
/// Which sky, and where its sun stands: by angles, or by date, time and place.

#include <optional>
#include <string>

#include <ssphh/scene/scene.h>

namespace ssphh::pipeline {

struct SkyOptions {
  std::optional<scene::SkyModel> model;  ///< none: physical where a time or `north` is given
  bool preetham = false;                 ///< as model = preetham, by its old name --sun-sky
  float elevation = 45, azimuth = 120;   ///< of the sun, degrees; azimuth 0: −z, 90: +x
  float turbidity = 3;
  std::string date, time_of_day, place;  ///< all three in place of the angles, as scene::read_date has them
  std::optional<float> utc_offset;       ///< hours; none: the nautical one of the place
  float north = 0;                       ///< degrees from −z to north, clockwise seen from above
};

/// None where the options ask for no sky. Throws Error for some of date, time and place without the others,
/// for those that cannot be read, and for two models.
std::optional<scene::SunSkyParams> sun_sky_of(const SkyOptions& options);

/// Says in the log where the sun of a date stands, and warns where it does not light the scene.
void tell_of_sun(const scene::Scene& scene);

}  // namespace ssphh::pipeline
