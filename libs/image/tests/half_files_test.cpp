// Pictures of half floats: OpenEXR as its own reader has it back, KTX 2.0 byte by byte.

#include <cmath>
#include <span>

#include <gmock/gmock.h>

#include <ssphh/core/bytes.h>
#include <ssphh/image/half.h>
#include <ssphh/image/io.h>
#include <ssphh/image/ktx2.h>

#include "error_message.h"

namespace ssphh::image {
namespace {

using test::message_of;
using testing::HasSubstr;

Image ramp(int width, int height, int channels) {
  Image picture(width, height, channels);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = std::exp2(0.3f * static_cast<float>(i) - 9);
  return picture;
}

/// By the format's definition.
float value_of(std::uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const float size = exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                                   : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
  return half & 0x8000 ? -size : size;
}

TEST(HalfExr, ValuesComeBackToElevenBits) {
  for (const int channels : {1, 3, 4}) {
    const Image picture = ramp(5, 4, channels), back = decode_image(encode_half_exr(picture), "memory");
    ASSERT_EQ(back.width, 5);
    ASSERT_EQ(back.height, 4);
    ASSERT_EQ(back.channels, channels);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      EXPECT_NEAR(back.pixels[i], picture.pixels[i], picture.pixels[i] / 2048);
  }
}

TEST(HalfExr, RefusesWhatHasNoHalf) {
  Image picture(1, 1);
  picture.pixels[1] = 65505;
  EXPECT_THAT(message_of([&] { encode_half_exr(picture); }),
              HasSubstr("65505 is more than a half float holds"));
  picture.pixels[1] = std::nanf("");
  EXPECT_THAT(message_of([&] { encode_half_exr(picture); }), HasSubstr("nan is more"));
  EXPECT_EQ(message_of([] { encode_half_exr(Image()); }), "OpenEXR: the image is empty");
  picture.pixels[1] = -65504;
  EXPECT_EQ(value_of(to_half(picture.pixels[1], "x")), -65504);
}

TEST(Ktx2, IsATextureOfHalves) {
  const Image picture = ramp(3, 2, 3);
  const std::vector<std::byte> file = encode_ktx2(picture);
  ByteReader reader(file, "ktx2");
  reader.view("identifier", 12);
  const auto next = [&] { return reader.value<std::uint32_t>("header"); };
  // Format (VK_FORMAT_R16G16B16A16_SFLOAT), bytes of a channel; width, height, depth; layers, faces, levels,
  // packing.
  for (const std::uint32_t value : {97u, 2u, 3u, 2u, 0u, 0u, 1u, 1u, 0u}) EXPECT_EQ(next(), value);
  const std::uint32_t descriptor = next(), descriptor_size = next();
  reader.view("key values and supercompression", 24);
  const auto at = reader.value<std::uint64_t>("level"), size = reader.value<std::uint64_t>("level");
  EXPECT_EQ(reader.value<std::uint64_t>("level"), size);
  EXPECT_EQ(size, 3u * 2 * 4 * 2);
  EXPECT_EQ(at + size, file.size());
  EXPECT_GE(at, std::uint64_t{descriptor} + descriptor_size);
  ByteReader texels(std::span<const std::byte>(file).subspan(at), "texels");
  for (int i = 0; i < 6; ++i) {
    for (int c = 0; c < 3; ++c) {
      const float truth = picture.pixels[3 * i + c];
      EXPECT_NEAR(value_of(texels.value<std::uint16_t>("texel")), truth, truth / 2048);
    }
    EXPECT_EQ(value_of(texels.value<std::uint16_t>("alpha")), 1);
  }
  EXPECT_EQ(message_of([] { encode_ktx2(Image()); }), "KTX2: the image is empty");
}

}  // namespace
}  // namespace ssphh::image
