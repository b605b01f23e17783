#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/mask.h>

namespace ssphh::metrics {
namespace {

using image::Image;

// A picture of 4 × 2 with an error of 1 in the left half and 3 in the right one.
TEST(Mask, OnlyItsPixelsAreMeasured) {
  Image reference(4, 2), test(4, 2), mask(2, 1);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      reference.set_rgb(x, y, vec3(2));
      test.set_rgb(x, y, vec3(x < 2 ? 3.0f : 5.0f));
    }
  }
  mask.set_rgb(0, 0, vec3(0)), mask.set_rgb(1, 0, vec3(1));  // of half the size: each pixel stands for four
  const ImageError right = compare(masked(reference, mask), test);
  EXPECT_EQ(right.mae, 3);
  EXPECT_EQ(right.pixels, 4u);
  EXPECT_EQ(pixels_outside(mask, 4, 2), 4u);
  mask.set_rgb(0, 0, vec3(1)), mask.set_rgb(1, 0, vec3(0));
  EXPECT_EQ(compare(masked(reference, mask), test).mae, 1);
}

TEST(Mask, AColourCountsByItsMeanFromOneHalfOn) {
  Image mask(1, 1);
  const auto inside = [&](const vec3& color) {
    mask.set_rgb(0, 0, color);
    return in_mask(mask, 0, 0, 1, 1);
  };
  EXPECT_TRUE(inside(vec3(0.5f)));
  EXPECT_FALSE(inside(vec3(0.499f)));
  EXPECT_TRUE(inside(vec3(0, 0.75f, 0.75f)));
  EXPECT_FALSE(inside(vec3(1, 0.25f, 0)));
}

TEST(Mask, EveryPixelOfOddSizesHasItsNearestOne) {
  Image mask(3, 3);
  for (int i = 0; i < 9; ++i) mask.set_rgb(i % 3, i / 3, vec3(i == 4 ? 1.0f : 0.4f));
  int inside = 0;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) inside += in_mask(mask, x, y, 7, 7);
  // Centres at (i + 1/2)/7 within [1/3, 2/3): i = 2, 3, 4.
  EXPECT_EQ(inside, 9);
  EXPECT_TRUE(in_mask(mask, 2, 2, 7, 7));
  EXPECT_FALSE(in_mask(mask, 5, 3, 7, 7));
}

}  // namespace
}  // namespace ssphh::metrics
