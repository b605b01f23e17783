#pragma once
/// A triangle filled evenly.

#include <ssphh/core/math.h>

namespace ssphh::shading {

/// Heitz, A Low-Distortion Map Between Triangle and Square, 2019: weights of the second and third corner.
inline vec2 square_to_triangle(const vec2& u) {
  return u.y > u.x ? vec2(0.5f * u.x, u.y - 0.5f * u.x) : vec2(u.x - 0.5f * u.y, 0.5f * u.y);
}

}  // namespace ssphh::shading
