#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/metrics/flip.h>

namespace ssphh::metrics {
namespace {

using image::Image;

// A picture by formula with a tint, blocks and a thin line as errors; `gain` > 0 spreads it over 6 stops.
struct FormulaPictures {
  Image reference{96, 64, 3}, test{96, 64, 3};
  explicit FormulaPictures(double gain) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const double u = (x + 0.5) / 96, v = (y + 0.5) / 64;
        for (int c = 0; c < 3; ++c) {
          const double a = 0.5 + 0.5 * std::sin(12 * u * (c + 1) + 5 * v * v);
          double b = x >= 48 ? a * (0.8 + 0.1 * c) + 0.03 : a;
          if ((x / 4 + y / 4) % 7 == 0) b = b * 0.5 + 0.1 * c;
          if (x == 20 && y > 10 && y < 50) b = 1;
          const double scale = gain > 0 ? gain * std::exp2(6 * v - 4) : 1;
          reference.at(x, y)[c] = static_cast<float>(a * scale),
                          test.at(x, y)[c] = static_cast<float>(b * scale);
        }
      }
    }
  }
};

struct Expected {
  double pixels_per_degree, mean, line, tint, corner, last, block;
};

void expect_near(const FlipError& e, const Expected& x) {
  EXPECT_NEAR(e.mean, x.mean, 1e-5);
  EXPECT_NEAR(e.map.at(20, 30)[0], x.line, 1e-4);
  EXPECT_NEAR(e.map.at(70, 40)[0], x.tint, 1e-4);
  EXPECT_NEAR(e.map.at(0, 0)[0], x.corner, 1e-4);
  EXPECT_NEAR(e.map.at(95, 63)[0], x.last, 1e-4);
  EXPECT_NEAR(e.map.at(5, 20)[0], x.block, 1e-4);
}

// Values that the authors' program (github.com/NVlabs/flip, version 1.6, its CPU code) gave for the same
// pixels.
TEST(Flip, GivesTheAuthorsValues) {
  const FormulaPictures pair(0);
  for (const Expected& x : {Expected{67.0206, 0.2844022, 0.548323, 0.494637, 0.561793, 0.178180, 0.222191},
                            Expected{30, 0.2690208, 0.838978, 0.419519, 0.546503, 0.160221, 0.056582}})
    expect_near(flip(pair.reference, pair.test, {x.pixels_per_degree}), x);
}

TEST(Flip, GivesTheAuthorsValuesForHighDynamicRange) {
  const FormulaPictures pair(3);
  for (const Expected& x : {Expected{67.0206, 0.2595454, 0.421679, 0.413687, 0.515948, 0.218770, 0.128338},
                            Expected{30, 0.2608469, 0.658762, 0.446634, 0.480729, 0.272947, 0.037829}}) {
    const FlipError e = hdr_flip(pair.reference, pair.test, {x.pixels_per_degree});
    EXPECT_NEAR(e.first_exposure, -2.257138, 1e-5);
    EXPECT_NEAR(e.last_exposure, 1.898059, 1e-5);
    EXPECT_EQ(e.exposures, 5);
    expect_near(e, x);
  }
}

TEST(Flip, IsZeroForEqualPicturesAndOneFromGreenToBlue) {
  const FormulaPictures pair(0);
  EXPECT_EQ(flip(pair.reference, pair.reference).mean, 0);
  EXPECT_EQ(hdr_flip(pair.test, pair.test).mean, 0);
  Image green(8, 8, 3), blue(8, 8, 3);
  for (int i = 0; i < 64; ++i) green.set_rgb(i % 8, i / 8, {0, 1, 0}), blue.set_rgb(i % 8, i / 8, {0, 0, 1});
  EXPECT_NEAR(flip(green, blue).mean, 1, 1e-3);
}

TEST(Flip, LeavesNonFinitePixelsOut) {
  FormulaPictures pair(0);
  pair.test = pair.reference;
  pair.test.at(30, 30)[1] = std::numeric_limits<float>::quiet_NaN();
  const FlipError e = flip(pair.reference, pair.test);
  EXPECT_EQ(e.mean, 0);
  EXPECT_TRUE(std::isnan(e.map.at(30, 30)[0]));
  EXPECT_EQ(e.map.at(31, 30)[0], 0);
}

TEST(Flip, AnswersForBlackReferences) {
  Image black(16, 16, 3), dot(16, 16, 3);
  dot.set_rgb(4, 4, {5, 5, 5});
  EXPECT_EQ(hdr_flip(black, black).mean, 0);
  EXPECT_EQ(hdr_flip(black, dot).exposures, 1);
  EXPECT_GT(hdr_flip(black, dot).mean, 0);
  EXPECT_GT(hdr_flip(dot, black).mean, 0);
}

// The square of 1e30 is no float any more; the curve is white long before.
TEST(Flip, WhatIsTooBrightToBeSquaredIsWhite) {
  const FormulaPictures pair(3);
  Image bright = pair.reference, brighter = pair.reference;
  bright.set_rgb(30, 30, vec3(1e15f));
  brighter.set_rgb(30, 30, vec3(1e30f));
  const FlipError a = hdr_flip(pair.reference, bright), b = hdr_flip(pair.reference, brighter);
  EXPECT_GT(a.map.at(30, 30)[0], 0.1f);
  EXPECT_EQ(a.map.pixels, b.map.pixels);
}

TEST(Flip, RejectsDifferentSizes) {
  EXPECT_THROW(flip(Image(4, 4, 3), Image(4, 5, 3)), Error);
  EXPECT_THROW(hdr_flip(Image(), Image()), Error);
}

}  // namespace
}  // namespace ssphh::metrics
