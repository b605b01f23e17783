#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::probe_export {

/// A KTX 2.0 file of one 3-D texture of RGBA half floats (VK_FORMAT_R16G16B16A16_SFLOAT), one level, not
/// packed, linear Rec.709; x fastest, then y, then z.
std::vector<std::byte> ktx2_of_half_volume(const glm::ivec3& size, std::span<const std::byte> texels);

}  // namespace ssphh::probe_export
