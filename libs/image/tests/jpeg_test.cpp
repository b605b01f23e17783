// JPEG files that libjpeg was asked for: inks, scans, damage.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include <gmock/gmock.h>
#include <jpeglib.h>

#include <ssphh/image/io.h>

#include "error_message.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;
using test::said_of;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

/// A file of 16 × 16 equal pixels, written by libjpeg with `settings`.
template <class Settings>
Bytes flat_jpeg(J_COLOR_SPACE space, std::vector<std::uint8_t> pixel, const Settings& settings) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &data, &size);
  jpeg.image_width = jpeg.image_height = 16;
  jpeg.input_components = static_cast<int>(pixel.size());
  jpeg.in_color_space = space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  settings(jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row;
  for (int x = 0; x < 16; ++x) row.insert(row.end(), pixel.begin(), pixel.end());
  for (int y = 0; y < 16; ++y) {
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  Bytes file(begin, begin + size);
  jpeg_destroy_compress(&jpeg);
  std::free(data);
  return file;
}

std::vector<int> first_pixel(const Bytes& file) {
  const Rgba8 image = decode_rgba8(file, "f");
  EXPECT_EQ(image.rgba.size(), 16u * 16 * 4);
  return {image.rgba[0], image.rgba[1], image.rgba[2], image.rgba[3]};
}

void expect_near(const std::vector<int>& codes, const std::vector<int>& wanted) {
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(codes[c], wanted[c], 2) << "channel " << c;
}

const auto as_it_is = [](jpeg_compress_struct&) {};

TEST(JpegColors, OfGreyAndRgb) {
  expect_near(first_pixel(flat_jpeg(JCS_GRAYSCALE, {90}, as_it_is)), {90, 90, 90, 255});
  expect_near(first_pixel(flat_jpeg(JCS_RGB, {200, 100, 50}, as_it_is)), {200, 100, 50, 255});
  EXPECT_EQ(decode_image(flat_jpeg(JCS_GRAYSCALE, {90}, as_it_is), "f").channels, 1);
  EXPECT_EQ(decode_image(flat_jpeg(JCS_RGB, {1, 2, 3}, as_it_is), "f").channels, 3);
}

// Photoshop writes inks inverted, and says so by Adobe's marker; light that inks leave is their product.
TEST(JpegColors, OfInks) {
  const auto adobe = [](jpeg_compress_struct& jpeg) { jpeg.write_Adobe_marker = TRUE; };
  const auto plain = [](jpeg_compress_struct& jpeg) { jpeg.write_Adobe_marker = FALSE; };
  expect_near(first_pixel(flat_jpeg(JCS_CMYK, {255, 51, 128, 255}, adobe)), {255, 51, 128, 255});
  expect_near(first_pixel(flat_jpeg(JCS_CMYK, {255, 51, 128, 128}, adobe)), {128, 26, 64, 255});
  expect_near(first_pixel(flat_jpeg(JCS_CMYK, {0, 204, 127, 127}, plain)), {128, 26, 64, 255});
  const auto ycck = [](jpeg_compress_struct& jpeg) { jpeg_set_colorspace(&jpeg, JCS_YCCK); };
  expect_near(first_pixel(flat_jpeg(JCS_CMYK, {255, 51, 128, 255}, ycck)), {255, 51, 128, 255});
}

// Light and dark columns side by side: only what no chroma is averaged over keeps them apart.
TEST(JpegOutput, KeepsColoursOfEveryPixelAboveQuality90) {
  Image image(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) image.set_rgb(x, y, x % 2 ? vec3(0.8f, 0, 0) : vec3(0, 0, 0.8f));
  }
  const auto red_of_blue = [&](int quality) {
    return static_cast<double>(decode_image(encode_jpeg(image, quality), "f").rgb(4, 4).x);
  };
  EXPECT_LT(red_of_blue(91), 0.05);
  EXPECT_GT(red_of_blue(90), 0.1);
}

Bytes spliced(const Bytes& file, std::size_t at, const Bytes& more) {
  Bytes result = file;
  result.insert(result.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
  return result;
}

std::size_t find_marker(const Bytes& file, int marker, std::size_t from = 0) {
  const std::array<std::byte, 2> wanted{std::byte{0xff}, static_cast<std::byte>(marker)};
  const auto found =
      std::search(file.begin() + static_cast<std::ptrdiff_t>(from), file.end(), wanted.begin(), wanted.end());
  EXPECT_NE(found, file.end());
  return static_cast<std::size_t>(found - file.begin());
}

// Some cameras leave bytes between segments.
TEST(JpegDamage, BytesBetweenSegmentsAreNone) {
  const Bytes good = flat_jpeg(JCS_RGB, {200, 100, 50}, as_it_is);
  const Bytes odd = spliced(good, find_marker(good, 0xdb), Bytes(5, std::byte{7}));
  EXPECT_EQ(decode_rgba8(odd, "f").rgba, decode_rgba8(good, "f").rgba);
}

TEST(JpegDamage, IsNamed) {
  const Bytes good = flat_jpeg(JCS_RGB, {200, 100, 50}, as_it_is);
  EXPECT_EQ(said_of(good), "no error");
  EXPECT_EQ(said_of({good.begin(), good.end() - 2}), "f: broken JPEG: Premature end of JPEG file");
  EXPECT_THAT(said_of({good.begin(), good.begin() + 30}), HasSubstr("f: broken JPEG: "));
}

// Each repetition costs a pass over the whole picture.
TEST(JpegDamage, ScansAreNotRepeatedWithoutEnd) {
  static const std::array<jpeg_scan_info, 2> scans{{{1, {0}, 0, 0, 0, 0}, {1, {0}, 1, 63, 0, 0}}};
  const Bytes good = flat_jpeg(JCS_GRAYSCALE, {90}, [](jpeg_compress_struct& jpeg) {
    jpeg.scan_info = scans.data();
    jpeg.num_scans = static_cast<int>(scans.size());
  });
  const std::size_t scan = find_marker(good, 0xda), next = find_marker(good, 0xc4, scan);
  Bytes again;
  for (int i = 0; i < 600; ++i)
    again.insert(again.end(), good.begin() + static_cast<std::ptrdiff_t>(scan),
                 good.begin() + static_cast<std::ptrdiff_t>(next));
  EXPECT_EQ(said_of(good), "no error");
  EXPECT_THAT(said_of(spliced(good, scan, again)),
              HasSubstr("f: broken JPEG: Invalid progressive parameters"));
  again.resize(again.size() / 2);
  EXPECT_EQ(said_of(spliced(good, scan, again)), "no error");
}

TEST(JpegDamage, SizesAreCheckedBeforeMemoryIsTaken) {
  const Bytes good = flat_jpeg(JCS_GRAYSCALE, {90}, as_it_is);
  EXPECT_EQ(message_of([&] {
              decode_image(good, "f", {15, 1000});
            }),
            "f: is 16 x 16 pixels, the limit is 15 per side");
  EXPECT_EQ(message_of([&] {
              decode_image(good, "f", {16, 255});
            }),
            "f: is 16 x 16 pixels, the limit is 255 in all");
}

}  // namespace
}  // namespace ssphh::image
