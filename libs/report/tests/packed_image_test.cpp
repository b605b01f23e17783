#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <zlib.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/report/packed_image.h>

#include "error_message.h"

namespace ssphh::report {
namespace {

// Value of a half by its definition: IEEE 754-2008, 3.4.
double half_value(std::uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  const double magnitude =
      exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return h & 0x8000 ? -magnitude : magnitude;
}

TEST(Half, EveryHalfSurvives) {
  for (int h = 0; h < 65536; ++h) {
    if ((h >> 10 & 31) == 31) continue;  // infinite and NaN
    ASSERT_EQ(to_half(static_cast<float>(half_value(static_cast<std::uint16_t>(h)))), h);
  }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  for (int h = 0; h < 0x7bff; ++h) {
    const double low = half_value(static_cast<std::uint16_t>(h)),
                 high = half_value(static_cast<std::uint16_t>(h + 1));
    const float middle = static_cast<float>(0.5 * (low + high));  // exact: one bit more than a half
    ASSERT_EQ(to_half(middle), h % 2 == 0 ? h : h + 1);
    ASSERT_EQ(to_half(std::nextafter(middle, 0.0f)), h);
    ASSERT_EQ(to_half(std::nextafter(middle, 1e9f)), h + 1);
  }
}

TEST(Half, OutsideIsTheLargestAndNanStays) {
  EXPECT_EQ(to_half(1e9f), 0x7bff);
  EXPECT_EQ(to_half(-std::numeric_limits<float>::infinity()), 0xfbff);
  EXPECT_GT(to_half(std::numeric_limits<float>::quiet_NaN()) & 0x7fff, 0x7c00);
}

TEST(PackedImage, UnpacksBitForBit) {
  for (const int channels : {1, 3}) {
    image::Image image(37, 11, channels);
    std::uint32_t state = 12345;
    for (float& x : image.pixels) {
      state = state * 1664525u + 1013904223u;
      x = std::ldexp(static_cast<float>(state >> 8) - 8e6f, static_cast<int>(state % 40) - 40);
    }
    image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    const std::vector<std::uint16_t> values = unpack(pack_half(image));
    ASSERT_EQ(values.size(), image.pixels.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], to_half(image.pixels[i])) << i;
  }
}

TEST(PackedImage, BytesAndAlpha) {
  image::Image map(3, 1, 1);
  map.pixels = {0.0f, 0.5f, 2.0f};
  EXPECT_THAT(unpack(pack_bytes(map)), testing::ElementsAre(0, 128, 255));
  image::Image rgba(1, 1, 4);
  rgba.pixels = {1, 2, 3, 4};
  EXPECT_EQ(unpack(pack_half(rgba)).size(), 3u);
}

TEST(PackedImage, TellsWhatItHolds) {
  image::Image rgba(4, 3, 4), grey(5, 2, 1);
  const PackedImage colour = pack_half(rgba), plain = pack_half(grey), bytes = pack_bytes(rgba);
  EXPECT_EQ(colour.width, 4);
  EXPECT_EQ(colour.height, 3);
  EXPECT_EQ(colour.channels, 3);
  EXPECT_EQ(colour.kind, "half");
  EXPECT_EQ(plain.channels, 1);
  EXPECT_EQ(bytes.channels, 1);
  EXPECT_EQ(bytes.kind, "byte");
}

TEST(PackedImage, BytesAreRoundedAndWhatIsNoNumberIsBlack) {
  image::Image map(5, 1, 1);
  map.pixels = {0.0019f, 0.0020f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 0.999f};
  EXPECT_THAT(unpack(pack_bytes(map)), testing::ElementsAre(0, 1, 0, 0, 255));
}

// As unpack.js reads it: channels less the second one, less the left neighbour, low bytes before high ones.
TEST(PackedImage, IsStoredAsItsDescriptionSays) {
  const std::vector<std::uint16_t> halves = {0x3c00, 0x4000, 0x4200,  // 1 2 3
                                             0x4400, 0x4500, 0x4600,  // 4 5 6
                                             0x4700, 0x4800, 0x4880,  // 7 8 9
                                             0x4900, 0x4980, 0x4a00};
  image::Image picture(2, 2);
  for (std::size_t i = 0; i < 12; ++i) picture.pixels[i] = static_cast<float>(i + 1);
  std::vector<std::uint16_t> wanted(12);
  const auto channel = [&](std::size_t pixel, std::size_t c) {
    const int own = halves[3 * pixel + c];
    return c == 1 ? own : own - halves[3 * pixel + 1];
  };
  for (std::size_t pixel = 0; pixel < 4; ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      const int before = pixel == 0 ? 0 : channel(pixel == 2 ? 0 : pixel - 1, c);
      wanted[4 * c + pixel] = static_cast<std::uint16_t>(channel(pixel, c) - before);
    }
  const PackedImage packed = pack_half(picture);
  std::vector<std::uint8_t> planes(24);
  uLongf size = planes.size();
  ASSERT_EQ(::uncompress(planes.data(), &size, packed.bytes.data(), packed.bytes.size()), Z_OK);
  ASSERT_EQ(size, 24u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(planes[i] | planes[12 + i] << 8, wanted[i]) << i;
}

TEST(PackedImage, SizesThatMakeNoSenseAreRefused) {
  for (const auto& [width, height, channels] : std::vector<std::array<int, 3>>{
           {0, 1, 1}, {1, 0, 1}, {65537, 1, 1}, {1, 65537, 1}, {1, 1, 2}, {-1, -1, 3}}) {
    PackedImage packed = pack_half(image::Image(1, 1));
    packed.width = width, packed.height = height, packed.channels = channels;
    EXPECT_EQ(test::message_of([&] { unpack(packed); }), "packed image: its size makes no sense");
  }
  EXPECT_EQ(unpack(pack_half(image::Image(65536, 1, 1))).size(), 65536u);
  EXPECT_EQ(unpack(pack_half(image::Image(1, 65536, 1))).size(), 65536u);
}

TEST(PackedImage, ABrokenStreamIsAnError) {
  image::Image image(8, 8);
  PackedImage packed = pack_half(image);
  packed.bytes.resize(packed.bytes.size() / 2);
  EXPECT_THROW(unpack(packed), Error);
  packed.width = 1000;
  EXPECT_THROW(unpack(packed), Error);
}

TEST(Base32768, FifteenBitsALetter) {
  EXPECT_EQ(base32768({}), u"");
  EXPECT_EQ(base32768({0x80}), std::u16string({0x3400 + 0x4000}));
  EXPECT_EQ(base32768({0xff, 0xff}), std::u16string({0x3400 + 0x7fff, 0x3400 + 0x4000}));
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 1000; ++i) bytes.push_back(static_cast<std::uint8_t>(i * i >> 3));
  const std::u16string text = base32768(bytes);
  EXPECT_EQ(text.size(), (1000u * 8 + 14) / 15);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const int letter = text[bit / 15] - 0x3400;
    ASSERT_EQ(letter >> (14 - bit % 15) & 1, bytes[bit / 8] >> (7 - bit % 8) & 1) << bit;
  }
}

}  // namespace
}  // namespace ssphh::report
