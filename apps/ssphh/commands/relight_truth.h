#pragma once
/// Frames of a relighting held against path tracing, and drawn.

#include <vector>

#include <ssphh/gi/fitted_weights.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::app {

/// A set of the session's light as a bake would write it: groups apart and unscaled, `scales` beside them.
gi::ProbeSet bake_of(const gi::RelightSession& session, const scene::TransportSource& source,
                     const std::vector<vec3>& scales, gi::GeneratorInfo generator, const Control& control);

}  // namespace ssphh::app
