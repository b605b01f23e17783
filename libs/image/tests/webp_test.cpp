// WebP files that libwebp wrote: the codes of lossless ones, sizes, damage.

#include <gmock/gmock.h>
#include <webp/encode.h>

#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "error_message.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;
using Codes = std::vector<std::uint8_t>;

Bytes taken(std::uint8_t* data, std::size_t size) {
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  Bytes file(begin, begin + size);
  WebPFree(data);
  return file;
}

Bytes lossless(const Codes& codes, int width, int channels) {
  const int height = static_cast<int>(codes.size()) / (width * channels);
  std::uint8_t* out = nullptr;
  const auto encode = channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const std::size_t size = encode(codes.data(), width, height, width * channels, &out);
  return taken(out, size);
}

Bytes lossy(const Codes& codes, int width) {
  const int height = static_cast<int>(codes.size()) / (width * 3);
  std::uint8_t* out = nullptr;
  const std::size_t size = WebPEncodeRGB(codes.data(), width, height, width * 3, 90, &out);
  return taken(out, size);
}

/// Codes in 1..255: the encoder may change colours that alpha hides.
Codes noise(std::size_t count) {
  Codes codes(count);
  Pcg32 random(5);
  for (auto& code : codes) code = static_cast<std::uint8_t>(1 + random.next() % 255);
  return codes;
}

std::string said_of_webp(const Bytes& file) {
  return message_of([&] { decode_rgba8(file, "f"); });
}

TEST(WebP, LosslessFilesGiveTheirCodes) {
  const Codes codes = noise(std::size_t{7} * 5 * 4);
  const Rgba8 image = decode_rgba8(lossless(codes, 7, 4), "f");
  EXPECT_EQ(image.width, 7);
  EXPECT_EQ(image.height, 5);
  EXPECT_EQ(image.rgba, codes);
  const Codes colors = noise(std::size_t{3} * 2 * 3);
  const Rgba8 opaque = decode_rgba8(lossless(colors, 3, 3), "f");
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_EQ(opaque.rgba[i], i % 4 == 3 ? 255 : colors[i / 4 * 3 + i % 4]);
}

TEST(WebP, ImagesAreLinearAndHaveAlphaWhereTheFileHas) {
  const Codes codes = {100, 50, 200, 51};
  const Image image = decode_image(lossless(codes, 1, 4), "f");
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.pixels, (std::vector<float>{srgb8_to_linear(100), srgb8_to_linear(50), srgb8_to_linear(200),
                                              51 / 255.0f}));
  const Image opaque = decode_image(lossless({100, 50, 200}, 1, 3), "f");
  EXPECT_EQ(opaque.channels, 3);
  EXPECT_EQ(opaque.pixels,
            (std::vector<float>{srgb8_to_linear(100), srgb8_to_linear(50), srgb8_to_linear(200)}));
}

TEST(WebP, LossyFilesComeNear) {
  Codes grey(std::size_t{16} * 16 * 3, 128);
  const Rgba8 image = decode_rgba8(lossy(grey, 16), "f");
  for (std::size_t i = 0; i < image.rgba.size(); ++i) EXPECT_NEAR(image.rgba[i], i % 4 == 3 ? 255 : 128, 2);
}

TEST(WebP, TruncatedFilesAreRefused) {
  for (const Bytes& good : {lossless(noise(600), 10, 4), lossy(noise(768), 16)}) {
    EXPECT_EQ(said_of_webp(good), "no error");
    for (std::size_t size = 12; size + 1 < good.size(); ++size) {
      const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_THAT(said_of_webp(cut), HasSubstr("f: broken WebP: ")) << size << " of " << good.size();
    }
  }
}

TEST(WebP, FlippedBitsNeverCrash) {
  Pcg32 random(3);
  for (const Bytes& good : {lossless(noise(600), 10, 4), lossy(noise(768), 16)}) {
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
      Bytes damaged = good;
      damaged[random.next() % damaged.size()] ^= static_cast<std::byte>(1u << (random.next() % 8));
      refused += said_of_webp(damaged) == "no error" ? 0 : 1;
    }
    EXPECT_GT(refused, 10);
  }
}

TEST(WebP, SizesAreCheckedBeforeMemoryIsTaken) {
  const Bytes good = lossless(noise(std::size_t{16} * 16 * 4), 16, 4);
  EXPECT_EQ(message_of([&] {
              decode_rgba8(good, "f", {15, 1000});
            }),
            "f: is 16 x 16 pixels, the limit is 15 per side");
}

// "VP8X" with the bit of animations, a canvas of 1 × 1.
TEST(WebP, AnimationsAreRefused) {
  const std::string riff("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\0\0\0\0\0\0", 30);
  const auto bytes = std::as_bytes(std::span(riff));
  EXPECT_EQ(said_of_webp({bytes.begin(), bytes.end()}), "f: is an animated WebP (one picture is needed)");
}

}  // namespace
}  // namespace ssphh::image
