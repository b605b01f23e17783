#pragma once
/// What the probes' rays bring in one frame.

#include <ssphh/core/control.h>
#include <ssphh/rays/posed_world.h>

#include "field.h"

namespace ssphh::methods::ddgi {

/// One ray of a probe.
struct ProbeRay {
  vec3 radiance{0};    ///< that surfaces scattered toward the probe [W sr⁻¹ m⁻²]
  float distance = 0;  ///< to the surface [m], infinite if there is none
};

/// Directions nearly uniform on the sphere: a spherical Fibonacci set, turned at random for each frame.
std::vector<vec3> ray_directions(int count, std::uint64_t seed, std::uint64_t frame);

/// One ray per active probe, in the order of the field, and direction. Surfaces are lit by `lights` and by
/// the field as it stands, which adds one bounce a frame; what emitters send to a probe straight is left out.
std::vector<ProbeRay> trace_probes(const DdgiField& field, const rays::PosedWorld& surfaces,
                                   const rays::DirectLight& lights, std::span<const vec3> group_scales,
                                   std::span<const vec3> directions, const Control& control);

}  // namespace ssphh::methods::ddgi
