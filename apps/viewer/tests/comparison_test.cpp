#include "model/comparison.h"

#include <gtest/gtest.h>

#include <ssphh/metrics/heat_map.h>

namespace ssphh::viewer {
namespace {

using image::Image;
using metrics::ColorRamp;

/// 6 × 4 pixels whose errors have both signs and differ by place and channel.
struct Pictures {
  Pictures() {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 6; ++x) {
        const auto i = static_cast<float>(6 * y + x);
        truth.set_rgb(x, y, {0.5f + 0.01f * i, 1, 2});
        realtime.set_rgb(x, y, {0.5f + 0.03f * i, 1 - 0.02f * i, 1.5f});
      }
    }
  }
  Image truth{6, 4}, realtime{6, 4};
};

void expect_picture(const Difference& got, const Image& map, ColorRamp ramp) {
  EXPECT_EQ(got.scale, metrics::automatic_scale(map));
  EXPECT_EQ(got.picture.rgba, metrics::heat_map(map, ramp, got.scale).rgba);
  EXPECT_EQ(got.picture.width, 6);
  EXPECT_EQ(got.picture.height, 4);
}

TEST(Comparison, ShowsTheMapThatWasAskedForInItsColours) {
  const Pictures p;
  expect_picture(difference(p.truth, p.realtime, Show::absolute, 2),
                 metrics::absolute_error_map(p.truth, p.realtime), ColorRamp::inferno);
  expect_picture(difference(p.truth, p.realtime, Show::signed_, 2),
                 metrics::signed_error_map(p.truth, p.realtime), ColorRamp::diverging);
  for (const int block : {2, 4}) {
    const Image blocks = metrics::pixelated_error_map(p.truth, p.realtime, block);
    expect_picture(difference(p.truth, p.realtime, Show::pixelated, block),
                   metrics::enlarge_blocks(blocks, block, 6, 4), ColorRamp::inferno);
  }
}

TEST(Comparison, TellsTheErrorOfTheRealTimePicture) {
  const Pictures p;
  const metrics::ImageError wanted = metrics::compare(p.truth, p.realtime);
  for (const Show show : {Show::absolute, Show::signed_, Show::pixelated}) {
    const metrics::ImageError error = difference(p.truth, p.realtime, show, 2).error;
    EXPECT_EQ(error.bias, wanted.bias);
    EXPECT_EQ(error.relmse, wanted.relmse) << "relative to the truth";
  }
  EXPECT_EQ(leak_picture(p.truth, p.realtime).error.relmse, wanted.relmse);
}

/// Mean luminance 1: a thousandth of it is the bound.
TEST(Comparison, LeaksAreWhereTheTruthIsUnderAThousandthOfItsMean) {
  Image truth(6, 4), realtime(6, 4);
  for (int i = 0; i < 24; ++i) {
    truth.set_rgb(i % 6, i / 6, vec3(0));
    realtime.set_rgb(i % 6, i / 6, vec3(0.1f, 0.2f, 0.3f) * static_cast<float>(i + 1));
  }
  truth.set_rgb(0, 0, vec3(23.99801f));
  truth.set_rgb(3, 1, vec3(0.00099f)), truth.set_rgb(4, 2, vec3(0.001f * 1.02f));
  Image leak = realtime;
  leak.set_rgb(0, 0, vec3(0)), leak.set_rgb(4, 2, vec3(0));
  expect_picture(leak_picture(truth, realtime), leak, ColorRamp::inferno);
}

TEST(Comparison, OfPicturesOfTwoSizesIsAnError) {
  EXPECT_THROW(difference(Image(6, 4), Image(4, 6), Show::absolute, 2), Error);
}

}  // namespace
}  // namespace ssphh::viewer
