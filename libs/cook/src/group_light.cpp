#include "group_light.h"

#include <ssphh/core/parallel.h>
#include <ssphh/probes/hier.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

namespace ssphh::cook {
namespace {

/// Light of one group at scale 1.
std::vector<sh::RadianceSh> light_of_group(const probes::ProbeSet& set, std::size_t group) {
  probes::ProbeSet one;
  one.degree = set.degree;
  one.generator = set.generator;
  one.light_groups = set.light_groups;
  for (std::size_t g = 0; g < one.light_groups.size(); ++g) one.light_groups[g].scale = vec3(g == group);
  for (const probes::Probe& probe : set.probes) {
    probes::Probe& copy = one.probes.emplace_back();
    copy.position = probe.position;
    copy.groups = probe.groups;
    if (set.hierarchy) copy.edges = probe.edges;
  }
  probes::merge_groups(one);
  if (set.hierarchy)
    probes::hier(one, {set.hierarchy->op, set.hierarchy->neighbors, set.hierarchy->threshold});
  return probes::surface_light(one, {});
}

}  // namespace

std::vector<std::vector<sh::IrradianceSh>> group_irradiance(const probes::ProbeSet& set, int degree) {
  const auto count = static_cast<std::size_t>(sh::coefficient_count(degree));
  const auto shortened = [count](sh::RadianceSh light) {
    light.values.resize(count);
    return light;
  };
  std::vector<sh::RadianceSh> sum = probes::surface_light(set, {});
  std::vector<sh::BandScales> windows(sum.size());
  parallel_for(sum.size(), 4, [&](std::size_t i) {
    windows[i] = sh::lanczos_window(sh::choose_window(shortened(sum[i])).width);
  });
  std::vector<std::vector<sh::IrradianceSh>> out;
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
    const std::vector<sh::RadianceSh> light = light_of_group(set, g);
    const bool off = set.light_groups[g].scale == vec3(0);
    std::vector<sh::IrradianceSh>& irradiance = out.emplace_back(light.size());
    parallel_for(light.size(), 4, [&](std::size_t i) {
      const sh::RadianceSh own = shortened(light[i]);
      irradiance[i] = sh::irradiance_from_radiance(off ? sh::dering(own) : sh::apply_window(own, windows[i]));
    });
  }
  return out;
}

}  // namespace ssphh::cook
