#pragma once

#include <cstdint>

#include <ssphh/core/vectors.h>

namespace ssphh::sh {

inline constexpr float rgb9e5_most = 65408;

/// Three mantissas of 9 bits, red lowest, and an exponent of 5, as Vulkan's E5B9G9R9_UFLOAT_PACK32: rounded
/// by half a unit of the largest channel's mantissa. Negative channels become 0; none is over rgb9e5_most.
std::uint32_t to_rgb9e5(const vec3& colour);
vec3 from_rgb9e5(std::uint32_t word);

}  // namespace ssphh::sh
