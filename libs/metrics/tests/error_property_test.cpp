/// What every measure of a difference obeys: nothing between equals, something between others, the same for
/// mirrored pictures, more where there is more noise.

#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/perceptual.h>

#include "noise.h"
#include "property.h"

namespace ssphh::metrics {
namespace {

using namespace ssphh::test;
using image::Image;

enum class Mirror { columns, rows, both };
Generator<Mirror> mirrors() {
  return one_of<Mirror>({Mirror::columns, Mirror::rows, Mirror::both});
}

Image mirrored(const Image& image, Mirror mirror) {
  Image result = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      result.set_rgb(mirror == Mirror::rows ? x : image.width - 1 - x,
                     mirror == Mirror::columns ? y : image.height - 1 - y, image.rgb(x, y));
  }
  return result;
}

/// a + amount · (b − a), clamped to nothing.
Image towards(const Image& a, const Image& b, float amount) {
  Image result = a;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) result.pixels[i] += amount * (b.pixels[i] - a.pixels[i]);
  return result;
}

/// Everything that tells a difference, none of it negative.
std::vector<double> differences(const Image& reference, const Image& test) {
  const ImageError e = compare(reference, test);
  const DisplayError shown = display_error(reference, test);
  return {e.sum,
          e.mae,
          e.max,
          e.mse,
          e.rmse,
          e.relmse,
          e.mape,
          e.smape,
          std::pow(10, -shown.psnr / 10),
          1 - shown.ssim,
          flip(reference, test).mean};
}

double largest_relative(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i]) / std::max(1e-9, std::abs(b[i])));
  return worst;
}

TEST(ErrorProperty, IsNothingBetweenEqualsAndSomethingAfterOneChange) {
  EXPECT_TRUE(for_all(integers(1, 24), integers(1, 24), seeds(), seeds(), floats(0.02f, 0.5f))
                  .cases(40)
                  .holds([](int width, int height, std::uint64_t seed, std::uint64_t place, float change) {
                    const Image image = noise(width, height, 3, seed);
                    for (const double none : differences(image, image)) {
                      if (!(std::abs(none) <= 1e-12)) return at_most(none, 0) << " between equals";
                    }
                    Image other = image;
                    float& value = other.pixels[place % other.pixels.size()];
                    value += value > 0.5f ? -change : change;
                    for (const double some : differences(image, other)) {
                      if (!(some > 0)) return at_most(1, some) << " after a change";
                    }
                    return testing::AssertionSuccess();
                  }));
}

TEST(ErrorProperty, SymmetricMeasuresDoNotCareWhichPictureIsTheReference) {
  EXPECT_TRUE(for_all(integers(1, 24), integers(1, 24), seeds(), seeds())
                  .cases(40)
                  .holds([](int width, int height, std::uint64_t first, std::uint64_t second) {
                    const Image a = noise(width, height, 3, first), b = noise(width, height, 3, second);
                    const ImageError there = compare(a, b), back = compare(b, a);
                    const DisplayError shown = display_error(a, b), swapped = display_error(b, a);
                    const std::vector<double> x{there.sum,  there.mae,   there.max,  there.mse, there.rmse,
                                                there.bias, there.smape, shown.psnr, shown.ssim},
                        y{back.sum,   back.mae,   back.max,     back.mse,    back.rmse,
                          -back.bias, back.smape, swapped.psnr, swapped.ssim};
                    return at_most(largest_relative(x, y), 1e-12);  // sums in double
                  }));
}

TEST(ErrorProperty, MirroredPicturesDifferAsMuch) {
  EXPECT_TRUE(for_all(integers(1, 24), integers(1, 24), seeds(), seeds(), mirrors())
                  .cases(40)
                  .holds([](int width, int height, std::uint64_t first, std::uint64_t second, Mirror mirror) {
                    const Image a = noise(width, height, 3, first), b = noise(width, height, 3, second);
                    // The order of sums, some of them in float.
                    return at_most(largest_relative(differences(mirrored(a, mirror), mirrored(b, mirror)),
                                                    differences(a, b)),
                                   1e-5);
                  }));
}

TEST(ErrorProperty, GrowsWithTheDifference) {
  EXPECT_TRUE(for_all(integers(1, 20), seeds(), seeds(), floats(0.05f, 0.7f), floats(1.1f, 1.4f))
                  .cases(40)
                  .holds([](int size, std::uint64_t first, std::uint64_t second, float little, float factor) {
                    const Image a = noise(size, size, 3, first), b = noise(size, size, 3, second);
                    const std::vector<double> less = differences(a, towards(a, b, little)),
                                              more = differences(a, towards(a, b, little * factor));
                    for (std::size_t i = 0; i < less.size(); ++i) {
                      if (!(more[i] > less[i])) return at_most(less[i], more[i]) << ", measure " << i;
                    }
                    return testing::AssertionSuccess();
                  }));
}

TEST(ErrorProperty, ScalesWithTheDifferenceAsItsDefinitionSays) {
  EXPECT_TRUE(for_all(integers(1, 24), seeds(), seeds(), integers(-12, 12))
                  .cases(40)
                  .holds([](int size, std::uint64_t first, std::uint64_t second, int exponent) {
                    const Image a = noise(size, size, 3, first), b = noise(size, size, 3, second);
                    // Both pictures times a power of two, which no rounding sees.
                    Image c = a, d = b;
                    const double k = std::ldexp(1.0, exponent);
                    for (float& x : c.pixels) x *= static_cast<float>(k);
                    for (float& x : d.pixels) x *= static_cast<float>(k);
                    const ImageError e = compare(a, b), f = compare(c, d);
                    return f.sum == k * e.sum && f.mae == k * e.mae && f.max == k * e.max &&
                           f.bias == k * e.bias && f.mse == k * k * e.mse && f.rmse == k * e.rmse &&
                           f.mean_ratio == e.mean_ratio;
                  }));
}

TEST(ErrorMapProperty, MapsAddUpToTheNumbers) {
  EXPECT_TRUE(for_all(integers(1, 24), integers(1, 24), seeds(), seeds(), integers(1, 30))
                  .cases(40)
                  .holds([](int width, int height, std::uint64_t first, std::uint64_t second, int block) {
                    const Image a = noise(width, height, 3, first), b = noise(width, height, 3, second);
                    const ImageError e = compare(a, b);
                    const auto sum = [](const Image& map) {
                      double all = 0;
                      for (const float x : map.pixels) all += static_cast<double>(x);
                      return all;
                    };
                    const double values = 3.0 * width * height;
                    const std::vector<double> maps{sum(absolute_error_map(a, b)),
                                                   sum(pixelated_error_map(a, b, block)),
                                                   sum(relative_squared_error_map(a, b))};
                    // Single values rounded to float.
                    if (const auto close =
                            at_most(largest_relative(maps, {e.sum, e.sum, e.relmse * values}), 1e-6);
                        !close)
                      return close;
                    return at_most(std::abs(sum(signed_error_map(a, b)) - e.bias * values), 1e-7 * values);
                  }));
}

}  // namespace
}  // namespace ssphh::metrics
