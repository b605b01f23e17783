#pragma once
/// The four texels around a place and their weights.

#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::image {

/// Texels (x, y), (x+1, y), (x, y+1), (x+1, y+1) may lie outside the image: the caller's fetch says what is
/// there.
struct BilinearTap {
  int x, y;
  float fx, fy;

  /// u, v in texels, with texel centres at half-integers. A place that is not a number gives weights that are
  /// none.
  BilinearTap(float u, float v) {
    const float x0 = std::floor(u - 0.5f), y0 = std::floor(v - 0.5f);
    const auto texel = [](float place) { return std::abs(place) < 1e9f ? static_cast<int>(place) : 0; };
    x = texel(x0), y = texel(y0);
    fx = u - 0.5f - x0, fy = v - 0.5f - y0;
  }
};

/// Σ weight·fetch(x, y), fetch returning a colour.
template <class Fetch>
vec3 bilinear(const BilinearTap& tap, const Fetch& fetch) {
  return (1 - tap.fy) * ((1 - tap.fx) * fetch(tap.x, tap.y) + tap.fx * fetch(tap.x + 1, tap.y)) +
         tap.fy * ((1 - tap.fx) * fetch(tap.x, tap.y + 1) + tap.fx * fetch(tap.x + 1, tap.y + 1));
}

}  // namespace ssphh::image
