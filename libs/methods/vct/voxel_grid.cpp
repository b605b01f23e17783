#include <algorithm>
#include <bit>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/methods/vct/voxel_grid.h>

namespace ssphh::methods::vct {

int VoxelGrid::levels() const {
  return std::bit_width(static_cast<unsigned>(resolution / brick));
}

Cell VoxelGrid::level_size(int level) const {
  const auto coarse = [&](int n) {
    const int edge = brick << level;
    return (n + edge - 1) / edge * brick;
  };
  return {coarse(size.x), coarse(size.y), coarse(size.z)};
}

VoxelGrid make_grid(const scene::Bounds& bounds, int resolution) {
  require(resolution >= 8 && resolution <= 1024 && std::has_single_bit(static_cast<unsigned>(resolution)),
          "voxels", "their number along an axis must be a power of two, 8 to 1024");
  const vec3 extent = bounds.max - bounds.min;
  VoxelGrid grid;
  grid.resolution = resolution;
  grid.voxel = max_component(extent) / static_cast<float>(resolution - 2);
  if (bounds.empty() || !(grid.voxel > 0) || !std::isfinite(grid.voxel))
    throw Error("voxels", "the scene has no surfaces, or no extent");
  const auto cells = [&](float length) {
    const int needed = static_cast<int>(std::ceil(length / grid.voxel)) + 2;
    const int bricks = (needed + VoxelGrid::brick - 1) / VoxelGrid::brick;
    return std::min(bricks * VoxelGrid::brick, resolution);
  };
  grid.size = {cells(extent.x), cells(extent.y), cells(extent.z)};
  const vec3 whole(static_cast<float>(grid.size.x), static_cast<float>(grid.size.y),
                   static_cast<float>(grid.size.z));
  grid.origin = bounds.center() - 0.5f * grid.voxel * whole;
  return grid;
}

}  // namespace ssphh::methods::vct
