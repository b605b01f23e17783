#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/image/exposure.h>

#include "not_finite.h"

namespace ssphh::image {
namespace {

using test::nan;
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Light over some ten stops, as a picture of a room has it.
Image room(unsigned seed, int width = 40, int height = 30) {
  std::mt19937 random(seed);
  std::normal_distribution<float> stops(-2, 1.5f), tint(0, 0.2f);
  Image image(width, height);
  for (float& x : image.pixels) x = std::exp2(stops(random) + tint(random));
  return image;
}

Image constant(float value, int channels = 3) {
  Image image(8, 8, channels);
  std::ranges::fill(image.pixels, value);
  return image;
}

TEST(AutomaticExposure, PutsWhatIsLitAlikeAMediumGreyNotWhite) {
  EXPECT_EQ(automatic_exposure(constant(0.18f)), 0.75f) << "nothing is near white";
  EXPECT_EQ(automatic_exposure(constant(0.18f, 1)), 0.75f);
  EXPECT_EQ(automatic_exposure(constant(0.36f)), -0.25f);
}

TEST(AutomaticExposure, ACurveShowsTheMeanAsBrightAsClipDoes) {
  for (const float y : {0.01f, 0.127f, 0.18f, 0.3f, 0.9f, 0.99f}) {
    EXPECT_EQ(light_shown_as(ToneCurve::clip, y), y);
    const vec3 light(light_shown_as(ToneCurve::filmic, y));
    EXPECT_NEAR(tone_map(light, {0, ToneCurve::filmic, 0}).x, y, 1e-5f);
  }
  for (unsigned seed = 0; seed < 20; ++seed) {
    // Of one light, and of as much as a highlight allows
    Image image = seed < 10 ? constant(std::exp2(0.3f * static_cast<float>(seed))) : room(seed);
    const auto mean_shown = [&](ToneCurve curve) {
      double sum = 0;
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x)
          sum += std::log2(static_cast<double>(luminance(image.rgb(x, y))));
      }
      const auto mean = static_cast<float>(std::exp2(sum / (image.width * image.height)));
      return tone_map(vec3(mean), {automatic_exposure(image, curve), curve, 0}).x;
    };
    // Both are rounded to a quarter; filmic's slope is up to 1.3 there.
    const float stops = std::log2(mean_shown(ToneCurve::filmic) / mean_shown(ToneCurve::clip));
    EXPECT_NEAR(stops, 0, seed < 10 ? 0.125f + 0.17f : 0.35f) << seed;
    EXPECT_LT(automatic_exposure(image, ToneCurve::filmic), automatic_exposure(image));
  }
}

TEST(AutomaticExposure, TwiceTheLightIsOneStopLess) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Image image = room(seed);
    const float ev = automatic_exposure(image);
    for (const int k : {-30, -7, -1, 1, 2, 13, 30}) {
      Image scaled = image;
      for (float& x : scaled.pixels) x = std::ldexp(x, k);
      EXPECT_EQ(automatic_exposure(scaled), ev - static_cast<float>(k)) << "seed " << seed << ", 2^" << k;
    }
  }
}

TEST(AutomaticExposure, DoesNotKnowWhereThePixelsAre) {
  Image image = room(1);
  const float ev = automatic_exposure(image);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    for (std::size_t p = image.pixels.size() / 3 - 1; p > 0; --p) {
      const std::size_t other = std::uniform_int_distribution<std::size_t>(0, p)(random);
      std::swap_ranges(image.pixels.begin() + static_cast<std::ptrdiff_t>(3 * p),
                       image.pixels.begin() + static_cast<std::ptrdiff_t>(3 * p + 3),
                       image.pixels.begin() + static_cast<std::ptrdiff_t>(3 * other));
    }
    EXPECT_EQ(automatic_exposure(image), ev);
  }
}

TEST(AutomaticExposure, DoesNotKnowHowManyPixelsThereAre) {
  const Image image = room(3, 7, 5);
  for (const int times : {2, 3, 10}) {
    Image larger(7 * times, 5 * times);
    for (int y = 0; y < larger.height; ++y) {
      for (int x = 0; x < larger.width; ++x) larger.set_rgb(x, y, image.rgb(x / times, y / times));
    }
    EXPECT_EQ(automatic_exposure(larger), automatic_exposure(image)) << times;
  }
}

TEST(AutomaticExposure, IsInQuarterStops) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const float quarters = 4 * automatic_exposure(room(seed));
    EXPECT_EQ(quarters, std::round(quarters));
  }
}

TEST(AutomaticExposure, AFewFirefliesChangeNothing) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Image image = room(seed);
    const float ev = automatic_exposure(image);
    for (int i = 0; i < 3; ++i) image.set_rgb(7 * i, 5 * i, vec3(1e6f));
    EXPECT_NEAR(automatic_exposure(image), ev, 0.25f) << "it may stand at the edge of a quarter";
  }
}

TEST(AutomaticExposure, DarkBackgroundAndBrokenPixelsDoNotCount) {
  const Image image = room(4, 20, 20);
  for (const float ignored : {0.0f, -1.0f, nan, infinite}) {
    Image framed(60, 60);
    std::ranges::fill(framed.pixels, ignored);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) framed.set_rgb(x + 20, y + 20, image.rgb(x, y));
    }
    EXPECT_EQ(automatic_exposure(framed), automatic_exposure(image)) << ignored;
  }
}

TEST(AutomaticExposure, APictureWithoutLightIsLeftAsItIs) {
  for (const float value : {0.0f, -2.0f, nan, infinite}) EXPECT_EQ(automatic_exposure(constant(value)), 0);
  EXPECT_THROW(automatic_exposure(Image{}), Error);
}

TEST(AutomaticExposure, HighlightsHoldItDownByUpToHalfAStop) {
  const auto with_highlights = [](float light) {
    Image lit(20, 20);
    for (int i = 0; i < 400; ++i) lit.set_rgb(i % 20, i / 20, vec3(i < 12 ? light : 0.18f));
    return automatic_exposure(lit);
  };
  EXPECT_EQ(with_highlights(0.36f), 0.75f);
  EXPECT_EQ(with_highlights(0.9f), 0);
  EXPECT_EQ(with_highlights(1.27f), -0.5f);
  EXPECT_EQ(with_highlights(1.51f), -0.25f);
  EXPECT_EQ(with_highlights(2), 0) << "half a stop would not save it";
  EXPECT_EQ(with_highlights(100), 0) << "a window in a room may burn out";
}

TEST(AutomaticExposure, DeepShadowsCountAsBlackNotAsLess) {
  const auto with_shadows = [](float light) {
    Image image(20, 20);
    for (int i = 0; i < 400; ++i) image.set_rgb(i % 20, i / 20, vec3(i < 160 ? light : 0.5f));
    return automatic_exposure(image);
  };
  EXPECT_EQ(with_shadows(1e-4f), with_shadows(1e-12f));
}

TEST(AutomaticExposure, AnyLightThatAFloatHoldsHasOne) {
  EXPECT_EQ(automatic_exposure(constant(std::numeric_limits<float>::max() / 4)),
            automatic_exposure(constant(1)) - 126);
  EXPECT_EQ(automatic_exposure(constant(std::numeric_limits<float>::denorm_min())), 0) << "that is darkness";
}

}  // namespace
}  // namespace ssphh::image
