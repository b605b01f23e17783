#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/report/packed_image.h>

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
