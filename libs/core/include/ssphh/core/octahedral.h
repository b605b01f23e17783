#pragma once
/// The sphere unfolded onto a square: an octahedron's upper half (+z) in the middle, its lower half turned
/// out into the corners (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
/// JCGT 2014).

#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh {

/// Place in [−1, 1]² of a direction of any length but zero.
inline vec2 octahedral_place(const vec3& direction) {
  const vec3 p = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  if (p.z >= 0) return {p.x, p.y};
  return {(1 - std::abs(p.y)) * std::copysign(1.0f, p.x), (1 - std::abs(p.x)) * std::copysign(1.0f, p.y)};
}

/// Unit direction of a place in [−1, 1]²; places a little outside are those across the edge, where the map
/// goes on mirrored at the edge's middle.
inline vec3 octahedral_direction(vec2 p) {
  if (std::abs(p.x) > 1) p = {std::copysign(2 - std::abs(p.x), p.x), -p.y};
  if (std::abs(p.y) > 1) p = {-p.x, std::copysign(2 - std::abs(p.y), p.y)};
  vec3 n(p, 1 - std::abs(p.x) - std::abs(p.y));
  if (n.z < 0) {
    n.x = (1 - std::abs(p.y)) * std::copysign(1.0f, p.x);
    n.y = (1 - std::abs(p.x)) * std::copysign(1.0f, p.y);
  }
  return glm::normalize(n);
}

/// Unit direction of the centre of texel i of an n×n map, row by row.
inline vec3 octahedral_texel(int i, int n) {
  const auto size = static_cast<float>(n);
  return octahedral_direction(
      {(2 * static_cast<float>(i % n) + 1) / size - 1, (2 * static_cast<float>(i / n) + 1) / size - 1});
}

}  // namespace ssphh
