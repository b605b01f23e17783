/// The search for a spacing, step by step and on rooms whose number of probes is known.

#include "spacing_search.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ssphh::place {
namespace {

/// Wants 100 to 120 in 8 m × 4 m × 2 m, in grids of up to 6400 places.
SpacingSearch hundred() {
  return {vec3(8, 4, 2), 100, 120, 6400};
}
const float first = std::cbrt(0.64f), finest = 1.1f * std::cbrt(0.01f);

TEST(SpacingSearch, BeginsWithAsManyCellsAsProbes) {
  EXPECT_FLOAT_EQ(hundred().spacing(), first);
  // A floor counts as if a hundredth as thick as long.
  EXPECT_FLOAT_EQ(SpacingSearch(vec3(10, 0, 5), 5, 6, 1e6).spacing(), 1);
}

TEST(SpacingSearch, EndsWithWhatIsWanted) {
  for (const std::size_t good : {100u, 110u, 120u}) EXPECT_FALSE(hundred().go_on(good));
  for (const std::size_t bad : {0u, 99u, 121u}) EXPECT_TRUE(hundred().go_on(bad)) << bad;
}

TEST(SpacingSearch, GoesByTheCubeRootOfTheNumberFoundWithinBounds) {
  const auto factor = [](std::size_t count) {
    SpacingSearch search = hundred();
    EXPECT_TRUE(search.go_on(count));
    return search.spacing() / first;
  };
  EXPECT_NEAR(factor(340), std::cbrt(3.4), 1e-5);
  EXPECT_NEAR(factor(121), 1.1, 1e-5) << "a tenth at least";
  EXPECT_NEAR(factor(2000), 2, 1e-5) << "twice at most";
  EXPECT_NEAR(factor(40), std::cbrt(0.4), 1e-5);
  EXPECT_NEAR(factor(99), 0.9, 1e-5);
  EXPECT_NEAR(factor(5), 0.5, 1e-5);
  EXPECT_NEAR(factor(0), 0.5, 1e-5);
}

TEST(SpacingSearch, HalvesBetweenTooFineAndTooCoarse) {
  SpacingSearch search = hundred();
  search.go_on(800);  // too fine: twice as coarse
  EXPECT_FLOAT_EQ(search.spacing(), 2 * first);
  search.go_on(20);
  EXPECT_FLOAT_EQ(search.spacing(), std::sqrt(2.0f) * first);
  search.go_on(300);
  EXPECT_FLOAT_EQ(search.spacing(), std::pow(2.0f, 0.75f) * first);
  search.go_on(80);
  EXPECT_FLOAT_EQ(search.spacing(), std::pow(2.0f, 0.625f) * first);
}

TEST(SpacingSearch, TriesTheFinestThatMayBeAndEndsThere) {
  SpacingSearch search = hundred();
  EXPECT_TRUE(search.go_on(1));
  EXPECT_FLOAT_EQ(search.spacing(), 0.5f * first);
  EXPECT_TRUE(search.go_on(1));
  EXPECT_FLOAT_EQ(search.spacing(), finest) << "a quarter would be finer";
  EXPECT_FALSE(SpacingSearch(search).go_on(1));
  EXPECT_TRUE(search.go_on(500)) << "but not if that is too fine";
}

TEST(SpacingSearch, PrefersFewOverTheLowerLimitThenMany) {
  const SpacingSearch search = hundred();
  EXPECT_TRUE(search.prefers(60, 50));
  EXPECT_FALSE(search.prefers(50, 50));
  EXPECT_FALSE(search.prefers(40, 50));
  EXPECT_TRUE(search.prefers(100, 99));
  EXPECT_TRUE(search.prefers(900, 50)) << "of too many some can be left out";
  EXPECT_FALSE(search.prefers(99, 900));
  EXPECT_TRUE(search.prefers(100, 900));
  EXPECT_TRUE(search.prefers(130, 140));
  EXPECT_FALSE(search.prefers(140, 140));
  EXPECT_FALSE(search.prefers(99, 100));
}

}  // namespace
}  // namespace ssphh::place
