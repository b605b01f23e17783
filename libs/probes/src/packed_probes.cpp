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
    : params_(params),
      light_(surface_light(set, params)),
      radiance_(set.probes.size(), set.degree),
      irradiance_(set.probes.size(), irradiance_degree(params, set.degree)) {
  for (const Probe& probe : set.probes) positions_.push_back(probe.position);
  pack(of_moving);
}

void PackedProbes::swap_light(const ProbeSet& set, std::span<const sh::RadianceSh> of_moving) {
  require(set.degree == radiance_.degree && set.probes.size() == positions_.size(), "probe lookup",
          "the new light is of other probes");
  for (std::size_t i = 0; i < positions_.size(); ++i)
    require(set.probes[i].position == positions_[i], "probe lookup", "the new light is of other probes");
  surface_light(set, params_, light_);
  pack(of_moving);
}

void PackedProbes::pack(std::span<const sh::RadianceSh> of_moving) {
  const auto irradiance_count = static_cast<std::size_t>(sh::coefficient_count(irradiance_.degree));
  if (of_moving.empty()) {
    more_of_moving_.reset();
  } else if (!more_of_moving_) {
    more_of_moving_.emplace(positions_.size(), irradiance_.degree);
  }
  light_of_moving_.assign(of_moving.begin(), of_moving.end());
  const auto set_irradiance = [&](Functions& functions, std::size_t i, sh::RadianceSh& light) {
    light.values.resize(irradiance_count);
    if (params_.dering)
      sh::window_in_place(light,
                          sh::lanczos_window(sh::choose_window(light, sh::NonNegative::irradiance).width));
    for (int l = 0; l <= irradiance_.degree; ++l) {
      for (int k = sh::coefficient_index(l, -l); k <= sh::coefficient_index(l, l); ++k)
        light[k] *= static_cast<float>(sh::cosine_band_factor(l));
    }
    functions.set(i, light.values);
  };
  parallel_for(positions_.size(), 4, [&](std::size_t i) {
    radiance_.set(i, light_[i].values);
    set_irradiance(irradiance_, i, light_[i]);
    if (more_of_moving_) set_irradiance(*more_of_moving_, i, light_of_moving_[i]);
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
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) basis[k] *= scales[l];
  }
}

}  // namespace ssphh::probes
