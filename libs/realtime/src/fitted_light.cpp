#include "fitted_light.h"

#include <algorithm>
#include <array>

#include <ssphh/sh/evaluate.h>

namespace ssphh::realtime {

FittedLight::FittedLight(const probes::FittedSurfaces& surfaces, int probe_count)
    : points_{surfaces.surfaces.points, surfaces.weights} {
  probes::require_whole(points_, static_cast<std::size_t>(probe_count));
  first_of_probe_.assign(static_cast<std::size_t>(probe_count) + 1, 0);
  for (const probes::PointWeights& weights : points_.weights) {
    for (const probes::ProbeWeight& weight : weights.used())
      ++first_of_probe_[static_cast<std::size_t>(weight.probe) + 1];
  }
  for (std::size_t p = 0; p + 1 < first_of_probe_.size(); ++p) first_of_probe_[p + 1] += first_of_probe_[p];
  lit_by_.resize(first_of_probe_.back());
  std::vector<std::size_t> next = first_of_probe_;
  for (std::size_t i = 0; i < points_.points.size(); ++i) {
    for (const probes::ProbeWeight& weight : points_.weights[i].used())
      lit_by_[next[weight.probe]++] = static_cast<std::uint32_t>(i);
  }
  marked_.assign(points_.points.size(), 0);
}

void FittedLight::update(std::span<const int> probes, std::span<const vec3> irradiance, std::size_t count,
                         SurfaceLight& light, FrameCounters& counters) {
  changed_.clear();
  for (const int probe : probes) {
    const auto p = static_cast<std::size_t>(probe);
    for (std::size_t i = first_of_probe_[p]; i < first_of_probe_[p + 1]; ++i) {
      if (marked_[lit_by_[i]]) continue;
      marked_[lit_by_[i]] = 1;
      changed_.push_back(lit_by_[i]);
    }
  }
  for (const std::uint32_t point : changed_) marked_[point] = 0;
  std::sort(changed_.begin(), changed_.end());
  light.update(
      changed_, [&](std::uint32_t point) { return evaluate(point, irradiance, count); }, counters);
}

SurfaceLight::Coefficients FittedLight::evaluate(std::size_t point, std::span<const vec3> irradiance,
                                                 std::size_t count) const {
  std::array<vec3, 25> sum{};
  for (const probes::ProbeWeight& weight : points_.weights[point].used()) {
    const vec3* e = irradiance.data() + static_cast<std::size_t>(weight.probe) * count;
    for (std::size_t k = 0; k < count; ++k) sum[k] += weight.weight * e[k];
  }
  std::array<float, 25> basis;
  sh::eval_basis(4, points_.points[point].normal, basis);
  constexpr std::size_t low_bands = 9;
  SurfaceLight::Coefficients kept;
  std::copy_n(sum.begin(), low_bands, kept.begin());
  kept[low_bands] = vec3(0);
  for (std::size_t k = low_bands; k < count; ++k) kept[low_bands] += basis[k] * sum[k];
  return kept;
}

}  // namespace ssphh::realtime
