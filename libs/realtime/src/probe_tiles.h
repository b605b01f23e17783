#pragma once
/// Light of probes as the texels of tiles (tile_basis.h): plain data, whoever draws with it.

#include <vector>

#include <ssphh/sh/irradiance.h>

#include "gpu_types.h"
#include "tile_basis.h"

namespace ssphh::realtime {

/// Texels of a tile's side. The tests bound what interpolation errs in each band; irradiance has little of
/// the higher ones, and so has what a rough surface mirrors.
inline constexpr int irradiance_tile = 24, radiance_tile = 30;

/// E(n) as lookups have it: of the bands that they keep, nowhere negative.
class IrradianceTiles {
 public:
  IrradianceTiles() = default;
  IrradianceTiles(int degree, bool dering);

  std::size_t texels() const { return basis_.texels(); }
  /// Coefficients of a function.
  std::size_t count() const { return count_; }
  /// Fills the tile with the irradiance of `light`, of any degree, and returns its coefficients.
  sh::IrradianceSh make(sh::RadianceSh light, std::span<vec4> tile) const;

 private:
  std::size_t count_ = 1;
  bool dering_ = true;
  TileBasis basis_;
};

/// L(ω) as surfaces mirror it that are rough by radiance_roughness, a tile for each.
class RadianceTiles {
 public:
  RadianceTiles() = default;
  RadianceTiles(int degree, int levels);

  int levels() const { return static_cast<int>(scales_.size()); }
  std::size_t texels() const { return basis_.texels(); }
  /// Fills the tile of `light` at radiance_roughness[level].
  void make(const sh::RadianceSh& light, int level, std::span<vec4> tile) const;

 private:
  TileBasis basis_;
  std::vector<std::array<float, sh::max_degree + 1>> scales_;  ///< of bands, at each level
};

}  // namespace ssphh::realtime
