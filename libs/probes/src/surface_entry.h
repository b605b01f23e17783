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

/// Ways to cut a cell into 64 parts: 0, 1 and 2 are 8 × 8 columns along that axis, this is 4 × 4 × 4 cubes.
constexpr int cubes_cut = 3, cut_count = 4;

/// The part of a cell, cut so, that `place` in [0, 1]³ falls into.
inline int surface_part(const vec3& place, int cut) {
  const auto at = [&](int c) { return std::clamp(static_cast<int>(place[c] * 8), 0, 7); };
  if (cut == cubes_cut) return at(0) / 2 + 4 * (at(1) / 2) + 16 * (at(2) / 2);
  return cut == 0 ? at(1) + 8 * at(2) : cut == 1 ? at(0) + 8 * at(2) : at(0) + 8 * at(1);
}

/// The parts, and all that touch them by a side, an edge or a corner.
inline std::uint64_t grown_parts(std::uint64_t parts, int cut) {
  // `not_first`: parts that have a neighbour `step` bits below
  const auto along = [&](int step, std::uint64_t not_first) {
    parts |= (parts << step & not_first) | (parts & not_first) >> step;
  };
  if (cut == cubes_cut) {
    along(1, 0xeeeeeeeeeeeeeeee), along(4, 0xfff0fff0fff0fff0), along(16, ~std::uint64_t{0xffff});
  } else {
    along(1, 0xfefefefefefefefe), along(8, ~std::uint64_t{0xff});
  }
  return parts;
}

/// `cover`: of surface_cover, 0..7; `parts` of the cell, cut so: a bit for each that sees the point;
/// `spacing` of surface_spacings [m].
inline uvec4 pack_surface_entry(std::uint32_t point, int cover, int cut, std::uint64_t parts, float spacing) {
  static_assert(SurfaceLists::most_points == 1 << 19);
  return {point | static_cast<std::uint32_t>(cover) << 19 | static_cast<std::uint32_t>(cut) << 22,
          static_cast<std::uint32_t>(parts), static_cast<std::uint32_t>(parts >> 32),
          std::bit_cast<std::uint32_t>(spacing)};
}

}  // namespace ssphh::probes
