#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/image/tonemap.h>
#include <ssphh/image/transfer.h>

#include "test_images.h"

namespace ssphh::image {
namespace {

TEST(ToneMap, OneStopDoublesTheLight) {
  const vec3 color(0.1f, 0.2f, 0.3f);
  EXPECT_EQ(tone_map(color, {1, ToneCurve::clip, 0}), 2.0f * color);
  EXPECT_EQ(tone_map(color, {-2, ToneCurve::clip, 0}), 0.25f * color);
  EXPECT_EQ(tone_map(color, {10, ToneCurve::clip, 0}), vec3(1));
}

TEST(ToneMap, FilmicFollowsItsFormula) {
  const ToneMap filmic{0, ToneCurve::filmic, 0};
  EXPECT_FLOAT_EQ(tone_map(vec3(1), filmic).x, 2.54f / 3.16f);
  EXPECT_FLOAT_EQ(tone_map(vec3(0.18f), filmic).x, 0.18f * 0.4818f / (0.18f * 1.0274f + 0.14f));
}

TEST(ToneMap, CurvesNeverFallAndStayInTheUnitInterval) {
  for (const ToneCurve curve : {ToneCurve::clip, ToneCurve::filmic}) {
    float last = 0;
    for (int i = -200; i < 400; ++i) {
      const float now = tone_map(vec3(std::exp2(static_cast<float>(i) / 10)), {0, curve, 0}).x;
      EXPECT_GE(now, last);
      EXPECT_LE(now, 1);
      last = now;
    }
    EXPECT_EQ(last, 1);
    EXPECT_EQ(tone_map(vec3(std::numeric_limits<float>::infinity()), {0, curve, 0}), vec3(1));
    EXPECT_EQ(tone_map(vec3(std::numeric_limits<float>::quiet_NaN()), {0, curve, 0}), vec3(0));
    EXPECT_EQ(tone_map(vec3(-1), {0, curve, 0}), vec3(0));
  }
}

TEST(ToneMap, TheDisplayCodesAreThoseOfThePng) {
  const Image image = test::noise_image(16, 16, 3, 2);
  const ToneMap params{-0.5f, ToneCurve::filmic, 0};
  EXPECT_EQ(to_display(image, params).rgba, decode_rgba8(encode_png(tone_map(image, params)), "png").rgba);
}

TEST(ToneMap, ImagesAreMappedPixelByPixelAndKeepTheirAlpha) {
  const ToneMap params{1.5f, ToneCurve::filmic, 0};
  const Image image = test::noise_image(5, 3, 4, 1), mapped = tone_map(image, params);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(mapped.rgb(x, y), tone_map(image.rgb(x, y), params));
      EXPECT_EQ(mapped.at(x, y)[3], image.at(x, y)[3]);
    }
  }
}

TEST(ToneMap, GammaEncodesAsAPowerAndAlphaStaysLinear) {
  Image image(1, 1, 4);
  image.pixels = {0.5f, 1, 0, 0.5f};
  const Rgba8 out = to_display(image, {0, ToneCurve::clip, 2.0f});
  EXPECT_EQ(out.rgba, (std::vector<std::uint8_t>{180, 255, 0, 128}));  // 255·√½ = 180.3
}

}  // namespace
}  // namespace ssphh::image
