#pragma once
/// Where the sun stands, from date, time and place.

#include <string>
#include <string_view>

#include <ssphh/core/error.h>

namespace ssphh::scene {

/// A moment at a place on earth, as people name it.
struct SunTime {
  int year = 2026, month = 6, day = 21;  ///< Gregorian, 1900 to 2100
  double hour = 12;                      ///< of the clock, minutes as its fraction; 24 to 48 is the next day
  double utc_offset = 0;                 ///< hours by which the clock is ahead of UTC, −14 to 14
  double latitude = 0, longitude = 0;    ///< degrees, north and east positive
  double north = 0;  ///< degrees by compass, clockwise seen from above, from −z of the scene to north

  friend bool operator==(const SunTime&, const SunTime&) = default;
};

struct SunPosition {
  double elevation = 0;   ///< apparent, degrees above the horizon; below it negative
  double refraction = 0;  ///< what the air lifts it by, a part of that [degrees]
  double azimuth = 0;     ///< degrees from north over east, 0 to 360
};

/// Low-precision formulas of Meeus, Astronomical Algorithms (1998), chapters 12, 13 and 25, and refraction at
/// sea level as NOAA's solar calculator has it: to 0.01° from 1950 to 2050, refraction at the horizon apart.
/// Throws Error as check_sun_time.
SunPosition sun_position(const SunTime& time);

/// Throws Error that names the part of a time or place that there is not, as February 30 or latitude 91.
void check_sun_time(const SunTime& time);

/// Whole hours by which clocks are ahead of UTC at sea: longitude over 15, rounded. No law knows it, and no
/// summer time.
double nautical_utc_offset(double longitude);

/// Set what "2026-06-21", "17:30" or "17:30:15" (24:00 is the end of the day) and "48.1,11.6" say. Throw
/// Error with the form and an example; `where` names the option.
void read_date(SunTime& time, std::string_view text, const std::string& where);
void read_place(SunTime& time, std::string_view text, const std::string& where);
double read_hour(std::string_view text, const std::string& where);

/// "17:30", with seconds where they are not 0; of the next day as of this.
std::string clock_text(double hour);

}  // namespace ssphh::scene
