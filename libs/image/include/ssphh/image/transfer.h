#pragma once
/// The sRGB transfer curve (IEC 61966-2-1) and rounding to 8 bits.

#include <cstdint>

namespace ssphh::image {

/// Encoded [0, 1] to linear. Defined for all x; negative values are mirrored.
float srgb_to_linear(float encoded);

/// Linear to encoded; inverse of srgb_to_linear.
float linear_to_srgb(float linear);

/// The linear value of an 8-bit sRGB code.
float srgb8_to_linear(std::uint8_t code);

/// The sRGB code of a linear value: clamped to [0, 1], rounded to nearest; NaN gives 0.
std::uint8_t linear_to_srgb8(float linear);

/// round(255·x) with x clamped to [0, 1]; NaN gives 0.
std::uint8_t unit_to_8bit(float x);

}  // namespace ssphh::image
