#pragma once

#include <cstdint>

namespace ssphh::image {

/// The half float nearest to a value. Throws Error(what, ...) for one that has none: beyond 65504, or NaN.
std::uint16_t to_half(float value, const char* what);

}  // namespace ssphh::image
