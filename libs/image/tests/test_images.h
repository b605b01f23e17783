#pragma once
/// Images and files for tests.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/image/image.h>

namespace ssphh::image::test {

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

}  // namespace ssphh::image::test
