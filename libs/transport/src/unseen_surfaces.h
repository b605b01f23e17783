#pragma once
/// Still surfaces that no surfel stands on, and those within bodies.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/transport/network.h>

namespace ssphh::transport {

/// A point in each voxel of the surfels within the box that still surfaces pass and that holds none of them,
/// for each side that a surface faces, outside of closed bodies: neither probes nor surfels see the outer
/// walls of a court, but a camera may. The same at every call.
std::vector<rays::SurfacePoint> unseen_surfaces(const TransportNetwork& network,
                                                const rays::TransportSource& source,
                                                const probes::TileBox& within = {});

/// Whether each of the points lies within a body: half of what it sees is the back of one-sided surfaces, or
/// some of it and no point that is outside.
std::vector<std::uint8_t> within_bodies(std::span<const rays::SurfacePoint> points, const SurfelSet& surfels,
                                        const rays::TransportSource& source);

}  // namespace ssphh::transport
