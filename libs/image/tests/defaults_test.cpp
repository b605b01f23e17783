/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/image/cube_map.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>

namespace ssphh::image {
namespace {

TEST(Defaults, OfPictures) {
  const Image image;
  EXPECT_EQ(image.width, 0);
  EXPECT_EQ(image.height, 0);
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(CubeMap().size, 0);
  EXPECT_EQ(Rgba8().width, 0);
  EXPECT_EQ(Rgba8().height, 0);
  const ToneMap tone;
  EXPECT_EQ(tone.exposure, 0);
  EXPECT_EQ(tone.curve, ToneCurve::clip);
  EXPECT_EQ(tone.gamma, 0);
  const DecodeLimits limits;
  EXPECT_EQ(limits.side, 65536);
  EXPECT_EQ(limits.pixels, 268435456u);
}

}  // namespace
}  // namespace ssphh::image
