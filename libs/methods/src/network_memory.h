#pragma once

#include <cstddef>

#include <ssphh/transport/network.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::methods {

/// Bytes that a session's transport network and its light take.
inline std::size_t network_bytes(const transport::TransportNetwork& network) {
  return network.links().link_count() * sizeof(transport::Link) +
         network.seen().size() * sizeof(transport::SeenPatch) +
         network.seen_distance().size() * sizeof(float) +
         network.gbuffer().hits.size() * sizeof(transport::PackedHit) +
         network.patch_count() *
             (sizeof(rays::SurfacePoint) + 1 + sizeof(vec3) + 3 * sizeof(transport::Irradiance4)) +
         network.surfel_count() * (sizeof(transport::Surfel) + 2 * sizeof(transport::Irradiance4));
}

}  // namespace ssphh::methods
