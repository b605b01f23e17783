#pragma once
/// Functions on the sphere as square tiles: the octahedral map with a border of one texel, so that bilinear
/// filters find their neighbours within the tile.

#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::realtime {

/// Values of spherical harmonics at a tile's texels: what turns coefficients into a tile.
class TileBasis {
 public:
  TileBasis() = default;
  /// `size` texels along a side without the border.
  TileBasis(int size, int degree);
  int side() const { return size_ + 2; }
  std::size_t texels() const { return static_cast<std::size_t>(side()) * static_cast<std::size_t>(side()); }

  /// out[texel] = max(Σ_k factor(l) c_k Y_k, 0) with one factor per band; missing coefficients count as 0.
  void evaluate(std::span<const vec3> coefficients, std::span<const float> band_factors,
                std::span<vec4> out) const;

 private:
  int size_ = 0, degree_ = 0;
  std::vector<float> basis_;  ///< [k][texel]
};

}  // namespace ssphh::realtime
