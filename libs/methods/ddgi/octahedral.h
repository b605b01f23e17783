#pragma once
/// The sphere unfolded onto a square: an octahedron's upper half (+z) in the middle, its lower half turned
/// out into the corners (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
/// JCGT 2014).

#include <array>
#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::methods::ddgi {

/// Place in [0, 1]² of a direction of any length but zero.
inline vec2 octahedral(const vec3& d) {
  const auto sign = [](float x) { return x < 0 ? -1.0f : 1.0f; };
  const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  vec2 p(d.x / l1, d.y / l1);
  if (d.z < 0) p = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y)};
  return 0.5f * p + 0.5f;
}

/// Unit direction of a place in [0, 1]².
inline vec3 from_octahedral(const vec2& place) {
  const auto sign = [](float x) { return x < 0 ? -1.0f : 1.0f; };
  const vec2 p = 2.0f * place - 1.0f;
  vec3 d(p, 1 - std::abs(p.x) - std::abs(p.y));
  if (d.z < 0) d = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y), d.z};
  return glm::normalize(d);
}

/// Direction of the centre of texel i of an n×n map, row by row.
inline vec3 octahedral_texel(int i, int n) {
  const auto size = static_cast<float>(n);
  return from_octahedral(
      {(static_cast<float>(i % n) + 0.5f) / size, (static_cast<float>(i / n) + 0.5f) / size});
}

/// The four texels around a direction and their bilinear weights.
struct TexelBlend {
  std::array<int, 4> texel;
  std::array<float, 4> weight;
};

/// On an n×n map. Across an edge lies the same edge mirrored about its middle, so that no border is stored.
inline TexelBlend blend_texels(const vec3& direction, int n) {
  const vec2 p = octahedral(direction) * static_cast<float>(n) - 0.5f;
  const vec2 low = glm::floor(p), f = p - low;
  const auto texel = [n](int x, int y) {
    if (x < 0 || x >= n) x = x < 0 ? 0 : n - 1, y = n - 1 - y;
    if (y < 0 || y >= n) y = y < 0 ? 0 : n - 1, x = n - 1 - x;
    return y * n + x;
  };
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  return {{texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1)},
          {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

}  // namespace ssphh::methods::ddgi
