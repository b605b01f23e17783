#pragma once
/// Directions uniform in solid angle over one texel of a cube map.

#include <ssphh/core/math.h>

namespace ssphh::trace {

/// Area-preserving map from the unit square to the texel's spherical rectangle (Ureña, Fajardo & King, An
/// Area-Preserving Parametrization for Spherical Rectangles, EGSR 2013). Double precision: texels are small.
class TexelSampler {
 public:
  TexelSampler(int face, int x, int y, int size);

  /// Unit direction for u in [0, 1)².
  vec3 direction(const vec2& u) const;
  /// [sr]
  double solid_angle() const { return solid_angle_; }

 private:
  int face_;
  double x0_, x1_, y0_, y1_;  ///< on the plane at distance 1
  double b0_, b1_, k_, solid_angle_;
};

}  // namespace ssphh::trace
