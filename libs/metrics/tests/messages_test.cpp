/// What is meant where nobody says anything, and what is said of what cannot be.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/heat_map.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/metrics/perceptual.h>

#include "error_message.h"

namespace ssphh::metrics {
namespace {

using image::Image;
using ssphh::test::message_of;

TEST(MetricsDefaults, AreNamed) {
  const ImageError error;
  EXPECT_EQ(error.width + error.height, 0);
  EXPECT_EQ(error.pixels + error.nonfinite_pixels, 0u);
  for (const double value :
       {error.sum, error.mae, error.bias, error.max, error.mse, error.rmse, error.relmse, error.mape,
        error.smape, error.mean_ratio[0], error.mean_ratio[1], error.mean_ratio[2]})
    EXPECT_EQ(value, 0);
  const BlockError block;
  EXPECT_EQ(block.block + block.columns + block.rows + block.max_column + block.max_row, 0);
  EXPECT_EQ(block.max + block.mean, 0);
  const DisplayError display;
  EXPECT_EQ(display.psnr, 0);
  EXPECT_EQ(display.ssim, 0);
  const FlipError flipped;
  EXPECT_EQ(flipped.mean + flipped.first_exposure + flipped.last_exposure, 0);
  EXPECT_EQ(flipped.exposures, 0);
  EXPECT_EQ(relative_epsilon, 0.01);
  // 3840 pixels on 0.7 m, seen from 0.7 m.
  EXPECT_NEAR(FlipParams().pixels_per_degree, 0.7 * 3840 / 0.7 * pi_d / 180, 1e-9);
  Image map(2, 1, 1);
  map.pixels = {0.1f, 0.2f};
  EXPECT_EQ(heat_map(map, ColorRamp::grey).rgba, heat_map(map, ColorRamp::grey, automatic_scale(map)).rgba);
}

TEST(MetricsMessages, OfImagesThatCannotBeCompared) {
  const Image a(4, 3), none;
  const auto said = [](const Image& reference, const Image& test) {
    const std::string first = message_of([&] { compare(reference, test); });
    EXPECT_EQ(message_of([&] { absolute_error_map(reference, test); }), first);
    EXPECT_EQ(message_of([&] { signed_error_map(reference, test); }), first);
    EXPECT_EQ(message_of([&] { relative_squared_error_map(reference, test); }), first);
    EXPECT_EQ(message_of([&] { pixelated_error_map(reference, test, 2); }), first);
    EXPECT_EQ(message_of([&] { display_error(reference, test); }), first);
    EXPECT_EQ(message_of([&] { flip(reference, test); }), first);
    EXPECT_EQ(message_of([&] { hdr_flip(reference, test); }), first);
    return first;
  };
  EXPECT_EQ(said(a, a), "no error");
  EXPECT_EQ(said(a, none), "compare: an image is empty");
  EXPECT_EQ(said(none, a), "compare: an image is empty");
  EXPECT_EQ(said(a, Image(4, 5)), "compare: sizes differ: reference 4 x 3, test 4 x 5");
  EXPECT_EQ(said(Image(2, 3), a), "compare: sizes differ: reference 2 x 3, test 4 x 3");
  EXPECT_EQ(said(Image(4, 3, 2), a), "compare: an image must have 1, 3 or 4 channels");
  EXPECT_EQ(said(a, Image(4, 3, 2)), "compare: an image must have 1, 3 or 4 channels");
}

TEST(MetricsMessages, OfBlocksMasksAndScales) {
  const Image a(4, 3), none;
  EXPECT_EQ(message_of([&] { pixelated_error_map(a, a, 0); }),
            "compare: blocks of 0 pixels are impossible (use 1 or more)");
  EXPECT_EQ(message_of([&] { block_error(none, 1); }), "pixelated map: the image is empty");
  EXPECT_EQ(message_of([&] { automatic_scale(none); }), "heat map: the image is empty");
  EXPECT_EQ(message_of([&] { heat_map(none, ColorRamp::grey); }), "heat map: the image is empty");
  for (const float scale : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(message_of([&] { heat_map(a, ColorRamp::grey, scale); }),
              "heat map: its scale must be a number");
  const auto enlarged = [&](int block, int width, int height) {
    return message_of([&] { enlarge_blocks(a, block, width, height); });
  };
  const std::string cover = "pixelated map: its blocks do not cover the picture";
  EXPECT_EQ(enlarged(5, 20, 15), "no error");
  EXPECT_EQ(enlarged(5, 1, 1), "no error");
  EXPECT_EQ(enlarged(5, 21, 15), cover);
  EXPECT_EQ(enlarged(5, 20, 16), cover);
  EXPECT_EQ(enlarged(0, 4, 3), cover);
  EXPECT_EQ(enlarged(1, 0, 3), cover);
  EXPECT_EQ(enlarged(1, 4, 0), cover);
  EXPECT_EQ(message_of([&] { enlarge_blocks(none, 1, 1, 1); }), cover);
  EXPECT_EQ(message_of([&] { in_mask(none, 0, 0, 1, 1); }), "mask: the image is empty");
  EXPECT_EQ(message_of([&] { in_mask(a, 7, 5, 8, 6); }), "no error");
  for (const auto& at : {std::pair{-1, 0}, {0, -1}, {8, 0}, {0, 6}})
    EXPECT_EQ(message_of([&] { in_mask(a, at.first, at.second, 8, 6); }),
              "mask: the pixel does not lie in the picture");
  EXPECT_EQ(message_of([&] { masked(none, a); }), "masked picture: the image is empty");
}

TEST(MetricsMessages, OfTheEye) {
  const Image a(4, 3);
  const auto said = [&](double pixels_per_degree) {
    return message_of([&] { flip(a, a, {pixels_per_degree}); });
  };
  EXPECT_EQ(said(1), "no error");
  for (const double bad : {0.0, -1.0, 10'000.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(said(bad), "FLIP: pixels per degree must lie in 0..10000") << bad;
  EXPECT_EQ(message_of([&] { hdr_flip(a, a, {0}); }), "FLIP: pixels per degree must lie in 0..10000");
}

}  // namespace
}  // namespace ssphh::metrics
