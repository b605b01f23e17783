#pragma once
/// One point in the list of a cell, in 128 bits: fitted_lookup.glsl reads them in one fetch.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <ssphh/probes/surface_lists.h>

namespace ssphh::probes {

/// A unit vector on the octahedral map's 63² grid: integers, so that all agree on its largest component.
struct CoarseNormal {
  static constexpr int steps = 31;
  int u = 0, v = 0;  ///< −31..31

  static CoarseNormal of(const vec3& n) {
    const vec3 p = n / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    vec2 e(p.x, p.y);
    if (p.z < 0)
      e = {(1 - std::abs(p.y)) * (p.x >= 0 ? 1.0f : -1.0f), (1 - std::abs(p.x)) * (p.y >= 0 ? 1.0f : -1.0f)};
    const auto step = [](float x) {
      return static_cast<int>(std::lround(std::clamp(x, -1.0f, 1.0f) * steps));
    };
    return {step(e.x), step(e.y)};
  }
  /// In the vector's direction.
  ivec3 direction() const {
    const int z = steps - std::abs(u) - std::abs(v);
    if (z >= 0) return {u, v, z};
    return {(steps - std::abs(v)) * (u >= 0 ? 1 : -1), (steps - std::abs(u)) * (v >= 0 ? 1 : -1), z};
  }
  vec3 unit() const { return glm::normalize(vec3(direction())); }
  /// 0 x, 1 y, 2 z: the axis that it is nearest to.
  int axis() const {
    const ivec3 d = glm::abs(direction());
    return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  }
};

/// Of a cell's 8 × 8 squares across an axis, the one that `place` in [0, 1]³ falls into.
inline int surface_square(const vec3& place, int axis) {
  const auto at = [&](int c) { return std::clamp(static_cast<int>(place[c] * 8), 0, 7); };
  return axis == 0 ? at(1) + 8 * at(2) : axis == 1 ? at(0) + 8 * at(2) : at(0) + 8 * at(1);
}

/// `place`: the point in cells' sides from the cell's corner, −6..7; `squares`: a bit for each that sees it;
/// `cover`: of surface_cover, 0..7.
inline uvec4 pack_surface_entry(std::uint32_t point, int cover, const vec3& place, const CoarseNormal& normal,
                                std::uint64_t squares) {
  const auto step = [](float x) {
    return static_cast<std::uint32_t>(std::lround(std::clamp((x + 6) / 13, 0.0f, 1.0f) * 1023));
  };
  const auto nu = static_cast<std::uint32_t>(normal.u + 32), nv = static_cast<std::uint32_t>(normal.v + 32);
  return {static_cast<std::uint32_t>(cover) << 29 | point << 10 | (nu & 31u) << 5 | (nv & 31u),
          step(place.x) | step(place.y) << 10 | step(place.z) << 20 | (nu >> 5) << 30 | (nv >> 5) << 31,
          static_cast<std::uint32_t>(squares), static_cast<std::uint32_t>(squares >> 32)};
}

}  // namespace ssphh::probes
