#pragma once
/// Virtual point lights: where photons of the scene's lights meet surfaces.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/gi/surface_points.h>

namespace ssphh::gi::methods {

/// A diffuse emitter at a point: radiant intensity power/π · cos θ around the normal [W/sr].
struct Vpl {
  vec3 position{0};  ///< a little above its surface
  vec3 normal{0};    ///< unit
  vec3 power{0};     ///< flux that leaves the surface again [W]
  float radius = 0;  ///< over which a spherical light spreads it [m]
};

struct PhotonParams {
  int photons = 512;  ///< leave the lights, shared out among the groups by their flux
  int depth = 25;     ///< scattering events of a path, that at the lit point included
  std::uint64_t seed = 0;
};

/// Follows photons through diffuse reflections, which they survive with the share of their power that the
/// surface reflects (Russian roulette; Keller, Instant Radiosity, SIGGRAPH 1997). Each reflection leaves a
/// light. By low-discrepancy points: the same at every call.
std::vector<Vpl> trace_photons(const scene::DirectLight& lights, std::span<const vec3> group_scales,
                               const PosedSurfaces& surfaces, const PhotonParams& params,
                               const Control& control);

}  // namespace ssphh::gi::methods
