#pragma once
/// Triangles cut exactly along the walls of the voxels.

#include <array>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/methods/vct/voxel_grid.h>

namespace ssphh::methods::vct {

/// The piece of one triangle that lies in one voxel. Lengths in voxels, world axes.
struct Fragment {
  VoxelKey voxel = 0;
  vec3 area{0};         ///< normal of the front, as long as the piece is large
  vec3 centroid{0};     ///< in grid units
  bool cutout = false;  ///< of a material that is not there everywhere to rays (alpha, glass)
};

/// Cuts a triangle (grid units, front counter-clockwise) and adds its pieces, by x, then y, then z. Voxels
/// that it only touches have none; what lies outside of the grid is dropped.
void cut_triangle(const VoxelGrid& grid, const std::array<vec3, 3>& corners, std::vector<Fragment>& out);

/// All triangles of the instances that move, or of those that do not, posed at `time`. Sorted by voxel, and
/// within a voxel in the scene's order.
std::vector<Fragment> voxelize(const scene::Scene& scene, float time, bool moving, const VoxelGrid& grid,
                               const Control& control);

}  // namespace ssphh::methods::vct
