// A sun by date, time and place in an overlay.

#include <gmock/gmock.h>

#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene_io/overlay.h>

#include "error_message.h"

namespace ssphh::scene_io {
namespace {

using testing::HasSubstr;

std::string said(const std::string& sky) {
  return test::message_of([&] {
    scene::Scene scene;
    apply_overlay(scene, R"({"sun_sky": )" + sky + "}", "o.json");
  });
}

TEST(OverlaySun, StandsWhereTheCalendarSays) {
  scene::Scene scene;
  apply_overlay(scene, R"({"sun_sky": {"date": "2026-06-21", "time_of_day": "17:30", "place": "48.1,11.6",
                           "utc_offset_hours": 2, "north_degrees": 30, "width": 16}})",
                "o.json");
  const scene::SunSkyParams expected =
      scene::at_time({.width = 16, .model = scene::SkyModel::physical},
                     {.hour = 17.5, .utc_offset = 2, .latitude = 48.1, .longitude = 11.6, .north = 30});
  EXPECT_EQ(scene.environment.value().sun_sky.value(), expected);
}

TEST(OverlaySun, HalfADateIsRefusedWithItsPlace) {
  EXPECT_THAT(said(R"({"date": "2026-06-21", "time_of_day": "12:00"})"), HasSubstr("o.json: sun_sky"));
  EXPECT_THAT(said(R"({"date": "2026-06-31", "time_of_day": "12:00", "place": "0,0"})"),
              HasSubstr("day: 31"));
  EXPECT_THAT(said(R"({"date": "2026-06-21", "time_of_day": "25:00", "place": "0,0"})"),
              HasSubstr("is no time of day"));
  EXPECT_THAT(
      said(R"({"date": "2026-06-21", "time_of_day": "12:00", "place": "0,0", "elevation_degrees": 3})"),
      HasSubstr("has the sun's angles and its date"));
  EXPECT_THAT(said(R"({"model": "hosek"})"), HasSubstr("physical"));
  EXPECT_EQ(said(R"({"model": "physical", "elevation_degrees": -10, "width": 16})"), "no error");
}

}  // namespace
}  // namespace ssphh::scene_io
