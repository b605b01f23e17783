#pragma once
/// What reflects and blocks in each voxel: pieces of surface that face about the same way, joined.

#include <array>
#include <span>
#include <vector>

#include <ssphh/rays/posed_world.h>

#include "voxelize.h"

namespace ssphh::methods::vct {

/// One side of the surface in one voxel whose normals have the same main axis.
struct Patch {
  VoxelKey voxel = 0;
  /// Area in shares of the voxel's face, projected along each axis and seen from each side.
  std::array<float, side_count> cover{};
  vec3 position{0};  ///< mean [m]
  vec3 normal{0};    ///< mean, unit
  vec3 albedo{0};
  std::uint32_t first_sample = 0, samples = 0;
};

/// Patches sorted by voxel, and the places at which direct light is asked for.
struct PatchSet {
  std::vector<Patch> patches;
  std::vector<rays::SurfacePoint> samples;
};

struct PatchParams {
  int samples = 4;  ///< of a patch
  bool moving = false;
};

/// Joins the fragments of each voxel and asks rays for albedo and coverage. Fronts always are patches. The
/// back of a one-sided surface is one where it can be seen: where at least a quarter of 16 cosine-distributed
/// rays from it meet fronts. The inside of bodies and the outside of rooms that are mere skins have none:
/// cones that leave a surface pass its other side, which otherwise would darken it.
PatchSet make_patches(std::span<const Fragment> fragments, const rays::PosedWorld& surfaces,
                      const VoxelGrid& grid, const PatchParams& params, const Control& control);

}  // namespace ssphh::methods::vct
