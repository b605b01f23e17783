#pragma once
/// Where a probe stands.

#include <string>
#include <vector>

#include <ssphh/core/vectors.h>

namespace ssphh::scene {

/// The place of an SPHL of a scene, of a probe that is found one, or of one that a session relights.
struct ProbePlace {
  std::string name;
  vec3 position{0};     ///< world, metres
  float radius = 0.1f;  ///< of the sphere from which it emits, and that VIZ looks at, metres
};

/// The places of whatever has a name, a position and a radius: probes, what place_probes() finds.
template <class Probes>
std::vector<ProbePlace> places_of(const Probes& probes) {
  std::vector<ProbePlace> places;
  for (const auto& probe : probes) places.push_back({probe.name, probe.position, probe.radius});
  return places;
}

/// The positions of whatever has one.
template <class Probes>
std::vector<vec3> positions_of(const Probes& probes) {
  std::vector<vec3> positions;
  for (const auto& probe : probes) positions.push_back(probe.position);
  return positions;
}

}  // namespace ssphh::scene
