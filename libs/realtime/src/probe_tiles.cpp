#include "probe_tiles.h"

#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::realtime {
namespace {

constexpr std::array<float, sh::max_degree + 1> ones = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

}  // namespace

IrradianceTiles::IrradianceTiles(int degree, bool dering)
    : count_(static_cast<std::size_t>(sh::coefficient_count(degree))),
      dering_(dering),
      basis_(irradiance_tile, degree) {}

sh::IrradianceSh IrradianceTiles::make(sh::RadianceSh light, std::span<vec4> tile) const {
  light.values.resize(count_, vec3(0));
  if (dering_) light = sh::dering(light, sh::NonNegative::irradiance);
  sh::IrradianceSh irradiance = sh::irradiance_from_radiance(light);
  basis_.evaluate(irradiance.values, ones, tile);
  return irradiance;
}

RadianceTiles::RadianceTiles(int degree, int levels) : basis_(radiance_tile, degree) {
  for (int level = 0; level < levels; ++level)
    scales_.push_back(sh::glossy_band_scales(radiance_roughness[level]));
}

void RadianceTiles::make(const sh::RadianceSh& light, int level, std::span<vec4> tile) const {
  basis_.evaluate(light.values, scales_[level], tile);
}

}  // namespace ssphh::realtime
