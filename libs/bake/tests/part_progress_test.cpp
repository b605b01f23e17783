/// Progress of a part of the work, told in the units of the whole.

#include "part_progress.h"

#include <gtest/gtest.h>

namespace ssphh::bake {
namespace {

TEST(PartProgress, MapsAnyStagesOntoItsShareAndFillsItInTheEnd) {
  struct Counter final : Progress {
    std::uint64_t done = 0;
    void begin(const std::string&, std::uint64_t, const std::string&) override {}
    void advance(std::uint64_t n) override { done += n; }
    void end() override {}
  } counter;
  ProgressStage whole({&counter, nullptr}, "all", 100, "units");
  {
    PartProgress part(whole, 40);
    part.advance(3);
    EXPECT_EQ(counter.done, 0u) << "of no known total";
    part.begin("first", 8, "rays");
    part.advance(2);
    EXPECT_EQ(counter.done, 10u);
    part.advance(4);
    EXPECT_EQ(counter.done, 30u);
    part.begin("second", 2, "rays");
    part.advance(1);
    EXPECT_EQ(counter.done, 30u) << "does not go back";
    part.advance(9);
    EXPECT_EQ(counter.done, 40u) << "and never beyond";
  }
  EXPECT_EQ(counter.done, 40u);
  { PartProgress part(whole, 25); }
  EXPECT_EQ(counter.done, 65u);
}

}  // namespace
}  // namespace ssphh::bake
