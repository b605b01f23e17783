#pragma once
/// Images and files for tests.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/image/image.h>

// What all tests share is found as test::name beside these, too.
namespace ssphh::test {}
namespace ssphh::image::test {
using namespace ssphh::test;

/// Whether size and every bit of every number are the same.
inline bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(), [](float x, float y) {
           return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
         });
}

/// Uniform in (0, scale].
inline Image noise_image(int width, int height, int channels, float scale, std::uint64_t seed = 1) {
  Image image(width, height, channels);
  Pcg32 random(seed);
  for (float& x : image.pixels) x = scale * (1 - random.uniform());
  return image;
}

/// Type and data.
using PngChunk = std::pair<std::string, std::vector<std::uint8_t>>;

/// One row of samples, as the file holds them, as a PNG file with `chunks` before its picture.
std::vector<std::byte> png_row(int width, int depth, int color_type, const std::vector<std::uint8_t>& samples,
                               const std::vector<PngChunk>& chunks = {});

/// One row of 16-bit grey as a PNG file.
std::vector<std::byte> png_16bit_grey(const std::vector<std::uint16_t>& row);

/// What is said of a file's bytes when they are decoded; "no error" of a picture.
std::string said_of(std::span<const std::byte> file);

}  // namespace ssphh::image::test
