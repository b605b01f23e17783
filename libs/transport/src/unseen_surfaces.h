#pragma once
/// Still surfaces that no surfel stands on.

#include <vector>

#include <ssphh/transport/network.h>

namespace ssphh::transport {

/// A point in each voxel of the surfels that still surfaces pass and that holds none of them, for each side
/// that a surface faces, outside of closed bodies: neither probes nor surfels see the outer walls of a court,
/// but a camera may. The same at every call.
std::vector<rays::SurfacePoint> unseen_surfaces(const TransportNetwork& network,
                                                const rays::TransportSource& source);

}  // namespace ssphh::transport
