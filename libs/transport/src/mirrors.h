#pragma once
/// What rays meet by way of glass that mirrors them.

#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

struct MirrorSight {
  std::uint32_t of;    ///< index of the ray
  vec3 from;           ///< the last way but one, from here to `ray`'s origin
  rays::RayQuery ray;  ///< the last way; t_max is the distance of the hit
  vec3 normal, albedo;
  vec3 share;  ///< of the hit's light, what arrives where the ray starts, past all glass
};

/// Of rays against part 0 and their hits, what they meet by way of mirrors, in the order of the rays: after
/// one of them, and in scenes where nothing moves after up to three in a row.
std::vector<MirrorSight> follow_mirrors(const rays::TransportSource& source,
                                        std::span<const rays::RayQuery> rays,
                                        std::span<const rays::RayHit> hits);

}  // namespace ssphh::transport
