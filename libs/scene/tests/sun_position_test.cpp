// Where the sun stands, against numbers of almanacs.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/math.h>
#include <ssphh/scene/sun_position.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

using test::message_of;

double declination(int year, int month, int day, double utc_hour) {
  // At the pole it is the height without refraction
  const SunPosition p =
      sun_position({.year = year, .month = month, .day = day, .hour = utc_hour, .latitude = 90});
  return p.elevation - p.refraction;
}

// Reda & Andreas, Solar Position Algorithm (NREL 2004), the worked example: Golden, Colorado.
TEST(SunPosition, IsThatOfNrelsExample) {
  const SunPosition p = sun_position({.year = 2003,
                                      .month = 10,
                                      .day = 17,
                                      .hour = 12.508333,
                                      .utc_offset = -7,
                                      .latitude = 39.742476,
                                      .longitude = -105.1786});
  EXPECT_NEAR(p.azimuth, 194.34024, 0.01);
  EXPECT_NEAR(p.elevation - p.refraction, 39.872046, 0.01);
  EXPECT_NEAR(p.elevation, 39.888, 0.015);  // theirs: 820 mbar, 11 °C
}

// Meeus, Astronomical Algorithms, example 25.a: δ = −7.78507°.
TEST(SunPosition, HasMeeusDeclination) {
  EXPECT_NEAR(declination(1992, 10, 13, 0), -7.78507, 0.005);
}

// U.S. Naval Observatory: equinoxes and solstices of 2026 at March 20 14:46, June 21 08:24, September 23
// 00:05, December 21 20:50 UTC.
TEST(SunPosition, TurnsWithTheSeasonsOf2026) {
  EXPECT_NEAR(declination(2026, 3, 20, 14 + 46 / 60.0), 0, 0.003);
  EXPECT_NEAR(declination(2026, 6, 21, 8.4), 23.436, 0.003);
  EXPECT_NEAR(declination(2026, 9, 23, 5 / 60.0), 0, 0.003);
  EXPECT_NEAR(declination(2026, 12, 21, 20 + 50 / 60.0), -23.436, 0.003);
}

TEST(SunPosition, RisesInTheEastAndStandsInTheSouthAtNoon) {
  SunTime t{.month = 3, .day = 20, .utc_offset = 1, .latitude = 48.1, .longitude = 15};
  t.hour = 12;
  EXPECT_NEAR(sun_position(t).azimuth, 180, 3);
  EXPECT_NEAR(sun_position(t).elevation, 90 - 48.1, 0.5);
  t.hour = 7;
  EXPECT_NEAR(sun_position(t).azimuth, 90, 15);
  t.latitude = -48.1, t.hour = 12;
  const double from_north = sun_position(t).azimuth;
  EXPECT_LT(std::min(from_north, 360 - from_north), 3);
}

TEST(SunPosition, ClocksAndDaysAreOneTime) {
  const SunTime noon{.hour = 12, .utc_offset = 2, .latitude = 48, .longitude = 11};
  SunTime utc = noon;
  utc.hour = 10, utc.utc_offset = 0;
  EXPECT_NEAR(sun_position(noon).azimuth, sun_position(utc).azimuth, 1e-6);
  SunTime late = noon, early = noon;
  late.hour = 26, early.day = noon.day + 1, early.hour = 2;
  EXPECT_NEAR(sun_position(late).elevation, sun_position(early).elevation, 1e-6);
}

// At the horizon the air lifts the sun by 34′; nowhere does it jump.
TEST(SunPosition, RefractionIsContinuous) {
  double last = 0;
  for (double hour = 0; hour < 12; hour += 0.002) {
    const SunPosition p = sun_position({.hour = hour, .latitude = 48});
    if (hour > 0) {
      EXPECT_NEAR(p.refraction, last, 0.02) << hour;
    }
    last = p.refraction;
    if (std::abs(p.elevation - p.refraction) < 0.01) {
      EXPECT_NEAR(p.refraction, 0.48, 0.01);
    }
  }
}

TEST(SunTime, IsReadAndSaid) {
  SunTime t;
  read_date(t, "2024-02-29", "--date");
  EXPECT_EQ(t.year * 10000 + t.month * 100 + t.day, 20240229);
  read_place(t, "-33.9,151.2", "--place");
  EXPECT_EQ(t.latitude, -33.9);
  EXPECT_EQ(t.longitude, 151.2);
  EXPECT_EQ(read_hour("17:30", ""), 17.5);
  EXPECT_EQ(read_hour("24:00", ""), 24);
  EXPECT_NEAR(read_hour("17:30:36", ""), 17.51, 1e-12);
  EXPECT_EQ(clock_text(17.5), "17:30");
  EXPECT_EQ(clock_text(17.51), "17:30:36");
  EXPECT_EQ(clock_text(30), "06:00");
  EXPECT_EQ(nautical_utc_offset(11.6), 1);
  EXPECT_EQ(nautical_utc_offset(-105.2), -7);
}

TEST(SunTime, WhatThereIsNotIsRefused) {
  const auto date = [](const char* text) {
    return message_of([&] {
      SunTime t;
      read_date(t, text, "--date");
    });
  };
  EXPECT_EQ(date("2026-02-30"), "--date 2026-02-30: sun: day: 30 is out of range (1 to 28 has that month)");
  EXPECT_TRUE(date("2026-13-01").starts_with("--date 2026-13-01: sun: month: 13")) << date("2026-13-01");
  EXPECT_EQ(date("21.6.2026"), "--date: \"21.6.2026\" is no date (write YEAR-MONTH-DAY, as 2026-06-21)");
  EXPECT_NE(date("2026-06"), "no error");
  const auto hour = [](const char* text) { return message_of([&] { read_hour(text, "--time-of-day"); }); };
  for (const char* bad : {"25:00", "24:01", "12", "12:60", "-1:00", "noon", "12:00pm", ""})
    EXPECT_NE(hour(bad).find("is no time of day"), std::string::npos) << bad;
  const auto place = [](const char* text) {
    return message_of([&] {
      SunTime t;
      read_place(t, text, "--place");
    });
  };
  EXPECT_EQ(place("91,0"), "--place 91,0: sun: latitude: 91 is out of range (-90 to 90 degrees)");
  EXPECT_NE(place("0,181"), "no error");
  EXPECT_NE(place("48.1"), "no error");
  EXPECT_NE(place("Munich"), "no error");
  EXPECT_NE(message_of([] { sun_position({.latitude = std::nan("")}); }), "no error");
}

}  // namespace
}  // namespace ssphh::scene
