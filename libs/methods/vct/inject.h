#pragma once
/// From light on patches to what the voxels of level 0 show.

#include <span>

#include <ssphh/methods/vct/pyramid.h>

#include "patches.h"

namespace ssphh::methods::vct {

/// The patches of one voxel: a range of those that never move, and one of those that do.
struct VoxelPatches {
  VoxelKey voxel = 0;
  std::uint32_t still_begin = 0, still_end = 0, moving_begin = 0, moving_end = 0;
};

/// Joins two lists sorted by voxel.
std::vector<VoxelPatches> by_voxel(std::span<const Patch> still, std::span<const Patch> moving);

/// Patches and the light on them, irradiance [W/m²].
struct LitPatches {
  std::span<const Patch> patches;
  std::span<const vec3> irradiance;
};

/// Writes level 0: of each voxel and side the radiance ρE/π of its patches, from the nearest on, until the
/// face is covered.
void inject(std::span<const VoxelPatches> voxels, const LitPatches& still, const LitPatches& moving,
            Pyramid& pyramid);

}  // namespace ssphh::methods::vct
