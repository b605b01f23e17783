#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/image/transfer.h>
#include <ssphh/metrics/perceptual.h>

#include "noise.h"

namespace ssphh::metrics {
namespace {

using image::Image;

Image flat(int width, int height, float encoded) {
  Image image(width, height, 3);
  for (float& x : image.pixels) x = image::srgb_to_linear(encoded);
  return image;
}

double luma(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return 0.2126 * double{image::linear_to_srgb(p[0])} + 0.7152 * double{image::linear_to_srgb(p[1])} +
         0.0722 * double{image::linear_to_srgb(p[2])};
}

// SSIM as the paper writes it: every window by itself, central moments.
double ssim_by_definition(const Image& a, const Image& b) {
  double total = 0;
  int windows = 0;
  for (int y0 = 0; y0 + 11 <= a.height; ++y0) {
    for (int x0 = 0; x0 + 11 <= a.width; ++x0) {
      double weight = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
      for (int pass = 0; pass < 2; ++pass) {
        for (int j = 0; j < 11; ++j) {
          for (int i = 0; i < 11; ++i) {
            const double w = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
            const double la = luma(a, x0 + i, y0 + j), lb = luma(b, x0 + i, y0 + j);
            if (pass == 0) {
              weight += w, ma += w * la, mb += w * lb;
            } else {
              va += w * (la - ma) * (la - ma), vb += w * (lb - mb) * (lb - mb),
                  cov += w * (la - ma) * (lb - mb);
            }
          }
        }
        if (pass == 0) ma /= weight, mb /= weight;
      }
      va /= weight, vb /= weight, cov /= weight;
      total += (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
      ++windows;
    }
  }
  return total / windows;
}

TEST(DisplayError, SsimEqualsItsDefinition) {
  const Image a = noise(23, 17, 3, 1);
  Image b = noise(23, 17, 3, 2);
  for (std::size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] = 0.7f * a.pixels[i] + 0.3f * b.pixels[i];
  const double expected = ssim_by_definition(a, b);
  EXPECT_GT(expected, 0.2);
  EXPECT_LT(expected, 0.98);
  EXPECT_NEAR(display_error(a, b).ssim, expected, 1e-6);
}

TEST(DisplayError, FlatPicturesHaveTheirClosedForm) {
  const DisplayError e = display_error(flat(20, 20, 0.5f), flat(20, 20, 0.6f));
  EXPECT_NEAR(e.psnr, 20, 1e-4);  // a difference of 0.1 everywhere
  EXPECT_NEAR(e.ssim, (2 * 0.5 * 0.6 + 1e-4) / (0.25 + 0.36 + 1e-4), 1e-5);
}

TEST(DisplayError, EqualPicturesAndSmallOnes) {
  const Image a = noise(5, 3, 3, 3);
  const DisplayError e = display_error(a, a);
  EXPECT_TRUE(std::isinf(e.psnr));
  EXPECT_NEAR(e.ssim, 1, 1e-12);
}

TEST(DisplayError, LeavesNonFinitePixelsOut) {
  const Image a = noise(40, 40, 3, 4);
  Image b = a;
  b.at(3, 3)[0] = std::numeric_limits<float>::infinity();
  const DisplayError e = display_error(a, b);
  EXPECT_TRUE(std::isinf(e.psnr));
  EXPECT_NEAR(e.ssim, 1, 1e-12);
  EXPECT_THROW(display_error(a, Image(1, 1, 3)), Error);
}

}  // namespace
}  // namespace ssphh::metrics
