#pragma once
/// What PNG, JPEG and WebP share: codes of 8 bits in the sRGB transfer curve, with linear alpha.

#include <cstdint>
#include <vector>

#include <ssphh/image/transfer.h>

namespace ssphh::image {

inline bool is_alpha(std::size_t index, int channels) {
  return channels == 4 && index % 4 == 3;
}

inline float decode_8bit(std::uint8_t code, bool alpha) {
  return alpha ? static_cast<float>(code) / 255 : srgb8_to_linear(code);
}

inline std::vector<std::uint8_t> encode_8bit(const Image& image) {
  std::vector<std::uint8_t> codes(image.pixels.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const float x = image.pixels[i];
    codes[i] = is_alpha(i, image.channels) ? unit_to_8bit(x) : linear_to_srgb8(x);
  }
  return codes;
}

}  // namespace ssphh::image
