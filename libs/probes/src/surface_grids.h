#pragma once
/// Where the cells of SurfaceLists lie.

#include <array>
#include <span>

#include <ssphh/probes/surface_lists.h>

#include "still_surface.h"

namespace ssphh::probes {

/// One grid over all triangles where its cells are as fine as the points, each `spacings` apart, ask; else
/// one where those are dense, and a second, coarser, over all.
std::array<SurfaceGrid, 2> surface_grids(std::span<const StillTriangle> triangles,
                                         std::span<const rays::SurfacePoint> points,
                                         std::span<const float> spacings);

}  // namespace ssphh::probes
