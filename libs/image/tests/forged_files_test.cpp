/// HDR files made byte by byte: each limit at its edge and one beyond, and what is said of it.

#include <gtest/gtest.h>

#include "codec.h"
#include "error_message.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string said_by(const std::string& file, void (*check)(const Source&), const DecodeLimits& limits = {}) {
  const std::string name = "f";
  return message_of([&] { check({bytes_of(file), name, limits}); });
}

// --- all formats

TEST(CheckSize, KeepsTheLimitsOfWhoAsks) {
  const auto said = [](std::int64_t width, std::int64_t height, const DecodeLimits& limits) {
    const std::string file(1 << 17, ' '), name = "f";
    return message_of([&] { check_size({bytes_of(file), name, limits}, width, height); });
  };
  EXPECT_EQ(said(65536, 4096, {}), "no error") << "2^28 pixels";
  EXPECT_EQ(said(4096, 65536, {}), "no error");
  EXPECT_EQ(said(65537, 1, {}), "f: is 65537 x 1 pixels, the limit is 65536 per side");
  EXPECT_EQ(said(1, 65537, {}), "f: is 1 x 65537 pixels, the limit is 65536 per side");
  EXPECT_EQ(said(65536, 4097, {}), "f: is 65536 x 4097 pixels, the limit is 268435456 in all");
  EXPECT_EQ(said(6, 4, {6, 24}), "no error");
  EXPECT_EQ(said(7, 2, {6, 24}), "f: is 7 x 2 pixels, the limit is 6 per side");
  EXPECT_EQ(said(6, 4, {6, 23}), "f: is 6 x 4 pixels, the limit is 23 in all");
  EXPECT_EQ(said(0, 4, {}), "f: has no pixels: 0 x 4");
  EXPECT_EQ(said(4, 0, {}), "f: has no pixels: 4 x 0");
  EXPECT_EQ(said(-1, 4, {}), "f: has no pixels: -1 x 4");
}

TEST(CheckSize, LargePicturesHaveAByteForEvery4096Pixels) {
  const auto said = [](std::int64_t width, std::int64_t height, std::size_t size) {
    const std::string file(size, ' '), name = "f";
    const DecodeLimits limits;
    return message_of([&] { check_size({bytes_of(file), name, limits}, width, height); });
  };
  EXPECT_EQ(said(4096, 4096, 1), "no error") << "2^24 pixels may be as sparse as they like";
  EXPECT_EQ(said(4096, 4097, 4097), "no error");
  EXPECT_EQ(said(4096, 4097, 4096), "f: announces 4096 x 4097 pixels in only 4096 bytes");
}

// --- Radiance HDR

std::string said_of_hdr(const std::string& rest) {
  return said_by("#?RADIANCE\n" + rest, [](const Source& source) { decode_hdr(source); });
}

const std::string pixel("\x80\x40\x20\x81", 4);

TEST(ForgedHdr, HeaderLinesHaveAnEndWithin4096Bytes) {
  const std::string size = "\n-Y 1 +X 1\n";
  EXPECT_EQ(said_of_hdr(std::string(4095, '#') + "\n" + size + pixel), "no error");
  EXPECT_EQ(said_of_hdr(std::string(4096, '#') + "\n" + size + pixel),
            "f: header line without an end (Radiance HDR, byte 11)");
  EXPECT_EQ(said_of_hdr("no end"), "f: header line without an end (Radiance HDR, byte 11)");
}

TEST(ForgedHdr, ExposureIsAPositiveNumberThatAFloatHolds) {
  const auto exposed = [](const std::string& value) {
    return said_of_hdr("EXPOSURE=" + value + "\n\n-Y 1 +X 1\n" + pixel);
  };
  for (const char* good : {"1.1e-30", "0.9e30"}) EXPECT_EQ(exposed(good), "no error") << good;
  for (const char* bad : {"0.9e-30", "1.1e30", "0", "-1", "nan", "none"})
    EXPECT_TRUE(exposed(bad).starts_with("f: EXPOSURE is not a positive number (Radiance HDR, byte ")) << bad;
}

TEST(ForgedHdr, ResolutionHasTwoSignedAxes) {
  const std::string wrong = "f: resolution line is not of the form '-Y HEIGHT +X WIDTH' (Radiance HDR, byte ";
  for (const char* good : {"-Y 1 +X 2", "+Y 2 -X 1", "+X 1 +Y 2", "-X 2 -Y 1"})
    EXPECT_EQ(said_of_hdr("\n" + std::string(good) + "\n" + pixel + pixel), "no error") << good;
  for (const char* bad :
       {"-Y 1 +Y 2", "-X 1 +X 2", "=Y 1 +X 2", "-Y 1 *X 2", "-Z 1 +X 2", "-Y 1 +Z 2", "-Y 1"}) {
    EXPECT_TRUE(said_of_hdr("\n" + std::string(bad) + "\n" + pixel + pixel).starts_with(wrong)) << bad;
  }
  EXPECT_EQ(said_of_hdr("FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel),
            "f: unsupported pixel format '32-bit_rle_xyze' (Radiance HDR, byte 34)");
}

/// A scanline of `width` pixels, of which the file has these bytes.
std::string said_of_line(int width, const std::string& bytes) {
  const std::string said = said_of_hdr("\n-Y 1 +X " + std::to_string(width) + "\n" + bytes);
  return said.substr(0, said.find(" (Radiance"));
}

TEST(ForgedHdr, RunsLieWithinTheirScanline) {
  const std::string head("\x02\x02\x00\x08", 4);
  const std::string run("\x88\x07", 2), literals(
                                            "\x08"
                                            "abcdefgh",
                                            9);
  EXPECT_EQ(said_of_line(8, head + run + literals + run + literals), "no error");
  EXPECT_EQ(said_of_line(8, head + run + literals + run + literals.substr(0, 8)), "f: ends too early");
  const std::string leaves = "f: run-length code leaves the scanline";
  EXPECT_EQ(said_of_line(8, head + "\x89\x07" + literals + run + run), leaves);
  EXPECT_EQ(said_of_line(8, head + "\x84\x07\x85\x07" + literals + run + run), leaves);
  EXPECT_EQ(said_of_line(8, head + std::string(1, '\0') + literals + run + run), leaves);
  EXPECT_EQ(said_of_line(8, head + "\x80" + literals + run + run), leaves) << "128 is a literal of 128";
  EXPECT_EQ(said_of_line(9, head + run + run + run + run), "f: scanline of a wrong length");
  EXPECT_EQ(said_of_line(8, std::string("\x02\x02\x01\x08", 4) + run + run + run + run),
            "f: scanline of a wrong length");
}

TEST(ForgedHdr, OnlyScanlinesOfEightPixelsOnAreRuns) {
  // Pixels that look like the beginning of runs.
  std::string line;
  for (int i = 0; i < 7; ++i) line += std::string("\x02\x02\x00\x81", 4);
  EXPECT_EQ(said_of_line(7, line), "no error");
  EXPECT_EQ(said_of_line(8, line + pixel), "f: scanline of a wrong length");
  const std::string rest = line.substr(4) + pixel;
  EXPECT_EQ(said_of_line(8, std::string("\x02\x02\x80\x08", 4) + rest), "no error") << "a third byte of 128";
  EXPECT_EQ(said_of_line(8, std::string("\x02\x03\x00\x08", 4) + rest), "no error");
  EXPECT_EQ(said_of_line(8, std::string("\x03\x02\x00\x08", 4) + rest), "no error");
}

TEST(ForgedHdr, OldRunsCountInBase256) {
  const auto times = [](int n) { return std::string("\x01\x01\x01", 3) + static_cast<char>(n); };
  EXPECT_EQ(said_of_line(4, pixel + times(3)), "no error");
  EXPECT_EQ(said_of_line(4, pixel + times(4)), "f: run-length code leaves the scanline");
  EXPECT_EQ(said_of_line(1 + 2 + 256, pixel + times(2) + times(1)), "no error");
  EXPECT_EQ(said_of_line(1 + 2 + 256 - 1, pixel + times(2) + times(1)),
            "f: run-length code leaves the scanline");
  EXPECT_EQ(said_of_line(2, times(1) + pixel), "f: run without a pixel to repeat");
  const std::string none = times(0) + times(0) + times(0);
  EXPECT_EQ(said_of_line(2, pixel + none + pixel), "no error") << "three counts of nothing";
  EXPECT_EQ(said_of_line(2, pixel + none + times(0) + pixel), "f: run without a pixel to repeat");
  EXPECT_EQ(said_of_line(4, pixel + times(1) + pixel + times(1)), "no error") << "a pixel ends a count";
  EXPECT_EQ(said_of_line(2, pixel + pixel.substr(0, 3)), "f: ends too early");
}

/// The bytes behind the header of a written file.
std::string written(const Image& image) {
  const std::vector<std::byte> file = encode_hdr(image);
  const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
  return text.substr(text.find("+X"));
}

TEST(ForgedHdr, IsWrittenInRunsOfFourTo127AndLiteralsOf128) {
  Image image(300, 1);
  for (int x = 0; x < 300; ++x) image.set_rgb(x, 0, vec3(1));
  const std::string ones = "\xff\x80\xff\x80\xae\x80", exponents = "\xff\x81\xff\x81\xae\x81";
  EXPECT_EQ(written(image), std::string("+X 300\n\x02\x02\x01\x2c", 11) + ones + ones + ones + exponents);

  // Red: runs of three and of four; green: no equal neighbours; blue: none at all.
  Image mixed(150, 1);
  for (int x = 0; x < 150; ++x) {
    const float red = x < 3 ? 16 : x < 7 ? 32 : x % 2 ? 64 : 48, green = x % 2 ? 16 : 32;
    mixed.set_rgb(x, 0, {red, green, 128});
  }
  std::string red("\x03\x10\x10\x10\x84\x20\x80", 7), green("\x80", 1);
  for (int x = 7; x < 135; ++x) red += x % 2 ? '\x40' : '\x30';
  red += '\x0f';
  for (int x = 135; x < 150; ++x) red += x % 2 ? '\x40' : '\x30';
  for (int x = 0; x < 128; ++x) green += x % 2 ? '\x10' : '\x20';
  green += '\x16';
  for (int x = 128; x < 150; ++x) green += x % 2 ? '\x10' : '\x20';
  EXPECT_EQ(written(mixed), std::string("+X 150\n\x02\x02\x00\x96", 11) + red + green + "\xff\x80\x97\x80" +
                                "\xff\x88\x97\x88");
  EXPECT_EQ(written(Image(7, 1)), "+X 7\n" + std::string(28, '\0')) << "too short for runs";
}

}  // namespace
}  // namespace ssphh::image
