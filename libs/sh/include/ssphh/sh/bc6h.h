#pragma once
/// Blocks of BC6H_UF16 (Khronos Data Format Specification 1.3, §20.2; GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT,
/// DXGI_FORMAT_BC6H_UF16): sixteen colours of a 4×4 image, row by row.

#include <array>
#include <cstddef>
#include <span>

#include <ssphh/core/vectors.h>

namespace ssphh::sh {

using Bc6hColours = std::array<vec3, 16>;
using Bc6hBlock = std::array<std::byte, 16>;

inline constexpr float bc6h_most = 65504;

/// The block, of all modes and shapes of two regions, whose colours are near: the least sum of squares of
/// those that were tried. Channels are cut to 0..bc6h_most; NaN is 0.
Bc6hBlock to_bc6h(const Bc6hColours& colours);

/// As GPUs read it, to the bit; blocks of reserved modes are black.
Bc6hColours from_bc6h(const Bc6hBlock& block);

}  // namespace ssphh::sh
