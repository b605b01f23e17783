#pragma once
/// Irradiance as an octahedral map (ssphh/core/octahedral.h).

#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// What turns coefficients of one degree into a map and back.
class IrradianceMap {
 public:
  /// side × side texels, row by row: (degree + 1)² or more.
  IrradianceMap(int side, int degree);
  int side() const { return side_; }

  /// E [W m⁻²] along the texels' centres.
  std::vector<vec3> texels(const RadianceSh& radiance) const;

  /// The radiance whose irradiance is nearest, in least squares. What irradiance does not have is 0: band 3.
  RadianceSh radiance(std::span<const vec3> texels) const;

 private:
  int side_, degree_;
  std::vector<double> to_texels_;    ///< [texel][k]
  std::vector<double> from_texels_;  ///< [k][texel]
};

}  // namespace ssphh::sh
