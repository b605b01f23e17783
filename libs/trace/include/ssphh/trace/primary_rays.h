#pragma once
/// The rays of a picture, for those who draw over it.

#include <functional>

#include <ssphh/rays/transport_source.h>
#include <ssphh/trace/render_state.h>

namespace ssphh::trace {

/// The ray of a place on the whole picture [pixels] from the upper left, as PathTracer::render sends it: unit
/// direction, no end. Places outside of a cube strip or a panorama give those of its edge. Throws Error for a
/// field of view that cannot be, or a pose that is not finite.
std::function<rays::RayQuery(float x, float y)> primary_rays(const RenderParams& params);

}  // namespace ssphh::trace
