#include "rgb9e5.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::sh {
namespace {

constexpr int mantissa_bits = 9, bias = 15;

/// Value of a mantissa's last bit.
float unit_of(int exponent) {
  return std::ldexp(1.0f, exponent - bias - mantissa_bits);
}

}  // namespace

std::uint32_t to_rgb9e5(const vec3& colour) {
  const vec3 c = glm::max(colour, vec3(0));
  const float largest = std::max({c.x, c.y, c.z});
  int exponent = largest > 0 ? std::max(0, std::ilogb(largest) + 1 + bias) : 0;
  if (std::round(largest / unit_of(exponent)) >= 1 << mantissa_bits) ++exponent;
  std::uint32_t word = static_cast<std::uint32_t>(exponent) << 27;
  for (int i = 0; i < 3; ++i)
    word |= static_cast<std::uint32_t>(std::round(c[i] / unit_of(exponent))) << (mantissa_bits * i);
  return word;
}

vec3 from_rgb9e5(std::uint32_t word) {
  const float unit = unit_of(static_cast<int>(word >> 27));
  return unit * vec3(word & 0x1ff, word >> 9 & 0x1ff, word >> 18 & 0x1ff);
}

}  // namespace ssphh::sh
