#pragma once
/// Small sets of probes that are as they should be, to be spoilt.

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::test {

/// Three probes on a line, of which each has light of its own: E differs in place and colour.
inline probes::ProbeSet sound_set(int degree = 2) {
  probes::ProbeSet set;
  set.degree = degree;
  set.light_groups = {{"lamp", vec3(1)}};
  for (int i = 0; i < 3; ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = "probe " + std::to_string(i);
    probe.position = vec3(static_cast<float>(i), 0, 0);
    sh::RadianceSh reflected(degree), emitted(degree);
    reflected[0] = vec3(1, 2, 3) * static_cast<float>(i + 1);
    emitted[0] = vec3(0.5f, 0.25f, 0.125f);
    probe.groups.push_back({emitted, reflected});
  }
  probes::merge_groups(set);
  return set;
}

/// The same with an edge 1 ← 0 and its hierarchy's input.
inline probes::ProbeSet linked_set() {
  probes::ProbeSet set = sound_set();
  probes::Edge& edge = set.probes[1].edges.emplace_back();
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
inline std::unique_ptr<probes::IrradianceLookup> lookup_of(const probes::ProbeSet& set,
                                                           const probes::LookupParams& params = {}) {
  std::vector<vec3> places;
  for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
  return std::make_unique<probes::IrradianceLookup>(
      set, probes::make_weights(places, all_seen, params.weights), params);
}

}  // namespace ssphh::test
