// PNG files of every kind of pixel, and what is said of those that are damaged.

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "error_message.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;
using test::png_row;
using test::said_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<float> values_of(const std::vector<std::byte>& file, int channels) {
  const Image image = decode_image(file, "f");
  EXPECT_EQ(image.channels, channels);
  return image.pixels;
}

float linear(int code) {
  return srgb8_to_linear(static_cast<std::uint8_t>(code));
}

TEST(PngKinds, GreyOfFewBitsSpreadsOverTheWholeRange) {
  EXPECT_THAT(values_of(png_row(4, 1, 0, {0b01010000}), 1), ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(values_of(png_row(4, 2, 0, {0b00011011}), 1), ElementsAre(0, linear(85), linear(170), 1));
  EXPECT_THAT(values_of(png_row(2, 4, 0, {0x0e}), 1), ElementsAre(0, linear(14 * 17)));
}

TEST(PngKinds, AlphaIsLinearAndGreyWithAlphaHasFourChannels) {
  EXPECT_THAT(values_of(png_row(1, 8, 4, {100, 51}), 4),
              ElementsAre(linear(100), linear(100), linear(100), 0.2f));
  EXPECT_THAT(values_of(png_row(1, 8, 6, {1, 2, 3, 102}), 4),
              ElementsAre(linear(1), linear(2), linear(3), 0.4f));
  EXPECT_THAT(values_of(png_row(1, 16, 2, {0x80, 0, 0, 1, 0xff, 0xff}), 3),
              ElementsAre(srgb_to_linear(32768.0f / 65535), srgb_to_linear(1.0f / 65535), 1));
}

TEST(PngKinds, PalettesAndTransparentColoursAreResolved) {
  const test::PngChunk palette = {"PLTE", {10, 20, 30, 40, 50, 60}};
  EXPECT_THAT(values_of(png_row(2, 1, 3, {0b01000000}, {palette}), 3),
              ElementsAre(linear(10), linear(20), linear(30), linear(40), linear(50), linear(60)));
  EXPECT_THAT(values_of(png_row(2, 1, 3, {0b01000000}, {palette, {"tRNS", {51}}}), 4),
              ElementsAre(linear(10), linear(20), linear(30), 0.2f, linear(40), linear(50), linear(60), 1));
  EXPECT_THAT(values_of(png_row(2, 8, 0, {7, 8}, {{"tRNS", {0, 8}}}), 4),
              ElementsAre(linear(7), linear(7), linear(7), 1, linear(8), linear(8), linear(8), 0));
}

TEST(PngKinds, CodesOfTexturesAreThoseOfTheFile) {
  const Rgba8 deep = decode_rgba8(png_row(1, 16, 2, {0x12, 0x80, 0x34, 0xff, 0x56, 0}), "f");
  EXPECT_THAT(deep.rgba, ElementsAre(0x12, 0x34, 0x56, 255)) << "the low byte is lost";
  EXPECT_THAT(decode_rgba8(png_row(2, 8, 0, {7, 8}), "f").rgba, ElementsAre(7, 7, 7, 255, 8, 8, 8, 255));
}

// A note, colour management and the like change no code.
TEST(PngKinds, OtherChunksAreNotLookedAt) {
  const std::vector<float> plain = values_of(png_row(1, 8, 0, {9}), 1);
  EXPECT_EQ(values_of(png_row(1, 8, 0, {9}, {{"gAMA", {0, 1, 0x86, 0xa0}}, {"tEXt", {'a', 0, 'b'}}}), 1),
            plain);
  std::vector<std::byte> damaged = png_row(1, 8, 0, {9}, {{"tEXt", {'a', 0, 'b'}}});
  damaged[33 + 8] ^= std::byte{1};
  EXPECT_EQ(values_of(damaged, 1), plain) << "what is not critical";
}

TEST(PngDamage, IsNamed) {
  const std::vector<std::byte> good = png_row(2, 8, 0, {7, 8});
  const auto with = [&](std::size_t at, int value) {
    std::vector<std::byte> file = good;
    file[at] = static_cast<std::byte>(value);
    return said_of(file);
  };
  EXPECT_EQ(said_of(good), "no error");
  EXPECT_THAT(with(29, 0), HasSubstr("f: broken PNG: invalid chunk checksum"));
  EXPECT_THAT(with(46, 0x55), HasSubstr("f: broken PNG: "));
  EXPECT_EQ(said_of({good.begin(), good.end() - 1}), "f: broken PNG: end of stream");
  EXPECT_THAT(said_of(png_row(0, 8, 0, {})), HasSubstr("f: broken PNG: "));
  EXPECT_THAT(said_of(png_row(1, 3, 0, {7})), HasSubstr("f: broken PNG: "));
  EXPECT_THAT(said_of(png_row(2, 8, 0, {7})), HasSubstr("f: broken PNG: ")) << "a row too short";
}

TEST(PngDamage, SizesAreCheckedBeforeMemoryIsTaken) {
  const DecodeLimits limits{100, 150};
  const auto said = [&](int width) {
    return message_of([&] {
      decode_image(png_row(width, 8, 0, std::vector<std::uint8_t>(static_cast<std::size_t>(width))), "f",
                   limits);
    });
  };
  EXPECT_EQ(said(100), "no error");
  EXPECT_EQ(said(101), "f: is 101 x 1 pixels, the limit is 100 per side");
}

TEST(PngOutput, HasAsManyChannelsAsTheImage) {
  for (const int channels : {1, 3, 4}) {
    Image image(2, 1, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.1f * static_cast<float>(i);
    EXPECT_EQ(decode_image(encode_png(image), "f").channels, channels);
  }
}

}  // namespace
}  // namespace ssphh::image
