#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/check_handler.h>
#include <ssphh/core/error.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/log.h>

namespace ssphh {
namespace {

TEST(Error, SaysWhereWhatAndWhatToDo) {
  EXPECT_STREQ(Error("a.glb", "is broken", "export it again").what(), "a.glb: is broken (export it again)");
  EXPECT_STREQ(Error("", "is broken").what(), "is broken");
}

TEST(CheckDeathTest, AbortsWithThePlace) {
  EXPECT_DEATH(SSPHH_CHECK(1 > 2), "check failed: 1 > 2");
}

TEST(CheckDeathTest, TellsAHostsHandlerBeforeItAborts) {
  const auto report = [](const char* condition, const char* file, int line) {
    std::fprintf(stderr, "host: %s in %s, line %s\n", condition, file, line > 0 ? "known" : "unknown");
  };
  EXPECT_EQ(set_check_handler(report), nullptr);
  EXPECT_DEATH(SSPHH_CHECK(1 > 2), "^host: 1 > 2 in .*error_hash_log_test.cpp, line known\n$");
  EXPECT_EQ(set_check_handler(nullptr), static_cast<CheckHandler>(report));
  EXPECT_DEATH(SSPHH_CHECK(1 > 2), "please report");
}

// XXH3-128 of the empty input, from the xxHash specification.
TEST(Hasher, EmptyInputHasThePublishedValue) {
  EXPECT_EQ(Hasher().finish().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(Hasher, DependsOnValuesOrderAndBoundaries) {
  const auto hash = [](auto&&... texts) {
    Hasher hasher;
    (hasher.text(texts), ...);
    return hasher.finish();
  };
  EXPECT_EQ(hash("ab", "c"), hash("ab", "c"));
  EXPECT_NE(hash("ab", "c"), hash("a", "bc"));
  EXPECT_NE(hash("a", "b"), hash("b", "a"));
  EXPECT_NE(Hasher().value(1).finish(), Hasher().value(2).finish());
  EXPECT_NE(Hasher().array(std::vector<float>{}).finish(), Hasher().finish());
}

TEST(Hasher, TakesEveryBitOfAValue) {
  const Hash128 zero = Hasher().value(std::uint64_t{0}).finish();
  for (int bit = 0; bit < 64; ++bit) EXPECT_NE(Hasher().value(std::uint64_t{1} << bit).finish(), zero) << bit;
  EXPECT_NE(Hasher().array(std::vector{1.0f, 2.0f}).finish(),
            Hasher().array(std::vector{2.0f, 1.0f}).finish());
}

TEST(Log, SinkReceivesWhatReachesTheThreshold) {
  std::vector<std::string> lines;
  LogSink old = set_log_sink([&](LogLevel, const std::string& line) { lines.push_back(line); });
  log(LogLevel::debug, "hidden");
  log_warning("{} and {}", 1, 2);
  set_log_sink(old);
  EXPECT_EQ(lines, std::vector<std::string>{"1 and 2"});
}

/// What the log writes to stderr at a threshold.
std::string written(LogLevel threshold) {
  testing::internal::CaptureStderr();
  set_log_level(threshold);
  log(LogLevel::debug, "a"), log(LogLevel::info, "b"), log(LogLevel::warning, "c"), log(LogLevel::error, "d");
  set_log_level(LogLevel::info);
  return testing::internal::GetCapturedStderr();
}

TEST(Log, LinesSayTheirLevelAndThoseBelowTheThresholdAreLeftOut) {
  EXPECT_EQ(written(LogLevel::debug), "debug: a\nb\nwarning: c\nerror: d\n");
  EXPECT_EQ(written(LogLevel::info), "b\nwarning: c\nerror: d\n");
  EXPECT_EQ(written(LogLevel::warning), "warning: c\nerror: d\n");
  EXPECT_EQ(written(LogLevel::error), "error: d\n");
}

}  // namespace
}  // namespace ssphh
