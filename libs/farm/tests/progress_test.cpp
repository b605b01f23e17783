/// What the one who waits for a farm is told, and results that are kept for the next time.

#include <gtest/gtest.h>

#include "farm_fixtures.h"
#include "farm_progress.h"
#include "memory_dir.h"
#include "result_cache.h"

namespace ssphh::farm {
namespace {

using ssphh::test::memory_dir;
using ssphh::test::TempDir;

/// Writes down what is told and logged.
class Listening : public testing::Test, public Progress {
 public:
  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override {
    told_ += stage + " " + std::to_string(total) + " " + unit + ";";
  }
  void advance(std::uint64_t count) override { told_ += std::to_string(count) + ";"; }
  void end() override { told_ += "end;"; }

 protected:
  void SetUp() override {
    set_log_sink([this](LogLevel, const std::string& line) { lines_.push_back(line); });
  }
  void TearDown() override { set_log_sink({}); }
  std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }
  std::string told_;
  std::vector<std::string> lines_;
};

using Lines = std::vector<std::string>;

TEST_F(Listening, TellsOfUnitsWorkersAndRetries) {
  {
    FarmProgress progress({this, nullptr}, "bake", 12, "probe steps");
    progress.cached(0);
    EXPECT_EQ(take_lines(), Lines{});
    progress.cached(1);
    EXPECT_EQ(take_lines(), Lines{"1 result is in the cache"});
    progress.cached(5);
    EXPECT_EQ(take_lines(), Lines{"5 results are in the cache"});
    FarmReport report;
    progress.finished(1, report);
    EXPECT_EQ(take_lines(), Lines{});
    report.workers = 2;
    progress.finished(2, report);
    EXPECT_EQ(take_lines(), Lines{"2 workers"});
    progress.finished(3, report);
    EXPECT_EQ(take_lines(), Lines{}) << "once";
    report.workers = 3, report.retries = 1;
    progress.finished(1, report);
    EXPECT_EQ(take_lines(), (Lines{"3 workers", "1 retry: workers were lost or failed"}));
    report.workers = 1, report.retries = 2;
    progress.finished(0, report);
    EXPECT_EQ(take_lines(), Lines{"2 retries: workers were lost or failed"});
  }
  EXPECT_EQ(told_, "bake 12 probe steps;0;1;5;1;2;3;1;0;end;");
}

TEST_F(Listening, ResultsAreKeptWhereThereIsACacheAndRoom) {
  const TempDir dir(memory_dir());
  const JobResult result{ProbeJobResult{bake::BakeStage::viz, 4, {}}, {1.5, 7, "w"}};
  const Hash128 key{1, 2};
  EXPECT_FALSE(find_result(nullptr, key));
  keep_result(nullptr, key, result);
  DiskCache cache(dir / "cache", 1 << 20);
  EXPECT_FALSE(find_result(&cache, key));
  keep_result(&cache, key, result);
  const auto found = find_result(&cache, key);
  ASSERT_TRUE(found);
  EXPECT_EQ(std::get<ProbeJobResult>(found->data).degree, 4);
  EXPECT_EQ(found->stats.rays, 7u);
  EXPECT_EQ(take_lines(), Lines{});
  const std::string other = "{}";
  cache.put(key, std::as_bytes(std::span(other)));
  EXPECT_FALSE(find_result(&cache, key));
  EXPECT_EQ(take_lines(), Lines{(dir / "cache").string() + ": result: \"format\" is missing"});
  DiskCache small(dir / "small", 10);
  keep_result(&small, key, result);
  const Lines lines = take_lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].starts_with("a result is not kept: " + (dir / "small").string() +
                                   ": the cache holds at most 10 "
                                   "bytes; "))
      << lines[0];
  EXPECT_TRUE(lines[0].ends_with(" are to be kept (give it a larger --cache-size)")) << lines[0];
}

}  // namespace
}  // namespace ssphh::farm
