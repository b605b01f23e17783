// Histograms and false colours.

#include "model/reading.h"

#include <set>

#include <gtest/gtest.h>

namespace ssphh::viewer {
namespace {

TEST(Reading, StopsCountFromMiddleGreyAtTheExposure) {
  EXPECT_FLOAT_EQ(stops_of(0.18f, 0), 0);
  EXPECT_FLOAT_EQ(stops_of(0.72f, 0), 2);
  EXPECT_FLOAT_EQ(stops_of(0.18f, -3), -3);
  EXPECT_FLOAT_EQ(luminance_at(2, 1), 0.36f);
  for (const float ev : {-2.0f, 0.0f, 1.5f}) EXPECT_NEAR(stops_of(luminance_at(3, ev), ev), 3, 1e-5f);
}

TEST(Reading, EveryBandHasItsColour) {
  std::set<std::array<std::uint8_t, 3>> colors;
  for (int stop = -farthest_stop - 1; stop <= farthest_stop + 1; ++stop) colors.insert(color_of_stop(stop));
  EXPECT_EQ(colors.size(), stop_bands + 2u);
  EXPECT_EQ(color_of_stop(0), (std::array<std::uint8_t, 3>{128, 128, 128}));
  const auto dark = color_of_stop(-6), bright = color_of_stop(8);
  EXPECT_GT(dark[2], dark[0]);
  EXPECT_GT(bright[0], bright[2]);
}

TEST(Reading, PixelsFallIntoTheirBins) {
  image::Image image(8, 1);
  const float lights[] = {0, 0.18f, 0.18f, 0.36f, 0.36f * 1.01f, 1e9f, std::nanf(""), 0.18f / 512};
  for (int x = 0; x < 8; ++x) image.set_rgb(x, 0, vec3(lights[x]));
  const StopHistogram h = stop_histogram(image, 0);
  EXPECT_FLOAT_EQ(h.darker, 3 / 8.0f) << "black, none, and 9 stops below";
  EXPECT_FLOAT_EQ(h.brighter, 1 / 8.0f);
  const auto bin = [](int stop) {
    return static_cast<std::size_t>((stop + farthest_stop) * bins_per_stop + 2);
  };
  EXPECT_FLOAT_EQ(h.bins[bin(0)] + h.bins[bin(0) - 1], 2 / 8.0f);
  EXPECT_FLOAT_EQ(h.bins[bin(1)] + h.bins[bin(1) - 1], 2 / 8.0f);
  // The same light a stop brighter is a stop further right.
  EXPECT_FLOAT_EQ(stop_histogram(image, 1).bins[bin(2)] + stop_histogram(image, 1).bins[bin(2) - 1],
                  2 / 8.0f);
  EXPECT_EQ(stop_histogram(image::Image(), 0).darker, 0);
}

TEST(Reading, FalseColoursArePixelsBands) {
  image::Image image(5, 1);
  const float lights[] = {0, 0.18f, 0.18f * 1.3f, 0.18f * 1.5f, 1e6f};
  for (int x = 0; x < 5; ++x) image.set_rgb(x, 0, vec3(lights[x]));
  const image::Rgba8 out = false_color(image, 0);
  const int stops[] = {-100, 0, 0, 1, 100};
  for (std::size_t x = 0; x < 5; ++x) {
    const auto color = color_of_stop(stops[x]);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(out.rgba[4 * x + c], color[c]) << x;
    EXPECT_EQ(out.rgba[4 * x + 3], 255);
  }
}

TEST(Reading, SignsAreWritten) {
  EXPECT_EQ(stop_text(3), "+3");
  EXPECT_EQ(stop_text(0), "0");
  EXPECT_EQ(stop_text(-2), "−2");
}

}  // namespace
}  // namespace ssphh::viewer
