#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/core/require.h>
#include <ssphh/scene/calendar.h>
#include <ssphh/scene/sun_position.h>

namespace ssphh::scene {
namespace {

double of_degrees(double degrees) {
  return degrees * pi_d / 180;
}

double to_degrees(double radians) {
  return radians * 180 / pi_d;
}

/// Days since noon UTC of January 1, 4713 BC (Meeus, chapter 7; Gregorian dates).
double julian_day(const SunTime& t) {
  const int year = t.month > 2 ? t.year : t.year - 1, month = t.month > 2 ? t.month : t.month + 12;
  const int century = year / 100, leap = 2 - century + century / 4;
  const double day = t.day + (t.hour - t.utc_offset) / 24;
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + leap - 1524.5;
}

struct Equatorial {
  double right_ascension, declination;  // radians
};

/// Apparent place of the sun, `t` in Julian centuries since 2000 (Meeus, chapter 25).
Equatorial apparent_sun(double t) {
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = of_degrees(357.52911 + t * (35999.05029 - t * 0.0001537));
  const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = of_degrees(125.04 - 1934.136 * t);
  const double longitude = of_degrees(mean_longitude + center - 0.00569 - 0.00478 * std::sin(node));
  const double obliquity = of_degrees(23.4392911 - t * (0.0130042 + t * (0.00000016 - t * 0.000000504)) +
                                      0.00256 * std::cos(node));
  return {std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)),
          std::asin(std::sin(obliquity) * std::sin(longitude))};
}

/// Degrees, of an elevation without it.
double refraction_at(double elevation) {
  const double tangent = std::tan(of_degrees(elevation));
  double seconds = 0;
  if (elevation > 85) {
    seconds = 0;
  } else if (elevation > 5) {
    seconds = 58.1 / tangent - 0.07 / std::pow(tangent, 3) + 0.000086 / std::pow(tangent, 5);
  } else if (elevation > -0.575) {
    seconds = 1735 + elevation * (-518.2 + elevation * (103.4 + elevation * (-12.79 + elevation * 0.711)));
  } else {
    seconds = -20.772 / tangent;
  }
  return seconds / 3600;
}

}  // namespace

int days_of_month(int year, int month) {
  require(month >= 1 && month <= 12, "month", "it must be 1 to 12");
  constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return days[month - 1] + (month == 2 && leap ? 1 : 0);
}

void check_sun_time(const SunTime& t) {
  const auto require_range = [](const char* what, double value, double low, double high, const char* unit) {
    if (!(value >= low && value <= high))
      throw Error(fmt::format("sun: {}", what), fmt::format("{} is out of range", value),
                  fmt::format("{} to {} {}", low, high, unit));
  };
  require_range("year", t.year, 1900, 2100, "are known");
  require_range("month", t.month, 1, 12, "there are");
  require_range("day", t.day, 1, days_of_month(t.year, t.month), "has that month");
  require_range("time of day", t.hour, 0, 48, "hours");
  require_range("UTC offset", t.utc_offset, -14, 14, "hours");
  require_range("latitude", t.latitude, -90, 90, "degrees");
  require_range("longitude", t.longitude, -180, 180, "degrees");
  require_range("north", t.north, -360, 360, "degrees");
}

SunPosition sun_position(const SunTime& time) {
  check_sun_time(time);
  const double days = julian_day(time) - 2'451'545, t = days / 36525;
  const Equatorial sun = apparent_sun(t);
  const double sidereal = 280.46061837 + 360.98564736629 * days + t * t * 0.000387933;  // at Greenwich
  const double hour_angle = of_degrees(sidereal + time.longitude) - sun.right_ascension;
  const double latitude = of_degrees(time.latitude);
  const double up = std::sin(latitude) * std::sin(sun.declination) +
                    std::cos(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
  const double north = std::cos(latitude) * std::sin(sun.declination) -
                       std::sin(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
  const double east = -std::cos(sun.declination) * std::sin(hour_angle);
  SunPosition position;
  position.elevation = to_degrees(std::asin(std::clamp(up, -1.0, 1.0)));
  position.refraction = refraction_at(position.elevation);
  position.elevation += position.refraction;
  position.azimuth = std::fmod(to_degrees(std::atan2(east, north)) + 360, 360);
  return position;
}

double nautical_utc_offset(double longitude) {
  return std::round(longitude / 15);
}

}  // namespace ssphh::scene
