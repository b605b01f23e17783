#pragma once
/// Irradiance of probes by each light group.

#include <vector>

#include <ssphh/probes/lookup.h>

namespace ssphh::cook {

/// [light group][probe], at scale 1, of degree `degree`: what the set's default lookup would have of this
/// group alone, but windowed as the sum of all groups at the set's scales is; a group whose scale is 0 by
/// itself. Of groups whose direct light is in the records (probes::mirrored_groups) with what their emitters
/// send straight to the probe, as things that move have it.
std::vector<std::vector<sh::IrradianceSh>> group_irradiance(const probes::ProbeSet& set, int degree);

}  // namespace ssphh::cook
