#pragma once
/// Distant light as spherical harmonics, and what a scene makes of it at places in space.

#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/scene/scene.h>

#include "transfer.h"

namespace ssphh::methods::prt {

/// Radiance of the environment as if its rotation were 0.
sh::RadianceSh project_environment(const scene::Environment& environment, int degree);

/// Sloan's neighbourhood transfer (2002, §7): the light that surfaces reflect toward a place is a linear
/// function of the distant light.
struct PlaceTransfer {
  int degree = 0;
  std::vector<vec3> matrix;  ///< [(place · (degree + 1)² + row) · (degree + 1)² + column]

  /// Radiance at a place under the distant light.
  sh::RadianceSh radiance(std::size_t place, const sh::RadianceSh& light) const;
};

/// By `rays` rays per place, with direct and reflected transfer at what they meet.
PlaceTransfer find_place_transfer(std::span<const vec3> places, const TransferMesh& mesh,
                                  const MeshIndex& index, const TransferVectors& transfer,
                                  const rays::TransportSource& source, int rays, const Control& control = {});

}  // namespace ssphh::methods::prt
