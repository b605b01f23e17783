#include <algorithm>
#include <array>
#include <vector>

#include <ssphh/probes/compact.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/quadrature.h>
#include <ssphh/sh/reconstruct.h>

namespace ssphh::probes {
namespace {

void keep_bands(sh::RadianceSh& f, int degree) {
  if (f.degree() > degree) f.values.resize(static_cast<std::size_t>(sh::coefficient_count(degree)));
}

/// Directions of equal solid angle.
std::vector<vec3> even_directions() {
  constexpr int side = 8;
  std::vector<vec3> directions;
  for (const glm::dvec3& d : sh::stratified_sphere_samples(side, 1).directions) directions.emplace_back(d);
  return directions;
}

}  // namespace

ProbeSet compacted(const ProbeSet& set, int degree) {
  require(degree >= 0 && degree <= set.degree, "compact probes",
          "the degree must be from 0 to that of the set");
  ProbeSet result = set;
  result.degree = degree;
  result.baseline.reset();
  for (Probe& probe : result.probes) {
    probe.edges.clear();
    for (GroupLight& light : probe.groups)
      keep_bands(light.emitted, degree), keep_bands(light.reflected, degree);
  }
  if (result.hierarchy) {
    for (sh::RadianceSh& f : result.hierarchy->neighbor) keep_bands(f, degree);
    for (sh::RadianceSh& f : result.hierarchy->sum) keep_bands(f, degree);
  }
  merge_groups(result);
  return result;
}

IrradianceLoss irradiance_loss(const ProbeSet& set, const ProbeSet& packed) {
  require(set.probes.size() == packed.probes.size(), "irradiance loss", "the sets have other probes");
  const std::vector<vec3> directions = even_directions();
  IrradianceLoss loss;
  std::array<std::vector<float>, 3> errors;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const sh::IrradianceSh before = sh::irradiance_from_radiance(set.probes[i].reflected);
    const sh::IrradianceSh after = sh::irradiance_from_radiance(packed.probes[i].reflected);
    const vec3 channels = pi * sh::mean(set.probes[i].reflected);
    const float mean = (channels.x + channels.y + channels.z) / 3;
    if (!(mean > 0)) {
      ++loss.dark;
      continue;
    }
    for (const vec3& n : directions) {
      const vec3 error = glm::abs(sh::eval(after, n) - sh::eval(before, n)) / mean;
      for (int c = 0; c < 3; ++c) errors[c].push_back(error[c]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& all = errors[c];
    if (all.empty()) continue;
    std::ranges::sort(all);
    double sum = 0;
    for (const float e : all) sum += static_cast<double>(e);
    loss.mean[c] = static_cast<float>(sum / static_cast<double>(all.size()));
    loss.most_of_95[c] = all[(all.size() * 95 + 99) / 100 - 1];
    loss.largest[c] = all.back();
  }
  return loss;
}

}  // namespace ssphh::probes
