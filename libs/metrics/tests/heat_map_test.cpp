#include <limits>

#include <gtest/gtest.h>

#include <ssphh/metrics/heat_map.h>

namespace ssphh::metrics {
namespace {

using image::Image;
using image::Rgba8;

// Within the polynomial fit's error, about 2/255 of matplotlib's table.
constexpr float fit = 0.02f;

TEST(ColorRamp, HitsTheKnownEndsOfInferno) {
  const vec3 low = ramp_color(ColorRamp::inferno, 0), middle = ramp_color(ColorRamp::inferno, 0.5f),
             high = ramp_color(ColorRamp::inferno, 1);
  EXPECT_LT(glm::length(low - vec3(0.001462f, 0.000466f, 0.013866f)), fit);
  EXPECT_LT(glm::length(middle - vec3(0.735683f, 0.215906f, 0.330245f)), fit);
  EXPECT_LT(glm::length(high - vec3(0.988362f, 0.998364f, 0.644924f)), fit);
}

TEST(ColorRamp, GrowsBrighterWithTheError) {
  float last = -1;
  for (int i = 0; i <= 100; ++i) {
    const float now = luminance(ramp_color(ColorRamp::inferno, static_cast<float>(i) / 100));
    EXPECT_GT(now, last) << i;
    last = now;
  }
}

TEST(ColorRamp, ClampsAndMarksNan) {
  for (const ColorRamp ramp : {ColorRamp::inferno, ColorRamp::diverging, ColorRamp::grey}) {
    EXPECT_EQ(ramp_color(ramp, 7), ramp_color(ramp, 1));
    EXPECT_EQ(ramp_color(ramp, -7), ramp_color(ramp, -1));
    EXPECT_EQ(ramp_color(ramp, std::numeric_limits<float>::quiet_NaN()), vec3(1, 0, 1));
  }
  EXPECT_GT(ramp_color(ColorRamp::diverging, 1).x, 2 * ramp_color(ColorRamp::diverging, 1).z);
  EXPECT_GT(ramp_color(ColorRamp::diverging, -1).z, 2 * ramp_color(ColorRamp::diverging, -1).x);
}

// Moreland, Diverging Color Maps for Scientific Visualization, 2009: cool to warm.
TEST(ColorRamp, DivergesFromGreyToBlueAndRed) {
  EXPECT_EQ(ramp_color(ColorRamp::diverging, -1), vec3(0.230f, 0.299f, 0.754f));
  EXPECT_EQ(ramp_color(ColorRamp::diverging, 0), vec3(0.865f));
  EXPECT_EQ(ramp_color(ColorRamp::diverging, 1), vec3(0.706f, 0.016f, 0.150f));
  EXPECT_LT(glm::length(ramp_color(ColorRamp::diverging, -0.5f) - vec3(0.5475f, 0.582f, 0.8095f)), 1e-6f);
}

TEST(HeatMap, ShowsTheMeanOfTheChannelsWithItsSign) {
  Image map(2, 1);
  map.set_rgb(0, 0, vec3(-1, -2, -6)), map.set_rgb(1, 0, vec3(0.5f, 1, 0));
  EXPECT_FLOAT_EQ(automatic_scale(map), 0.5f)
      << "of two magnitudes, 3 and 0.5, the lower is the 99th percentile";
  const Rgba8 picture = heat_map(map, ColorRamp::diverging, 6);
  const vec3 half = ramp_color(ColorRamp::diverging, -0.5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.rgba[c], 255 * half[c], 0.51f) << c;
}

TEST(HeatMap, ScalesByThe99thPercentileAndIgnoresNan) {
  Image map(100, 1, 1);
  for (int x = 0; x < 100; ++x) map.pixels[x] = static_cast<float>(x + 1);
  map.pixels[99] = 1e9f;
  EXPECT_EQ(automatic_scale(map), 99);
  map.pixels[99] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(automatic_scale(map), 98);
  EXPECT_EQ(automatic_scale(Image(3, 3)), 1);
}

TEST(HeatMap, ASingleErrorIsSeen) {
  Image map(100, 100);
  map.set_rgb(7, 3, vec3(0.001f));
  EXPECT_FLOAT_EQ(automatic_scale(map), 0.001f);
  const Rgba8 picture = heat_map(map, ColorRamp::grey);
  EXPECT_EQ(picture.width, 100);
  EXPECT_EQ(picture.rgba[4 * (3 * 100 + 7)], 255);
  EXPECT_EQ(picture.rgba[4 * (3 * 100 + 8)], 0);
  EXPECT_EQ(picture.rgba[4 * (3 * 100 + 8) + 3], 255);
}

TEST(HeatMap, BlocksAreEnlargedToTheImage) {
  Image blocks(2, 2, 1);
  blocks.pixels = {1, 2, 3, 4};
  const Image out = enlarge_blocks(blocks, 3, 5, 4);
  EXPECT_EQ(out.rgb(2, 2).x, 1);
  EXPECT_EQ(out.rgb(3, 2).x, 2);
  EXPECT_EQ(out.rgb(2, 3).x, 3);
  EXPECT_EQ(out.rgb(4, 3).x, 4);
}

}  // namespace
}  // namespace ssphh::metrics
