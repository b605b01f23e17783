// OpenEXR files of luminance and chroma, written by OpenEXR itself.

#include <algorithm>

#include <ImfArray.h>
#include <ImfHeader.h>
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <ssphh/image/io.h>

#include "temp_dir.h"

namespace ssphh::image {
namespace {

using ssphh::test::TempDir;

const vec4 left(0.25f, 0.5f, 0.75f, 0.3f), right(0.9f, 0.2f, 0.4f, 0.8f);
constexpr int half_width = 40;

/// One colour on the left of column 40, another on the right.
Image two_colours(const std::filesystem::path& path, Imf::RgbaChannels channels, const Imath::Box2i& display,
                  const Imath::Box2i& data) {
  const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
  Imf::Array2D<Imf::Rgba> pixels(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec4& c = data.min.x + x < half_width ? left : right;
      pixels[y][x] = Imf::Rgba(c.x, c.y, c.z, c.w);
    }
  }
  {
    Imf::RgbaOutputFile file(path.c_str(), display, data, channels);
    file.setFrameBuffer(&pixels[0][0] - data.min.x - data.min.y * width, 1, static_cast<std::size_t>(width));
    file.writePixels(height);
  }
  return read_image(path);
}

Imath::Box2i box(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y1}};
}

const Imath::Box2i whole = box(0, 0, 2 * half_width - 1, 9);

/// Largest difference of a channel in the data window to the colour of its half. Chroma is of every second
/// pixel, filtered over 27: nearer to the edge than that the halves mix.
float largest_error(const Image& image, const Imath::Box2i& data) {
  float largest = 0;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x) {
      if (std::abs(x - half_width) < 27) continue;
      const vec4& c = x < half_width ? left : right;
      for (int k = 0; k < image.channels; ++k)
        largest = std::max(largest, std::abs(image.at(x, y)[k] - c[k]));
    }
  }
  return largest;
}

/// OpenEXR keeps 7 bits of luminance and 5 of chroma: half a step of these, of a largest channel below 1.
constexpr float rounding = 1.0f / 64;

TEST(LuminanceChroma, IsReadAsColour) {
  const TempDir dir;
  const Image image = two_colours(dir / "a.exr", Imf::WRITE_YC, whole, whole);
  ASSERT_EQ(image.channels, 3);
  ASSERT_EQ(image.width, 80);
  ASSERT_EQ(image.height, 10);
  EXPECT_LT(largest_error(image, whole), rounding);
}

TEST(LuminanceChroma, KeepsItsAlpha) {
  const TempDir dir;
  const Image image = two_colours(dir / "a.exr", Imf::WRITE_YCA, whole, whole);
  ASSERT_EQ(image.channels, 4);
  EXPECT_LT(largest_error(image, whole), rounding);
  // Alpha is of every pixel: sharp at the edge.
  EXPECT_NEAR(image.at(half_width - 1, 4)[3], left.w, 0x1p-11f);
  EXPECT_NEAR(image.at(half_width, 4)[3], right.w, 0x1p-11f);
}

TEST(LuminanceChroma, LuminanceAloneIsGrey) {
  const TempDir dir;
  const Image image = two_colours(dir / "a.exr", Imf::WRITE_Y, whole, whole);
  ASSERT_EQ(image.channels, 1);
  // Weights of Rec. 709; 7 bits.
  EXPECT_NEAR(*image.at(3, 3), 0.2126f * left.x + 0.7152f * left.y + 0.0722f * left.z, 0x1p-9f);
  EXPECT_NEAR(*image.at(70, 3), 0.2126f * right.x + 0.7152f * right.y + 0.0722f * right.z, 0x1p-9f);
}

TEST(LuminanceChroma, StandsWhereItsDataWindowSays) {
  const TempDir dir;
  const Imath::Box2i data = box(2, 4, 75, 9);
  const Image image = two_colours(dir / "a.exr", Imf::WRITE_YC, box(0, 0, 83, 13), data);
  ASSERT_EQ(image.width, 84);
  ASSERT_EQ(image.height, 14);
  EXPECT_LT(largest_error(image, data), rounding);
  int outside = 0, black = 0;
  for (int y = 0; y < 14; ++y) {
    for (int x = 0; x < 84; ++x) {
      if (data.intersects(Imath::V2i(x, y))) continue;
      ++outside, black += image.rgb(x, y) == vec3(0);
    }
  }
  EXPECT_EQ(outside, 84 * 14 - 74 * 6);
  EXPECT_EQ(black, outside);
}

}  // namespace
}  // namespace ssphh::image
