#include "group_light.h"

#include <algorithm>

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
  const auto windows_of = [&](const std::vector<sh::RadianceSh>& sum) {
    std::vector<sh::BandScales> windows(sum.size());
    parallel_for(sum.size(), 4, [&](std::size_t i) {
      windows[i] = sh::lanczos_window(sh::choose_window(shortened(sum[i])).width);
    });
    return windows;
  };
  const std::vector<sh::BandScales> windows = windows_of(probes::surface_light(set, {})),
                                    windows_beside = windows_of(probes::light_beside_records(set));
  const std::vector<std::string> beside = probes::mirrored_groups(set);
  std::vector<std::vector<sh::IrradianceSh>> out;
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
    const std::vector<sh::RadianceSh> light = light_of_group(set, g);
    const bool off = set.light_groups[g].scale == vec3(0);
    const auto irradiance_of = [&](const sh::RadianceSh& whole, const sh::BandScales& window) {
      const sh::RadianceSh own = shortened(whole);
      return sh::irradiance_from_radiance(off ? sh::dering(own) : sh::apply_window(own, window));
    };
    const bool seen_too = std::ranges::find(beside, set.light_groups[g].name) != beside.end();
    std::vector<sh::IrradianceSh>& irradiance = out.emplace_back(light.size());
    parallel_for(light.size(), 4, [&](std::size_t i) {
      irradiance[i] = irradiance_of(light[i], windows[i]);
      const sh::RadianceSh& emitted = set.probes[i].groups[g].emitted;
      if (!seen_too || emitted.empty()) return;
      const sh::IrradianceSh more = irradiance_of(emitted, windows_beside[i]);
      for (std::size_t k = 0; k < more.values.size(); ++k) irradiance[i].values[k] += more.values[k];
    });
  }
  return out;
}

}  // namespace ssphh::cook
