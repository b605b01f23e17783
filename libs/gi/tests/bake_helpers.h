#pragma once
/// Small sets and bakes for the tests of GEN, VIZ and what drives them.

#include <ssphh/gi/bake.h>

#include "fake_source.h"

namespace ssphh::gi {

inline const std::vector<vec3> four_places = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.7f, 0}, {0.1f, 0.2f, 0.9f}};

inline ProbeSet places(const std::vector<vec3>& positions, float radius, int degree) {
  ProbeSet set;
  set.degree = degree;
  for (const vec3& position : positions) {
    Probe probe;
    probe.name = "SPHL" + std::to_string(set.probes.size());
    probe.position = position;
    probe.radius = radius;
    set.probes.push_back(probe);
  }
  return set;
}

inline BakeParams small(int face = 16, int spp = 4) {
  BakeParams params;
  params.face_size = face;
  params.path.spp = spp;
  return params;
}

inline ProbeSet bake_now(const scene::RadianceSource& source, const ProbeSet& set, const BakeParams& params) {
  BakeReport report;
  return bake(source, set, params, {}, report);
}

}  // namespace ssphh::gi
