#include <array>
#include <cmath>

#include <ssphh/image/transfer.h>

namespace ssphh::image {

float srgb_to_linear(float encoded) {
  const float a = std::abs(encoded);
  const float linear = a <= 0.04045f ? a / 12.92f : std::pow((a + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

float linear_to_srgb(float linear) {
  const float a = std::abs(linear);
  const float encoded = a <= 0.0031308f ? a * 12.92f : 1.055f * std::pow(a, 1 / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float srgb8_to_linear(std::uint8_t code) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = srgb_to_linear(static_cast<float>(i) / 255);
    return t;
  }();
  return table[code];
}

std::uint8_t unit_to_8bit(float x) {
  if (!(x > 0)) return 0;  // also NaN
  return x >= 1 ? 255 : static_cast<std::uint8_t>(255 * x + 0.5f);
}

std::uint8_t linear_to_srgb8(float linear) {
  return linear > 0 ? unit_to_8bit(linear_to_srgb(linear)) : 0;
}

}  // namespace ssphh::image
