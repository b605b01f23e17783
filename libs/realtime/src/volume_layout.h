#pragma once
/// Where the sides and levels of a voxel pyramid stand in one 3-D texture.

#include <vector>

#include <ssphh/methods/vct/voxel_grid.h>

namespace ssphh::realtime {

using glm::ivec3;

/// Six parts of equal size, one per side: along x the axes, along y first −, then + of each. Within a part
/// level 0 comes first, the coarser ones stand beyond it along z, in a row along x. A border of one empty
/// texel around each level is what filters find outside of the grid.
struct VolumeLayout {
  std::vector<ivec3> cells;  ///< of each level
  std::vector<ivec3> first;  ///< a level's first voxel within a part
  ivec3 part{0};             ///< texels of a part

  explicit VolumeLayout(const methods::vct::VoxelGrid& grid);
  ivec3 size() const { return {3 * part.x, 2 * part.y, part.z}; }
  std::size_t bytes() const;
  /// First texel of a side's part; sides as methods::vct counts them.
  ivec3 corner(int side) const { return {side / 2 * part.x, side % 2 * part.y, 0}; }
};

}  // namespace ssphh::realtime
