#pragma once

#include <cstddef>

#include <ssphh/gi/relight_session.h>

namespace ssphh::gi::methods {

/// Bytes that a session's transport network and its light take.
inline std::size_t network_bytes(const TransportNetwork& network) {
  return network.links().link_count() * sizeof(Link) + network.seen().size() * sizeof(SeenPatch) +
         network.seen_distance().size() * sizeof(float) + network.gbuffer().hits.size() * sizeof(PackedHit) +
         network.samples().size() * (sizeof(scene::SurfacePoint) + 1) +
         network.surfel_count() * (sizeof(Surfel) + sizeof(vec3) + 4 * sizeof(Irradiance4));
}

}  // namespace ssphh::gi::methods
