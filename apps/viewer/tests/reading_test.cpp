// Histograms, waveforms and false colours.

#include "model/reading.h"

#include <algorithm>
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

/// The bin that has all of a column, where one has.
int line_at(const Waveform::Column& column) {
  const auto most = std::ranges::max_element(column);
  EXPECT_NEAR(*most, 1, 1e-5f);
  return static_cast<int>(most - column.begin());
}

TEST(Reading, AGradientIsALineOfTheWaveform) {
  // 2 pixels a column, each column a bin brighter in red, a bin darker in green; blue is black, then too
  // bright.
  image::Image image(2 * waveform_columns, 3);
  for (int x = 0; x < image.width; ++x) {
    const auto stop = static_cast<float>(x / 2 - waveform_columns / 2) / bins_per_stop;
    for (int y = 0; y < image.height; ++y)
      image.set_rgb(x, y,
                    {luminance_at(stop + 0.125f, 0), luminance_at(0.125f - stop, 0), x < 64 ? 0 : 1e9f});
  }
  const Waveform shown = waveform(image, 0), brighter = waveform(image, 1);
  const int grey = farthest_stop * bins_per_stop + bins_per_stop / 2;
  for (int c = 0; c < waveform_columns; ++c) {
    const auto column = static_cast<std::size_t>(c);
    EXPECT_EQ(line_at(shown.channels[0][column]), grey + c - waveform_columns / 2) << c;
    EXPECT_EQ(line_at(shown.channels[1][column]), grey - c + waveform_columns / 2) << c;
    EXPECT_EQ(line_at(shown.channels[2][column]), c < 32 ? 0 : static_cast<int>(stop_bins) - 1) << c;
    if (c < 32) {
      EXPECT_EQ(line_at(brighter.channels[0][column]), grey + c - waveform_columns / 2 + bins_per_stop);
    }
  }
}

TEST(Reading, WaveformsOfAnySizeHaveWholeColumns) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {65, 3}, {1000, 700}}) {
    image::Image image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) image.set_rgb(x, y, vec3(y % 2 == 0 ? 0.18f : std::nanf("")));
    }
    const Waveform shown = waveform(image, 0);
    for (const auto& channel : shown.channels) {
      for (const auto& column : channel) {
        float sum = 0;
        for (const float share : column) sum += share;
        EXPECT_NEAR(sum, 1, 1e-3f) << width;
        if (height == 5) {
          EXPECT_NEAR(column[0], 0.4f, 1e-5f) << "none of it is light";
        }
      }
    }
  }
  EXPECT_EQ(waveform(image::Image(), 0).channels[0][0][0], 0);
}

TEST(Reading, AWipesWaveformHasBothSides) {
  image::Image dark(64, 1), bright(64, 1);
  for (int x = 0; x < 64; ++x) dark.set_rgb(x, 0, vec3(0.18f / 8)), bright.set_rgb(x, 0, vec3(0.18f * 8));
  const Waveform a = waveform(dark, 0), b = waveform(bright, 0), both = wiped(a, b, 0.25f);
  for (std::size_t column = 0; column < 64; ++column)
    EXPECT_EQ(both.channels[1][column], (column < 16 ? a : b).channels[1][column]) << column;
  EXPECT_EQ(wiped(a, b, 0).channels, b.channels);
  EXPECT_EQ(wiped(a, b, 1).channels, a.channels);
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
