#pragma once
/// Small sets and bakes for the tests of GEN, VIZ and what drives them.

#include <ssphh/bake/bake.h>

#include "fake_source.h"

namespace ssphh::test {

inline const std::vector<vec3> four_places = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.7f, 0}, {0.1f, 0.2f, 0.9f}};

inline probes::ProbeSet places(const std::vector<vec3>& positions, float radius, int degree) {
  probes::ProbeSet set;
  set.degree = degree;
  for (const vec3& position : positions) {
    probes::Probe probe;
    probe.name = "SPHL" + std::to_string(set.probes.size());
    probe.position = position;
    probe.radius = radius;
    set.probes.push_back(probe);
  }
  return set;
}

inline bake::BakeParams small(int face = 16, int spp = 4) {
  bake::BakeParams params;
  params.face_size = face;
  params.path.spp = spp;
  return params;
}

inline probes::ProbeSet bake_now(const rays::RadianceSource& source, const probes::ProbeSet& set,
                                 const bake::BakeParams& params) {
  bake::BakeReport report;
  return bake::bake(source, set, params, {}, report);
}

}  // namespace ssphh::test
