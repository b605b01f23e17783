#pragma once
/// Bilinear lookups in octahedral maps.

#include <array>

#include <ssphh/core/octahedral.h>

namespace ssphh::methods::ddgi {

/// The four texels around a direction and their bilinear weights.
struct TexelBlend {
  std::array<int, 4> texel;
  std::array<float, 4> weight;
};

/// On an n×n map. Across an edge lies the same edge mirrored about its middle, so that no border is stored.
inline TexelBlend blend_texels(const vec3& direction, int n) {
  const vec2 p = (0.5f * octahedral_place(direction) + 0.5f) * static_cast<float>(n) - 0.5f;
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
