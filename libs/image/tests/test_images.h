#pragma once
/// Images and files for tests.

#include <cstddef>
#include <cstdint>
#include <string>
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

/// One row of 16-bit grey as a PNG file.
std::vector<std::byte> png_16bit_grey(const std::vector<std::uint16_t>& row);

}  // namespace ssphh::image::test
