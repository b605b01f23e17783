#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/image/resample.h>

#include "test_images.h"

namespace ssphh::image {
namespace {

constexpr std::array filters{Filter::box, Filter::bilinear, Filter::mitchell, Filter::lanczos};

double mean(const Image& image) {
  double sum = 0;
  for (const float x : image.pixels) sum += double{x};
  return sum / static_cast<double>(image.pixels.size());
}

TEST(Resize, KeepsConstants) {
  Image image(13, 7);
  for (float& x : image.pixels) x = 0.3f;
  for (const Filter filter : filters) {
    for (const auto& [w, h] : {std::pair{5, 3}, {26, 14}, {1, 1}, {13, 7}, {40, 2}}) {
      const Image out = resize(image, w, h, filter);
      ASSERT_EQ(out.width, w);
      ASSERT_EQ(out.height, h);
      for (const float x : out.pixels) EXPECT_NEAR(x, 0.3f, 1e-6f);  // float weights that sum to 1
    }
  }
}

TEST(Resize, BoxKeepsTheMeanForAnyRatio) {
  const Image image = test::noise_image(37, 29, 3, 1);
  for (const auto& [w, h] : {std::pair{5, 3}, {36, 28}, {1, 1}, {100, 60}, {11, 29}}) {
    EXPECT_NEAR(mean(resize(image, w, h)), mean(image), 1e-6)
        << w << " x " << h;  // rounding of float weights
  }
}

TEST(Resize, BoxOfAWholeRatioIsTheMeanOfTheBlock) {
  const Image image = test::noise_image(8, 4, 1, 1);
  const Image out = resize(image, 2, 2);
  float sum = 0;
  for (int y = 2; y < 4; ++y) {
    for (int x = 4; x < 8; ++x) sum += image.rgb(x, y).x;
  }
  EXPECT_NEAR(out.rgb(1, 1).x, sum / 8, 1e-6f);
}

TEST(Resize, TheSameSizeIsTheSameImageForInterpolatingFilters) {
  const Image image = test::noise_image(9, 6, 4, 1);
  for (const Filter filter : {Filter::box, Filter::bilinear, Filter::lanczos}) {
    const Image out = resize(image, 9, 6, filter);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_NEAR(out.pixels[i], image.pixels[i], 1e-6f);
  }
}

TEST(Resize, SmoothFiltersReproduceARamp) {
  Image ramp(64, 4, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 64; ++x) ramp.at(x, y)[0] = (static_cast<float>(x) + 0.5f) / 64;
  }
  for (const Filter filter : {Filter::bilinear, Filter::mitchell, Filter::lanczos}) {
    for (const int width : {16, 128}) {
      const Image out = resize(ramp, width, 4, filter);
      // Triangle and Mitchell reproduce slopes; normalised Lanczos is off by 0.0198 pixels at a quarter
      // pixel.
      const float tolerance = filter == Filter::lanczos ? 0.0199f / 64 : 1e-6f;
      for (int x = width / 4; x < 3 * width / 4; ++x) {  // away from the repeated edges
        EXPECT_NEAR(out.rgb(x, 1).x, (static_cast<float>(x) + 0.5f) / static_cast<float>(width), tolerance)
            << x;
      }
    }
  }
}

TEST(Resize, ShrinkingRemovesWhatTheNewPixelsCannotShow) {
  // Stripes of period 2 are above the new sampling rate for a factor of 4: only their mean may stay.
  Image stripes(64, 64, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) stripes.at(x, y)[0] = static_cast<float>(x % 2);
  }
  for (const Filter filter : filters) {
    const Image out = resize(stripes, 16, 16, filter);
    for (int x = 4; x < 12; ++x) EXPECT_NEAR(out.rgb(x, 8).x, 0.5f, 0.01f);
  }
}

TEST(Resize, RefusesImpossibleSizes) {
  EXPECT_THROW(resize(Image(), 1, 1), Error);
  EXPECT_THROW(resize(Image(1, 1), 0, 1), Error);
}

TEST(SampleBilinear, InterpolatesBetweenCentresAndHoldsTheEdge) {
  Image image(2, 1, 1);
  image.pixels = {1, 3};
  EXPECT_EQ(sample_bilinear(image, 0.5f, 0.5f).x, 1);
  EXPECT_EQ(sample_bilinear(image, 1.0f, 0.5f).x, 2);
  EXPECT_EQ(sample_bilinear(image, -5, 9).x, 1);
  EXPECT_EQ(sample_bilinear(image, 7, 0).x, 3);
}

}  // namespace
}  // namespace ssphh::image
