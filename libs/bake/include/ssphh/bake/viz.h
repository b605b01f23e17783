#pragma once
/// VIZ: how much light of SPHL j reaches probe i, for all j in one pass per i: N passes, not N².

#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::bake {

struct VizParams {
  bool matrix = false;  ///< also T_{j→i}: K² RGB numbers per edge (120 kB at degree 9)
  int neighbors = -1;   ///< at most so many edges, those with the largest P; −1: all
  float threshold = 0;  ///< and only those with P above it
  probes::VizSource source = probes::VizSource::intensity;
  rays::PathSet paths = rays::PathSet::all;  ///< scattering between the sphere and the probe
};

/// Edges i ← j of probe i: every other probe is a sphere of its radius that shines as `source` says, and
/// H_{j→i} is what arrives at i from sphere j, itself and everything it lights. Edges with P not above the
/// threshold are left out. P_ii = 1 is implied. `request.position` and `request.paths` are not read.
std::vector<probes::Edge> viz(const rays::RadianceSource& source, const probes::ProbeSet& set, std::size_t i,
                              const rays::CubeRequest& request, const VizParams& params,
                              const Control& control = {});

}  // namespace ssphh::bake
