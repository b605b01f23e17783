#pragma once
/// Sets in fewer bytes: what a packed file leaves out, and how far its light is from the set's.

#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {

/// The set in bands 0..degree, without what only HIER and updates of a bake need: edges and the baseline.
/// Throws Error for a degree outside 0..set.degree.
ProbeSet compacted(const ProbeSet& set, int degree);

/// Of |E′(n) − E(n)| of each channel, in shares of the probe's mean irradiance over directions and channels:
/// over probes and 64 directions each, spread evenly.
struct IrradianceLoss {
  vec3 mean{0};
  vec3 most_of_95{0};  ///< what 95 % do not exceed
  vec3 largest{0};
  std::size_t dark = 0;  ///< probes without light, which do not count
};

/// How far the irradiance of what surfaces look up, Probe::reflected, is from that of the same probes in
/// `set`. Throws Error unless there are as many.
IrradianceLoss irradiance_loss(const ProbeSet& set, const ProbeSet& packed);

}  // namespace ssphh::probes
