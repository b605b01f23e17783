#include "probe_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ssphh/core/parallel.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::gi {
namespace {

/// The function of probe i that lights surfaces.
sh::RadianceSh chosen_light(const ProbeSet& set, std::size_t i, ProbeLayer layer, ProbeLight light) {
  const Probe& probe = set.probes[i];
  if (layer == ProbeLayer::neighbor) return set.hierarchy->neighbor[i];
  sh::RadianceSh own = light == ProbeLight::reflected ? probe.reflected : probe.self;
  if (layer == ProbeLayer::sum) own += set.hierarchy->neighbor[i];
  return own;
}

}  // namespace

ProbeTable::ProbeTable(const ProbeSet& set, const LookupParams& params)
    : radiance_degree_(set.degree), irradiance_degree_(std::clamp(params.irradiance_degree, 0, set.degree)) {
  if (set.probes.empty()) throw Error("probe lookup", "the probe set is empty", "bake a scene with SPHLs");
  const ProbeLayer layer = params.layer.value_or(set.hierarchy ? ProbeLayer::sum : ProbeLayer::self);
  if (layer != ProbeLayer::self && !set.hierarchy) {
    throw Error("probe lookup", "the probe set has no hierarchy", "run `ssphh hier` on the file first");
  }

  // Lay the functions out probe after probe.
  const auto radiance_count = static_cast<std::size_t>(sh::coefficient_count(radiance_degree_));
  const auto irradiance_count = static_cast<std::size_t>(sh::coefficient_count(irradiance_degree_));
  radiance_.resize(set.probes.size() * radiance_count);
  irradiance_.resize(set.probes.size() * irradiance_count);
  for (const Probe& probe : set.probes) positions_.push_back(probe.position);
  parallel_for(set.probes.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sh::RadianceSh light = chosen_light(set, i, layer, params.light);
      std::copy(light.values.begin(), light.values.end(),
                radiance_.begin() + static_cast<std::ptrdiff_t>(i * radiance_count));
      light.values.resize(irradiance_count);
      if (params.dering) light = sh::dering(light, sh::NonNegative::irradiance);
      const sh::IrradianceSh e = sh::irradiance_from_radiance(light);
      std::copy(e.values.begin(), e.values.end(),
                irradiance_.begin() + static_cast<std::ptrdiff_t>(i * irradiance_count));
    }
  });
}

vec3 ProbeTable::dot(const std::vector<vec3>& functions, int probe, const float* basis, int degree) {
  const auto count = static_cast<std::size_t>(sh::coefficient_count(degree));
  const vec3* f = functions.data() + static_cast<std::size_t>(probe) * count;
  vec3 sum(0);
  for (std::size_t k = 0; k < count; ++k) sum += f[k] * basis[k];
  return glm::max(sum, vec3(0));
}

void ProbeTable::irradiance_basis(const vec3& n, Basis& basis) const {
  sh::eval_basis(irradiance_degree_, n, basis);
}

void ProbeTable::radiance_basis(const vec3& direction, Basis& basis) const {
  sh::eval_basis(radiance_degree_, direction, basis);
}

void ProbeTable::glossy_basis(const vec3& direction, float roughness, Basis& basis) const {
  radiance_basis(direction, basis);
  const auto scales = sh::glossy_band_scales(roughness);
  for (int l = 0; l <= radiance_degree_; ++l) {
    for (int k = l * l; k < (l + 1) * (l + 1); ++k)
      basis[static_cast<std::size_t>(k)] *= scales[static_cast<std::size_t>(l)];
  }
}

}  // namespace ssphh::gi
