#pragma once
/// Numbers that are none, as input.

#include <limits>

namespace ssphh::test {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace ssphh::test
