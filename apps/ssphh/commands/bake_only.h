#pragma once
/// `ssphh bake --update --only-...`: what is baked by hand, the rest keeps its bits.

#include <string>
#include <vector>

#include <ssphh/bake/light_scope.h>
#include <ssphh/probes/probe_set.h>

#include "options/command_line.h"

namespace ssphh::app {

/// As they are typed; empty: not given.
struct BakeOnly {
  std::string probes;               ///< "3,7,12-19", as `probe info` numbers them
  std::vector<float> box;           ///< x0,y0,z0,x1,y1,z1 [m]
  std::vector<std::string> lights;  ///< names of light groups

  bool any() const { return !probes.empty() || !box.empty() || !lights.empty(); }
};

void add_only_options(const Command& command, BakeOnly& only);

/// What is meant in this set, whose light groups are the scene's. Throws Error for indices and groups that
/// there are not, what is no list and no box, and a box without a probe.
bake::LightScope light_scope(const BakeOnly& only, const probes::ProbeSet& set);

}  // namespace ssphh::app
