#pragma once
/// Baked sets of one network at several times, and what lies between them.

#include <string>
#include <vector>

#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {

/// (1 − t) a + t b, with what could not be blended and is left out, for people ("fitted weights").
struct BlendedSet {
  ProbeSet set;
  std::vector<std::string> left_out;
};

/// Light is blended linearly: coefficients of every group, each times its factor where the factors differ,
/// edges (one that only one set has counts as dark in the other) and records at the same points. Fitted
/// weights stay where both have the same; records at other points, baselines and the hierarchy, which
/// must be computed anew, are left out. `t` from 0 to 1. At 0 and 1 the light is that of a or b, to the bit.
/// Groups that are `diffuse` in one and `realtime` in the other become `realtime`.
/// What the set tells of its making is that of the nearer one, at a time between theirs; a scene hash that
/// differs becomes 0. Throws Error that names the first difference in degree, places, light groups or whether
/// they are `baked`,
/// and for a `t` outside.
BlendedSet blend(const ProbeSet& a, const ProbeSet& b, float t);

/// A set and the time it is the light of [s].
struct KeyedSet {
  float time = 0;
  ProbeSet set;
};

/// The light at a time: of the first or last key before and after all of them, else the blend of the keys
/// around it. `keys` by ascending time, each time once. Throws Error where there is none, for others and as
/// blend().
BlendedSet light_at(const std::vector<KeyedSet>& keys, float time);

}  // namespace ssphh::probes
