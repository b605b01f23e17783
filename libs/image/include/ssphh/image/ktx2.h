#pragma once
/// KTX 2.0 textures of half floats.

#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::image {

/// A KTX 2.0 file of one texture of RGBA half floats (VK_FORMAT_R16G16B16A16_SFLOAT), one level, not packed,
/// linear Rec.709; x fastest, then y, then z. A depth of 0 makes it two-dimensional, row 0 on top.
std::vector<std::byte> ktx2_of_halves(const glm::ivec3& size, std::span<const std::byte> texels);

/// The same of an image; without a fourth channel alpha is 1. Throws Error for an image that is not whole and
/// as to_half().
std::vector<std::byte> encode_ktx2(const Image& image);

}  // namespace ssphh::image
