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

constexpr float relative_offset = 0.01f;

/// The function of probe i that lights surfaces.
sh::RadianceSh chosen_light(const ProbeSet& set, std::size_t i, ProbeLayer layer, ProbeLight light) {
  const Probe& probe = set.probes[i];
  if (layer == ProbeLayer::neighbor) return set.hierarchy->neighbor[i];
  sh::RadianceSh own = light == ProbeLight::reflected ? probe.reflected : probe.self;
  if (layer == ProbeLayer::sum) own += set.hierarchy->neighbor[i];
  return own;
}

/// Median distance of a probe to its nearest neighbour; infinite for one probe.
float median_spacing(const std::vector<vec3>& positions) {
  std::vector<float> nearest(positions.size(), std::numeric_limits<float>::infinity());
  parallel_for(positions.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = 0; j < positions.size(); ++j) {
        const float d = glm::distance(positions[i], positions[j]);
        if (j != i && d > 0) nearest[i] = std::min(nearest[i], d);
      }
    }
  });
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

}  // namespace

ProbeTable::ProbeTable(const ProbeSet& set, const scene::RadianceSource& source, const LookupParams& params)
    : source_(source),
      radiance_degree_(set.degree),
      irradiance_degree_(std::clamp(params.irradiance_degree, 0, set.degree)),
      blend_count_(std::clamp(params.nearest, 1, max_near)),
      offset_(params.normal_offset) {
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
  offset_limit_ = relative_offset * median_spacing(positions_);
}

int ProbeTable::nearest(const vec3& x, int wanted, NearList& near) const {
  int count = 0;
  float farthest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const vec3 to = positions_[i] - x;
    const float d2 = glm::dot(to, to);
    if (!(d2 < farthest)) continue;
    // Insert; the last one falls out of a full list.
    int at = count < wanted ? count++ : wanted - 1;
    for (; at > 0 && near[static_cast<std::size_t>(at - 1)].distance2 > d2; --at) {
      near[static_cast<std::size_t>(at)] = near[static_cast<std::size_t>(at - 1)];
    }
    near[static_cast<std::size_t>(at)] = {d2, static_cast<int>(i)};
    if (count == wanted) farthest = near[static_cast<std::size_t>(count - 1)].distance2;
  }
  return count;
}

bool ProbeTable::sees(const Near& near, const vec3& x, const vec3& n) const {
  const float offset =
      offset_ > 0 ? offset_ : std::min(relative_offset * std::sqrt(near.distance2), offset_limit_);
  return source_.visible(x + offset * n, position(near.probe));
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
