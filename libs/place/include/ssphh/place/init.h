#pragma once
/// INIT: where the SPHLs stand.

#include <ssphh/place/place.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/scene/query.h>

namespace ssphh::place {

/// A set without light: one probe per enabled SPHL of the scene, posed at `time` seconds, in scene order.
/// `degree` is 0..max_degree. A place that is not finite or has no positive radius is an Error; so is a scene
/// without SPHLs.
probes::ProbeSet init_from_scene(const scene::Scene& scene, int degree, float time = 0);

/// A set without light at the places that place_probes() found.
probes::ProbeSet init_from_placement(const scene::Scene& scene, const Placement& placement, int degree,
                                     float time = 0);

}  // namespace ssphh::place
