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

  /// u, v in texels, with texel centres at half-integers.
  BilinearTap(float u, float v) {
    const float x0 = std::floor(u - 0.5f), y0 = std::floor(v - 0.5f);
    x = static_cast<int>(x0), y = static_cast<int>(y0);
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
