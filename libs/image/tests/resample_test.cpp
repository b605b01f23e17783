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

// Kernels in the units of the coarser image, as their authors wrote them.
double published_kernel(Filter filter, double x) {
  x = std::abs(x);
  if (filter == Filter::bilinear) return x < 1 ? 1 - x : 0;
  const auto sinc = [](double t) { return t == 0 ? 1 : std::sin(pi_d * t) / (pi_d * t); };
  if (filter == Filter::lanczos) return x < 3 ? sinc(x) * sinc(x / 3) : 0;
  // Mitchell and Netravali 1988, eq. 8 with B = C = 1/3.
  const double b = 1.0 / 3, c = b;
  if (x < 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
  if (x < 2)
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b + 24 * c) /
           6;
  return 0;
}

TEST(Resize, SpreadsAPointByThePublishedKernel) {
  Image point(24, 1, 1);
  point.pixels[12] = 1;
  for (const Filter filter : {Filter::bilinear, Filter::mitchell, Filter::lanczos}) {
    for (const int width : {8, 72}) {
      const Image out = resize(point, width, 1, filter);
      const double ratio = 24.0 / width, scale = std::max(1.0, ratio);
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        const double centre = (x + 0.5) * ratio;
        for (int i = -100; i < 124; ++i) sum += published_kernel(filter, (i + 0.5 - centre) / scale);
        EXPECT_NEAR(out.pixels[x], published_kernel(filter, (12.5 - centre) / scale) / sum, 1e-6)
            << x << " of " << width;
      }
    }
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
