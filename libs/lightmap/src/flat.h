#pragma once

#include <ssphh/core/math.h>

namespace ssphh::lightmap {

/// The third component of the cross product of vectors in a plane.
inline float cross(const vec2& a, const vec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace ssphh::lightmap
