#include "packed_probes.h"

#include <algorithm>

#include <ssphh/core/parallel.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::probes {

int irradiance_degree(const LookupParams& params, int set_degree) {
  return std::clamp(params.irradiance_degree, 0, std::min(set_degree, max_irradiance_degree));
}

PackedProbes::PackedProbes(const ProbeSet& set, const LookupParams& params,
                           std::span<const sh::RadianceSh> of_moving)
    : PackedProbes(set, surface_light(set, params), params, of_moving) {}

PackedProbes::PackedProbes(const ProbeSet& set, std::vector<sh::RadianceSh> lights,
                           const LookupParams& params, std::span<const sh::RadianceSh> of_moving)
    : radiance_(set.probes.size(), set.degree),
      irradiance_(set.probes.size(), irradiance_degree(params, set.degree)) {
  const auto irradiance_count = static_cast<std::size_t>(sh::coefficient_count(irradiance_.degree));
  for (const Probe& probe : set.probes) positions_.push_back(probe.position);
  if (!of_moving.empty()) more_of_moving_.emplace(set.probes.size(), irradiance_.degree);
  const auto set_irradiance = [&](Functions& functions, std::size_t i, sh::RadianceSh light) {
    light.values.resize(irradiance_count);
    if (params.dering) light = sh::dering(light, sh::NonNegative::irradiance);
    functions.set(i, sh::irradiance_from_radiance(light).values);
  };
  parallel_for(set.probes.size(), 4, [&](std::size_t i) {
    radiance_.set(i, lights[i].values);
    set_irradiance(irradiance_, i, std::move(lights[i]));
    if (more_of_moving_) set_irradiance(*more_of_moving_, i, of_moving[i]);
  });
}

PackedProbes::Functions::Functions(std::size_t probes, int d)
    : degree(d),
      stride(whole_lanes(static_cast<std::size_t>(sh::coefficient_count(d)))),
      values(probes * 3 * stride, 0.0f) {}

void PackedProbes::Functions::set(std::size_t probe, std::span<const vec3> coefficients) {
  float* f = values.data() + probe * 3 * stride;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) f[c * stride + k] = coefficients[k][static_cast<glm::length_t>(c)];
  }
}

vec3 PackedProbes::Functions::dot(int probe, const float* basis) const {
  const float* f = values.data() + static_cast<std::size_t>(probe) * 3 * stride;
  std::array<std::array<float, packed_lanes>, 3> sums{};
  for (std::size_t k = 0; k < stride; k += packed_lanes) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < packed_lanes; ++i) sums[c][i] += f[c * stride + k + i] * basis[k + i];
    }
  }
  vec3 sum(0);
  for (std::size_t i = 0; i < packed_lanes; ++i) sum += vec3(sums[0][i], sums[1][i], sums[2][i]);
  return glm::max(sum, vec3(0));
}

void PackedProbes::irradiance_basis(const vec3& n, Basis& basis) const {
  basis.fill(0);
  sh::eval_basis(irradiance_.degree, n, basis);
}

void PackedProbes::radiance_basis(const vec3& direction, Basis& basis) const {
  basis.fill(0);
  sh::eval_basis(radiance_.degree, direction, basis);
}

void PackedProbes::glossy_basis(const vec3& direction, float roughness, Basis& basis) const {
  radiance_basis(direction, basis);
  const auto scales = sh::glossy_band_scales(roughness);
  for (int l = 0; l <= radiance_.degree; ++l) {
    for (int k = l * l; k < (l + 1) * (l + 1); ++k)
      basis[static_cast<std::size_t>(k)] *= scales[static_cast<std::size_t>(l)];
  }
}

}  // namespace ssphh::probes
