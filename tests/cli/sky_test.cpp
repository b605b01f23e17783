// A sky by date and place: what is asked, what is refused, what moves.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>

#include "here.h"
#include "options/command_line.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using test::run_here;
using testing::HasSubstr;

const std::vector<std::string> munich = {"--sky",   "physical",  "--date",       "2026-06-21",
                                         "--place", "48.1,11.6", "--utc-offset", "2"};

std::vector<std::string> render(const std::string& output, const std::vector<std::string>& more) {
  return joined({"render", "builtin:cornell", "-o", output, "--width", "8", "--height", "6", "--spp", "2"},
                more);
}

float mean_of(const std::string& file) {
  const image::Image picture = image::read_image(file);
  float sum = 0;
  for (const float value : picture.pixels) {
    EXPECT_TRUE(std::isfinite(value)) << file;
    sum += value;
  }
  return sum / static_cast<float>(picture.pixels.size());
}

TEST(Sky, DaysAreBrighterThanDusksAndDusksThanNights) {
  const test::TempDir dir;
  const auto brightness = [&](const char* clock) {
    const std::string file = dir / "sky.exr";
    run_here(joined(joined({"render", "builtin:house", "-o", file, "--width", "8", "--height", "6", "--spp",
                            "4", "--method", "path", "--camera", "outside"},
                           munich),
                    {"--time-of-day", clock}));
    return mean_of(file);
  };
  const float day = brightness("13:00"), dusk = brightness("22:00"), night = brightness("01:00");
  EXPECT_GT(day, 100 * dusk);
  EXPECT_GT(dusk, 100 * night);
  EXPECT_GT(night, 0) << "airglow and stars";
}

TEST(Sky, WhatIsMissingIsNamed) {
  const test::TempDir dir;
  const std::string file = dir / "x.exr";
  EXPECT_THAT(problem_here(render(file, {"--date", "2026-06-21"})), HasSubstr("--time-of-day is missing"));
  EXPECT_THAT(problem_here(render(file, {"--date", "2026-06-21", "--time-of-day", "12:00"})),
              HasSubstr("--place is missing"));
  EXPECT_THAT(problem_here(render(file, {"--time-of-day", "12:00", "--place", "0,0"})),
              HasSubstr("--date is missing"));
  EXPECT_THAT(problem_here(render(file, {"--north", "30"})), HasSubstr("of a sun by date and time"));
  EXPECT_THAT(problem_here(render(file, joined(munich, {"--time-of-day", "25:00"}))),
              HasSubstr("\"25:00\" is no time of day"));
  EXPECT_THAT(problem_here(render(file, joined(munich, {"--time-of-day", "06:00..20:00"}))),
              HasSubstr("is no time of day"))
      << "a picture has one time";
  EXPECT_THAT(
      problem_here(render(file, {"--date", "2026-02-29", "--time-of-day", "12:00", "--place", "0,0"})),
      HasSubstr("day: 29"));
  EXPECT_THAT(
      problem_here(render(file, {"--date", "2026-02-28", "--time-of-day", "12:00", "--place", "95,0"})),
      HasSubstr("latitude: 95"));
  EXPECT_THAT(problem_here(render(file, {"--sun-sky", "--date", "2026-06-21", "--time-of-day", "23:00",
                                         "--place", "48.1,11.6"})),
              HasSubstr("the physical sky has dusk and night"));
  EXPECT_THAT(problem_here(render(file, {"--sun-sky", "--sky", "physical"})),
              HasSubstr("leave one of them out"));
  EXPECT_THROW(run_here(render(file, joined(munich, {"--time-of-day", "12:00", "--sun-elevation", "10"}))),
               app::ParsingEnded);
  EXPECT_THROW(run_here(render(file, {"--sky", "hosek"})), app::ParsingEnded);
}

TEST(Sky, ASceneHasTheSunOfItsDate) {
  const test::TempDir dir;
  const auto hash = [&](const std::vector<std::string>& more) {
    return json_here(joined({"scene", "info", "builtin:cornell"}, more))["hash"].string();
  };
  const std::string noon = hash(joined(munich, {"--time-of-day", "13:00"}));
  EXPECT_NE(noon, hash(joined(munich, {"--time-of-day", "14:00"})));
  EXPECT_NE(noon, hash(joined(munich, {"--time-of-day", "13:00", "--north", "10"})));
  EXPECT_EQ(noon, hash({"--date", "2026-06-21", "--place", "48.1,11.6", "--time-of-day", "12:00"}))
      << "physical by itself; clocks an hour from UTC at 11.6 degrees";
}

TEST(Sky, TheSunMovesWithTheFrames) {
  const test::TempDir dir;
  const std::vector<std::string> base = {
      "relight", "builtin:cornell", "--probes", "scene",         "--frames", "3", "--degree",
      "2",       "--directions",    "64",       "--surfel-size", "0.5"};
  const json::Value day =
      json_here(joined(joined(base, munich), {"--time-of-day", "21:00..22:30", "--truth", "2", "--points",
                                              "64", "--truth-spp", "256"}));
  EXPECT_EQ(day["frames"].number(), 3);
  const json::Value& errors = day["error"];
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_THAT(problem_here(joined(base, {"--sun-sky", "--date", "2026-06-21", "--place", "48.1,11.6",
                                         "--time-of-day", "12:00..23:00"})),
              HasSubstr("the sun is below the horizon at"));
  EXPECT_THAT(problem_here(joined(base, {"--animate", "time-of-day=06:00..12:00"})),
              HasSubstr("the scene has no sky of a date and place"));
}

}  // namespace
}  // namespace ssphh
