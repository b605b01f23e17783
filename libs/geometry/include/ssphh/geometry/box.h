#pragma once
/// Boxes along the axes, from `low` to `high`.

#include <ssphh/core/math.h>

namespace ssphh::geometry {

/// Whether two boxes have no place in common; those that touch have. Numbers that are none keep no boxes
/// apart.
inline bool apart(const vec3& low, const vec3& high, const vec3& other_low, const vec3& other_high) {
  return high.x < other_low.x || low.x > other_high.x || high.y < other_low.y || low.y > other_high.y ||
         high.z < other_low.z || low.z > other_high.z;
}

}  // namespace ssphh::geometry
