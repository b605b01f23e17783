#pragma once
/// Virtual point lights: where photons of the scene's lights meet surfaces.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/methods/vpl/virtual_lights.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::methods::vpl {

struct PhotonParams {
  int photons = 512;  ///< leave the lights, shared out among the groups by their flux
  int depth = 25;     ///< scattering events of a path, that at the lit point included
  std::uint64_t seed = 0;
};

/// Follows photons through diffuse reflections, which they survive with the share of their power that the
/// surface reflects (Russian roulette; Keller, Instant Radiosity, SIGGRAPH 1997). Each reflection leaves a
/// light. By low-discrepancy points: the same at every call.
std::vector<Vpl> trace_photons(const rays::DirectLight& lights, std::span<const vec3> group_scales,
                               const rays::PosedWorld& surfaces, const PhotonParams& params,
                               const Control& control);

}  // namespace ssphh::methods::vpl
