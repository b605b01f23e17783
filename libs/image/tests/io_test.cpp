#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "error_message.h"
#include "shared_scenes.h"
#include "temp_dir.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;
using test::noise_image;
using test::same_bits;

// Collects warnings while it lives.
class WarningCatcher {
 public:
  WarningCatcher()
      : previous_(
            set_log_sink([this](LogLevel, const std::string& message) { messages.push_back(message); })) {}
  ~WarningCatcher() { set_log_sink(previous_); }
  std::vector<std::string> messages;

 private:
  LogSink previous_;
};

TEST(Exr, KeepsEveryBitOfEveryFloat) {
  for (const int channels : {1, 3, 4}) {
    Image image = noise_image(37, 21, channels, 100);
    image.pixels[0] = std::numeric_limits<float>::denorm_min();
    image.pixels[1] = -std::numeric_limits<float>::max();
    image.pixels[2] = -0.0f;
    EXPECT_TRUE(same_bits(decode_image(encode_exr(image), "memory"), image)) << channels << " channels";
  }
}

TEST(Exr, KeepsInfinityAndNanAndSaysSoOnce) {
  Image image = noise_image(4, 4, 3, 1);
  image.pixels[5] = std::numeric_limits<float>::infinity();
  image.pixels[6] = std::bit_cast<float>(0x7fc12345u);
  image.pixels[7] = std::numeric_limits<float>::quiet_NaN();
  WarningCatcher warnings;
  EXPECT_TRUE(same_bits(decode_image(encode_exr(image), "bad.exr"), image));
  EXPECT_THAT(warnings.messages, testing::ElementsAre("bad.exr: 2 of 16 pixels are infinite or NaN"));
}

TEST(Exr, WritesExtraChannelsBesideTheImage) {
  const Image image = noise_image(5, 3, 3, 1), depth = noise_image(5, 3, 1, 10);
  const auto data = encode_exr(image, std::vector<NamedChannel>{{"Z", depth.pixels}});
  EXPECT_TRUE(same_bits(decode_image(data, "memory"), image));
  EXPECT_GT(data.size(), encode_exr(image).size() + 15 * 3);  // noise does not compress
}

// The largest error of RGBE with rounding: half a step of the pixel's largest mantissa, which is at least
// 128.
constexpr float rgbe_step = 0.5f / 128;

TEST(Hdr, KeepsColoursWithinHalfAStepOfTheLargestChannel) {
  for (const int width : {1, 7, 8, 130, 300}) {  // below 8 pixels scanlines are not compressed
    const Image image = noise_image(width, 5, 3, 1000);
    const Image back = decode_image(encode_hdr(image), "memory");
    ASSERT_EQ(back.width, width);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < width; ++x) {
        const vec3 a = image.rgb(x, y), b = back.rgb(x, y);
        EXPECT_LE(max_component(glm::abs(a - b)), rgbe_step * max_component(a))
            << width << ": " << x << ", " << y;
      }
    }
  }
}

TEST(Hdr, RoundsWithoutBias) {
  const Image image = noise_image(256, 64, 3, 1);
  const Image back = decode_image(encode_hdr(image), "memory");
  double sum = 0, error = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    sum += double{image.pixels[i]};
    error += double{back.pixels[i]} - double{image.pixels[i]};
  }
  // Truncation would lose about 1/400 of the mean. The rounding errors of 49152 channels average to 1e-5 (4
  // sigma).
  EXPECT_LT(std::abs(error / sum), 4e-5);
}

TEST(Hdr, KeepsWhatRgbeCanSayExactly) {
  Image image(8, 1);
  image.set_rgb(0, 0, {1, 0.5f, 0});
  image.set_rgb(1, 0, {255, 128, 1});
  image.set_rgb(2, 0, {0x1p-100f, 0, 0});
  image.set_rgb(3, 0, vec3(0x1p100f));
  EXPECT_TRUE(same_bits(decode_image(encode_hdr(image), "memory"), image));
  EXPECT_TRUE(
      same_bits(decode_image(encode_hdr(decode_image(encode_hdr(image), "memory")), "memory"), image));
}

TEST(Hdr, ClampsWhatItCannotHold) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  Image image(3, 1);
  image.set_rgb(0, 0, {-1, nan, 2});
  image.set_rgb(1, 0, {inf, 0, 0});
  image.set_rgb(2, 0, {1e-45f, 0, 0});
  const Image back = decode_image(encode_hdr(image), "memory");
  EXPECT_EQ(back.rgb(0, 0), vec3(0, 0, 2));
  EXPECT_EQ(back.rgb(1, 0), vec3(0x1.fep126f, 0, 0));
  EXPECT_EQ(back.rgb(2, 0), vec3(0));
}

Image decode_text(const std::string& text) {
  return decode_image(std::as_bytes(std::span(text)), "text.hdr");
}

TEST(Hdr, ReadsOrientationExposureAndOldRuns) {
  const std::string pixels("\x80\x00\x00\x81\x00\x80\x00\x81", 8);  // red 1, green 1
  const vec3 red(1, 0, 0), green(0, 1, 0);
  const Image plain = decode_text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixels);
  EXPECT_EQ(plain.rgb(0, 0), red);
  EXPECT_EQ(plain.rgb(1, 0), green);
  const Image mirrored = decode_text("#?RGBE\n\n-Y 1 -X 2\n" + pixels);
  EXPECT_EQ(mirrored.rgb(0, 0), green);
  const Image upward = decode_text("#?RADIANCE\n\n+Y 2 +X 1\n" + pixels);
  EXPECT_EQ(upward.height, 2);
  EXPECT_EQ(upward.rgb(0, 1), red);
  const Image columns = decode_text("#?RADIANCE\n\n+X 1 -Y 2\n" + pixels);
  EXPECT_EQ(columns.height, 2);
  EXPECT_EQ(columns.rgb(0, 0), red);
  const Image exposed = decode_text("#?RADIANCE\nEXPOSURE=2\nEXPOSURE=4\n\n-Y 1 +X 2\n" + pixels);
  EXPECT_EQ(exposed.rgb(0, 0), red / 8.0f);
  const Image run = decode_text("#?RADIANCE\n\n-Y 1 +X 4\n" + pixels.substr(0, 4) + "\x01\x01\x01\x03");
  for (int x = 0; x < 4; ++x) EXPECT_EQ(run.rgb(x, 0), red);
}

TEST(Hdr, RefusesBrokenHeadersAndScanlines) {
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\n\n-Y 1 +X\n"); }),
              testing::HasSubstr("resolution line"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\n\n-Y 1 +Y 2\n"); }),
              testing::HasSubstr("resolution line"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n"); }),
              testing::HasSubstr("32-bit_rle_xyze"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\n\n-Y 3 +X 99999\n"); }),
              testing::HasSubstr("is 99999 x 3 pixels, the limit is"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\n\n-Y 16000 +X 16000\n"); }),
              testing::HasSubstr("only"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\n\n-Y 1 +X 4\n\x01\x01\x01\x04"); }),
              testing::HasSubstr("run without a pixel"));
  EXPECT_THAT(message_of([] { decode_text("#?RADIANCE\nno end"); }), testing::HasSubstr("text.hdr"));
}

TEST(Png, KeepsAll256CodesOfEachChannelCount) {
  for (const int channels : {1, 3, 4}) {
    Image image(256, 1, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const auto code = static_cast<std::uint8_t>(i / static_cast<std::size_t>(channels));
      image.pixels[i] = channels == 4 && i % 4 == 3 ? static_cast<float>(code) / 255 : srgb8_to_linear(code);
    }
    EXPECT_TRUE(same_bits(decode_image(encode_png(image), "memory"), image)) << channels << " channels";
  }
}

TEST(Png, GivesRgba8AsStored) {
  Rgba8 image{2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 255, 254, 253, 252}};
  const Rgba8 back = decode_rgba8(encode_png(image), "memory");
  EXPECT_EQ(back.width, 2);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(Png, Reads16BitsAndGreyWithAlpha) {
  const Image grey = decode_image(test::png_16bit_grey({0, 1, 0x8000, 0xffff}), "memory");
  ASSERT_EQ(grey.channels, 1);
  ASSERT_EQ(grey.width, 4);
  EXPECT_EQ(grey.pixels[0], 0);
  EXPECT_FLOAT_EQ(grey.pixels[1], 1.0f / 65535 / 12.92f);
  EXPECT_FLOAT_EQ(grey.pixels[2], srgb_to_linear(static_cast<float>(0x8000) / 65535));
  EXPECT_EQ(grey.pixels[3], 1);
}

TEST(Jpeg, StaysCloseToTheImage) {
  Image image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.set_rgb(x, y, {static_cast<float>(x) / 63, static_cast<float>(y) / 63, 0.5f});
    }
  }
  const Image back = decode_image(encode_jpeg(image, 100), "memory");
  ASSERT_EQ(back.channels, 3);
  float worst = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    worst = std::max(worst, std::abs(linear_to_srgb(image.pixels[i]) - linear_to_srgb(back.pixels[i])));
  }
  // Quality 100 quantises coefficients by 1; rounding of 64 coefficients and of the colour conversion adds up
  // to few codes out of 255.
  EXPECT_LT(worst, 6.0f / 255);
}

TEST(Transfer, MatchesTheStandardAndIsItsOwnInverse) {
  // Values of IEC 61966-2-1's formula in double precision.
  EXPECT_FLOAT_EQ(srgb_to_linear(0.5f), 0.2140411404715882f);
  EXPECT_FLOAT_EQ(srgb_to_linear(0.04f), 0.0030959752321981426f);
  EXPECT_FLOAT_EQ(linear_to_srgb(0.18f), 0.4613561295004415f);
  // On both sides of the breaks, where line and power meet to 1e-4 only nearby.
  EXPECT_FLOAT_EQ(linear_to_srgb(0.003f), 12.92f * 0.003f);
  EXPECT_NEAR(linear_to_srgb(0.0035f), 1.055 * std::pow(0.0035, 1 / 2.4) - 0.055, 1e-7);
  EXPECT_NEAR(srgb_to_linear(0.045f), std::pow((0.045 + 0.055) / 1.055, 2.4), 1e-8);
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(linear_to_srgb8(srgb8_to_linear(static_cast<std::uint8_t>(code))), code);
  }
  EXPECT_EQ(linear_to_srgb8(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(linear_to_srgb8(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(linear_to_srgb8(-1), 0);
}

TEST(WriteImage, ChoosesTheFormatByExtension) {
  const ssphh::test::TempDir dir;
  const Image image = noise_image(9, 4, 3, 1);
  const std::vector<std::pair<std::string, FileFormat>> formats{{"a.exr", FileFormat::exr},
                                                                {"a.HDR", FileFormat::hdr},
                                                                {"a.png", FileFormat::png},
                                                                {"a.jpeg", FileFormat::jpeg}};
  for (const auto& [name, format] : formats) {
    write_image(dir / name, image);
    EXPECT_EQ(format_of_content(read_file(dir / name)), format) << name;
    EXPECT_EQ(read_image(dir / name).width, 9);
  }
  EXPECT_THAT(message_of([&] { write_image(dir / "a.bmp", image); }), testing::HasSubstr(".bmp"));
}

TEST(WriteImage, ReportsAFullDiskAndAPlaceThatCannotBeWritten) {
  const ssphh::test::TempDir dir;
  const Image image = noise_image(64, 64, 3, 1);
  ASSERT_EQ(::symlink("/dev/full", (dir / "full.exr").c_str()), 0);
  EXPECT_THAT(message_of([&] { write_image(dir / "full.exr", image); }), testing::HasSubstr("No space left"));
  EXPECT_THAT(message_of([&] { write_image(dir / "no" / "such.exr", image); }),
              testing::HasSubstr("No such file"));
  EXPECT_THAT(message_of([&] { read_image(dir / "none.exr"); }), testing::HasSubstr("none.exr"));
}

TEST(DecodeImage, RefusesWhatIsNoImage) {
  EXPECT_THAT(message_of([] { decode_image({}, "empty.png"); }), testing::HasSubstr("empty.png: is empty"));
  const std::string text = "hello, world";
  EXPECT_THAT(message_of([&] { decode_image(std::as_bytes(std::span(text)), "text.png"); }),
              testing::HasSubstr("no image"));
  EXPECT_THAT(message_of([&] { decode_rgba8(encode_hdr(Image(1, 1)), "a.png"); }),
              testing::HasSubstr("8-bit"));
}

TEST(DecodeImage, KeepsTheCallersLimits) {
  const Image image = noise_image(20, 10, 3, 1);
  for (const auto& data : {encode_exr(image), encode_hdr(image), encode_png(image), encode_jpeg(image)}) {
    EXPECT_EQ(decode_image(data, "memory", {20, 200}).height, 10);
    EXPECT_THROW(decode_image(data, "memory", {19, 200}), Error);
    EXPECT_THROW(decode_image(data, "memory", {20, 199}), Error);
  }
}

}  // namespace
}  // namespace ssphh::image
