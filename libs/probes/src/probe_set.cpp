#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {
namespace {

void add_scaled(sh::RadianceSh& sum, const sh::RadianceSh& term, const vec3& scale) {
  for (std::size_t k = 0; k < term.values.size(); ++k) sum.values[k] += scale * term.values[k];
}

/// Whether the groups can be merged.
void check_groups(const ProbeSet& set) {
  sh::require_degree(set.degree, "probe set");
  const auto count = static_cast<std::size_t>(sh::coefficient_count(set.degree));
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const std::vector<GroupLight>& groups = set.probes[i].groups;
    if (groups.size() > set.light_groups.size())
      throw Error(fmt::format("probe {}", i), fmt::format("has the light of {} groups; the set has {}",
                                                          groups.size(), set.light_groups.size()));
    for (const GroupLight& light : groups) {
      for (const sh::RadianceSh* f : {&light.emitted, &light.reflected}) {
        if (!f->empty() && f->values.size() != count)
          throw Error(fmt::format("probe {}", i), fmt::format("has {} RGB coefficients; degree {} has {}",
                                                              f->values.size(), set.degree, count));
      }
    }
  }
  if (set.surface) require_whole(*set.surface, set.light_groups.size());
}

}  // namespace

ProbeSet dark_set(std::span<const scene::ProbePlace> places, int degree) {
  if (degree < 0 || degree > sh::max_degree)
    throw Error(fmt::format("degree {}", degree), fmt::format("the degree must be 0..{}", sh::max_degree));
  ProbeSet set;
  set.degree = degree;
  for (const scene::ProbePlace& place : places) {
    if (!is_finite(place.position) || !std::isfinite(place.radius) || place.radius <= 0)
      throw Error(fmt::format("SPHL \"{}\"", place.name),
                  "its position must be finite and its radius positive");
    Probe& probe = set.probes.emplace_back();
    probe.name = place.name.substr(0, limits::text);
    probe.position = place.position;
    probe.radius = place.radius;
  }
  return set;
}

float emitter_radiance(VizSource source, float radius) {
  return source == VizSource::intensity ? 1 / (pi * radius * radius) : 1;
}

void merge_groups(ProbeSet& set) {
  check_groups(set);
  if (set.surface) {
    std::vector<vec3> scales;
    std::vector<bool> with_direct;
    for (const LightGroup& group : set.light_groups) {
      scales.push_back(group.scale);
      with_direct.push_back(scene::keeps_direct(group.mode));
    }
    merge_groups(*set.surface, scales, with_direct);
  }
  for (Probe& probe : set.probes) {
    probe.reflected = sh::RadianceSh(set.degree);
    probe.self = sh::RadianceSh(set.degree);
    for (std::size_t g = 0; g < probe.groups.size(); ++g) {
      const LightGroup& group = set.light_groups[g];
      add_scaled(probe.reflected, probe.groups[g].reflected, group.scale);
      const bool looked_up = group.mode == scene::LightMode::baked;
      add_scaled(looked_up ? probe.reflected : probe.self, probe.groups[g].emitted, group.scale);
    }
    probe.self += probe.reflected;
  }
}

void relight(ProbeSet& set, const std::string& group, const vec3& scale) {
  if (!is_finite(scale) || glm::any(glm::lessThan(scale, vec3(0))) || max_component(scale) > limits::scale) {
    throw Error("light group \"" + group + "\"", "its scale must be three numbers in 0..1e6");
  }
  std::string known;
  for (LightGroup& candidate : set.light_groups) {
    known += (known.empty() ? "\"" : ", \"") + candidate.name + "\"";
    if (candidate.name != group) continue;
    check_groups(set);
    candidate.scale = scale;
    merge_groups(set);
    set.hierarchy.reset();
    return;
  }
  throw Error("light group \"" + group + "\"", "no such group in the probe set",
              known.empty() ? "the set has no light groups" : "there are: " + known);
}

std::vector<std::string> baked_groups(const ProbeSet& set) {
  std::vector<std::string> names;
  for (const LightGroup& group : set.light_groups) {
    if (group.mode == scene::LightMode::baked) names.push_back(group.name);
  }
  return names;
}

namespace {

/// Whether the records keep direct light of a group that mirrors show themselves.
bool is_mirrored(const ProbeSet& set, std::size_t g) {
  return set.light_groups[g].mode == scene::LightMode::diffuse && set.surface && set.surface->keeps_direct(g);
}

}  // namespace

std::vector<std::string> mirrored_groups(const ProbeSet& set) {
  std::vector<std::string> names;
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
    if (is_mirrored(set, g)) names.push_back(set.light_groups[g].name);
  }
  return names;
}

std::vector<sh::RadianceSh> light_beside_records(const ProbeSet& set) {
  std::vector<sh::RadianceSh> light;
  light_beside_records(set, light);
  return light;
}

void light_beside_records(const ProbeSet& set, std::vector<sh::RadianceSh>& light) {
  bool any = false;
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) any |= is_mirrored(set, g);
  light.resize(any ? set.probes.size() : 0);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Probe& probe = set.probes[i];
    light[i].values.assign(static_cast<std::size_t>(sh::coefficient_count(set.degree)), vec3(0));
    for (std::size_t g = 0; g < probe.groups.size(); ++g) {
      if (is_mirrored(set, g)) add_scaled(light[i], probe.groups[g].emitted, set.light_groups[g].scale);
    }
  }
}

std::size_t edge_count(const ProbeSet& set) {
  std::size_t count = 0;
  for (const Probe& probe : set.probes) count += probe.edges.size();
  return count;
}

float transfer_coefficient(const sh::RadianceSh& h) {
  return luminance(sh::mean(h));
}

}  // namespace ssphh::probes
