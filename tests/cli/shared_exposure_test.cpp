// The exposure of pictures that belong together.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/image/exposure.h>

#include "results/pictures.h"

namespace ssphh::app {
namespace {

image::Image grey(float light) {
  image::Image picture(4, 3);
  for (float& x : picture.pixels) x = light;
  return picture;
}

TEST(SharedExposure, IsThatOfTheFirstPictureThatIsNotBlack) {
  SharedExposure exposure(std::nullopt);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  for (const float dark : {0.0f, -1.0f, nan, infinite}) EXPECT_EQ(exposure.of(grey(dark)), 0);
  EXPECT_EQ(exposure.chosen(), std::nullopt);
  const float suits = image::automatic_exposure(grey(7));
  for (const float light : {7.0f, 0.01f, 0.0f, 900.0f}) EXPECT_EQ(exposure.of(grey(light)), suits);
  EXPECT_EQ(exposure.chosen(), suits);
}

TEST(SharedExposure, IsNotDeceivedByNoise) {
  // One pixel in four got all the light.
  image::Image smooth(320, 240), noisy(320, 240);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const vec3 light(0.01f * static_cast<float>(1 + x / 8));
      smooth.set_rgb(x, y, light);
      if (x % 2 == 0 && y % 2 == 0) noisy.set_rgb(x, y, 4.0f * light);
    }
  }
  EXPECT_EQ(suitable_exposure(noisy), suitable_exposure(smooth));
  EXPECT_LT(image::automatic_exposure(noisy), suitable_exposure(noisy) - 1);
}

TEST(SharedExposure, IsWhatWasAskedFor) {
  SharedExposure exposure(-3.1f);
  EXPECT_EQ(exposure.of(grey(0)), -3.1f);
  EXPECT_EQ(exposure.of(grey(100)), -3.1f);
  EXPECT_EQ(exposure.chosen(), -3.1f);
}

TEST(DisplayFormat, IsWhatHoldsEightBits) {
  for (const char* shown : {"a.png", "a.jpg", "b/a.JPEG", "a.exr.PNG"})
    EXPECT_TRUE(is_display_format(shown)) << shown;
  for (const char* linear : {"a.exr", "a.hdr", "a.png.exr"})
    EXPECT_FALSE(is_display_format(linear)) << linear;
}

}  // namespace
}  // namespace ssphh::app
