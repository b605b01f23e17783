#pragma once
/// One point in the list of a cell, in 128 bits: fitted_lookup.glsl reads them in one fetch.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <ssphh/probes/surface_lists.h>

namespace ssphh::probes {

/// 0 x, 1 y, 2 z: the axis that a normal is nearest to.
inline int surface_axis(const vec3& normal) {
  const vec3 d = glm::abs(normal);
  return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
}

/// Of a cell's 8 × 8 squares across an axis, the one that `place` in [0, 1]³ falls into.
inline int surface_square(const vec3& place, int axis) {
  const auto at = [&](int c) { return std::clamp(static_cast<int>(place[c] * 8), 0, 7); };
  return axis == 0 ? at(1) + 8 * at(2) : axis == 1 ? at(0) + 8 * at(2) : at(0) + 8 * at(1);
}

/// `cover`: of surface_cover, 0..7; `squares` across `axis`: a bit for each that sees the point; `spacing`
/// of surface_spacings [m].
inline uvec4 pack_surface_entry(std::uint32_t point, int cover, int axis, std::uint64_t squares,
                                float spacing) {
  static_assert(SurfaceLists::most_points == 1 << 19);
  return {point | static_cast<std::uint32_t>(cover) << 19 | static_cast<std::uint32_t>(axis) << 22,
          static_cast<std::uint32_t>(squares), static_cast<std::uint32_t>(squares >> 32),
          std::bit_cast<std::uint32_t>(spacing)};
}

}  // namespace ssphh::probes
