#pragma once
/// Small sets of probes that are as they should be, to be spoilt.

#include <ssphh/gi/lookup.h>
#include <ssphh/gi/probe_set.h>

namespace ssphh::test {

/// Three probes on a line, of which each has light of its own: E differs in place and colour.
inline gi::ProbeSet sound_set(int degree = 2) {
  gi::ProbeSet set;
  set.degree = degree;
  set.light_groups = {{"lamp", vec3(1)}};
  for (int i = 0; i < 3; ++i) {
    gi::Probe& probe = set.probes.emplace_back();
    probe.name = "probe " + std::to_string(i);
    probe.position = vec3(static_cast<float>(i), 0, 0);
    sh::RadianceSh reflected(degree), emitted(degree);
    reflected[0] = vec3(1, 2, 3) * static_cast<float>(i + 1);
    emitted[0] = vec3(0.5f, 0.25f, 0.125f);
    probe.groups.push_back({emitted, reflected});
  }
  gi::merge_groups(set);
  return set;
}

/// The same with an edge 1 ← 0 and its hierarchy's input.
inline gi::ProbeSet linked_set() {
  gi::ProbeSet set = sound_set();
  gi::Edge& edge = set.probes[1].edges.emplace_back();
  edge.from = 0;
  edge.transfer = 0.5f;
  edge.h = sh::RadianceSh(set.degree);
  edge.h[0] = vec3(0.5f, 0.4f, 0.3f);
  edge.matrix = sh::TransferMatrix(set.degree, set.degree);
  return set;
}

/// Nothing is in the way.
inline bool all_seen(const vec3&, const vec3&) {
  return true;
}

/// A lookup with weights that need no scene.
inline std::unique_ptr<gi::IrradianceLookup> lookup_of(const gi::ProbeSet& set,
                                                       const gi::LookupParams& params = {}) {
  std::vector<vec3> places;
  for (const gi::Probe& probe : set.probes) places.push_back(probe.position);
  return std::make_unique<gi::IrradianceLookup>(set, gi::make_weights(places, all_seen, params.weights),
                                                params);
}

}  // namespace ssphh::test
