// Progress as the tool tells it on stderr.

#include <gmock/gmock.h>

#include "json_text.h"
#include "results/stderr_progress.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

/// What stands on stderr after a stage of which `done` of `total` units were done at once.
std::string told(ProgressStyle style, std::uint64_t total, std::uint64_t done, const char* unit = "rays") {
  testing::internal::CaptureStderr();
  StderrProgress progress(style);
  progress.begin("baking", total, unit);
  progress.advance(done - done / 2);
  progress.advance(done / 2);
  progress.end();
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, NoneSaysNothing) {
  EXPECT_EQ(told(ProgressStyle::none, 10, 10), "");
}

TEST(Progress, IsInPlainLinesWhereThereIsNoTerminal) {
  const std::string line = told(ProgressStyle::automatic, 10, 10);
  EXPECT_THAT(line, MatchesRegex("baking: 10 rays in .*\n"));
}

TEST(Progress, JsonTellsRateAndRemainingTimeOfOneLine) {
  const json::Value line = test::parse_json(told(ProgressStyle::json, 40, 10));
  EXPECT_EQ(line["stage"], "baking");
  EXPECT_EQ(line["unit"], "rays");
  EXPECT_EQ(line["done"], 10);
  EXPECT_EQ(line["total"], 40);
  const double seconds = line["seconds"].number(), rate = line["rate"].number(), eta = line["eta"].number();
  EXPECT_GT(seconds, 0);
  EXPECT_NEAR(rate * seconds, 10, 1e-6);
  EXPECT_NEAR(eta * rate, 30, 1e-6);
  EXPECT_EQ(test::parse_json(told(ProgressStyle::json, 40, 40))["eta"], 0);
  EXPECT_EQ(test::parse_json(told(ProgressStyle::json, 40, 0))["eta"], 0) << "not known";
  EXPECT_EQ(test::parse_json(told(ProgressStyle::json, 40, 50))["eta"], 0) << "more than was said";
}

TEST(Progress, ANewStageBeginsAtNothing) {
  testing::internal::CaptureStderr();
  StderrProgress progress(ProgressStyle::json);
  progress.begin("one", 5, "rays");
  progress.advance(5);
  progress.begin("two", 7, "texels");
  progress.end();
  const json::Value line = test::parse_json(testing::internal::GetCapturedStderr());
  EXPECT_EQ(line["stage"], "two");
  EXPECT_EQ(line["unit"], "texels");
  EXPECT_EQ(line["done"], 0);
  EXPECT_EQ(line["total"], 7);
}

TEST(Progress, ALastLineTellsHowManyInThousandsAndMillions) {
  const auto line = [](std::uint64_t done) { return told(ProgressStyle::plain, done, done); };
  // "." stands for any digit; nothing here takes a second.
  EXPECT_THAT(line(999), MatchesRegex("baking: 999 rays in 0\\.. s, [0-9.]+[kMGT]? rays/s\n"));
  EXPECT_THAT(line(1000), HasSubstr("baking: 1.0k rays in"));
  EXPECT_THAT(line(1250000), HasSubstr("baking: 1.2M rays in"));
  EXPECT_THAT(line(3000000000), HasSubstr("baking: 3.0G rays in"));
  EXPECT_THAT(line(4000000000000), HasSubstr("baking: 4.0T rays in"));
  EXPECT_THAT(line(5000000000000000), HasSubstr("baking: 5000.0T rays in")) << "no unit is larger";
}

TEST(Progress, ARateIsByTheSecondMinuteOrHourThatMakesItAtLeastOne) {
  const auto text = [](double per_second) { return rate_text(per_second, "frames"); };
  EXPECT_EQ(text(1500), "1.5k frames/s");
  EXPECT_EQ(text(1), "1 frames/s");
  EXPECT_EQ(text(0.99), "59.4 frames/min");
  EXPECT_EQ(text(1. / 60), "1.0 frames/min");
  EXPECT_EQ(text(0.01), "36.0 frames/h");
  EXPECT_EQ(text(1e-4), "0.4 frames/h") << "no unit is longer";
  EXPECT_EQ(text(0), "0 frames/s");
}

TEST(Progress, ATimeIsInMinutesUntilItIsAnHour) {
  EXPECT_EQ(clock_text(0.49), "0:00");
  EXPECT_EQ(clock_text(59.4), "0:59");
  EXPECT_EQ(clock_text(59.5), "1:00") << "rounded";
  EXPECT_EQ(clock_text(754), "12:34");
  EXPECT_EQ(clock_text(3599.4), "59:59");
  EXPECT_EQ(clock_text(3600), "1:00:00");
  EXPECT_EQ(clock_text(7325), "2:02:05");
}

TEST(Progress, ABarFillsWithTheShareThatIsDone) {
  const auto bar = [](std::uint64_t done) { return told(ProgressStyle::bar, 48, done); };
  EXPECT_THAT(bar(0), testing::StartsWith("\r[" + std::string(24, '.') + "] baking: 0 rays in"));
  EXPECT_THAT(bar(13), HasSubstr("\r[" + std::string(6, '#') + std::string(18, '.') + "] "));
  EXPECT_THAT(bar(48), HasSubstr("\r[" + std::string(24, '#') + "] "));
  EXPECT_THAT(bar(96), HasSubstr("\r[" + std::string(24, '#') + "] ")) << "never more than full";
  EXPECT_THAT(bar(48), testing::EndsWith("\x1b[K\n"));
  EXPECT_THAT(told(ProgressStyle::bar, 0, 0), HasSubstr("[" + std::string(24, '#') + "] "))
      << "a stage without work is done";
}

TEST(Progress, WhatIsUnderWayTellsShareAndRemainingTime) {
  testing::internal::CaptureStderr();
  StderrProgress progress(ProgressStyle::bar);
  progress.begin("baking", 1000, "rays");
  // A bar is drawn anew ten times a second, at most.
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(101)) {
  }
  progress.advance(100);
  progress.advance(1);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string line = testing::internal::GetCapturedStderr();
  EXPECT_THAT(line, testing::StartsWith("\r[##" + std::string(22, '.') + "] baking:  10 %, "));
  // 100 in a tenth of a second at most: 900 more take nine times as long.
  const double left = 9 * seconds;
  EXPECT_THAT(line, HasSubstr(" rays/s, 0:0"));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\r'), 1) << line;
  EXPECT_THAT(line, testing::Not(HasSubstr("\n")));
  const std::size_t at = line.find(" rays/s, ") + 9;
  EXPECT_LE(std::stod(line.substr(at + 2)), left + 0.5);
  EXPECT_GE(std::stod(line.substr(at + 2)), 0);
}

}  // namespace
}  // namespace ssphh::app
