#pragma once
/// Structures that the shaders of method lights read; their twins stand in cones.glsl and
/// virtual_lights.glsl.

#include <cstddef>

#include <ssphh/methods/vct/voxel_grid.h>

#include "gpu_types.h"

namespace ssphh::realtime {

/// ConeBlock (std140).
inline constexpr int lobe_steps = 128;
struct GpuConeBlock {
  vec4 grid{0};     // its corner; w: edge of a voxel
  vec4 march{0};    // offset, opacity, step, radiance that 1 in the volume stands for
  ivec4 counts{0};  // cones, coarsest level
  vec4 part{0};     // texels of a side's part in the volume
  vec4 texel{0};    // 1 / texels of the volume
  vec4 cells[methods::vct::VoxelGrid::most_levels] = {};
  vec4 first[methods::vct::VoxelGrid::most_levels] = {};
  vec4 lobe_cosines[lobe_steps / 4 + 1] = {};  // at roughness i / lobe_steps
};
static_assert(offsetof(GpuConeBlock, cells) == 5 * 16);
static_assert(offsetof(GpuConeBlock, first) == (5 + methods::vct::VoxelGrid::most_levels) * 16);
static_assert(offsetof(GpuConeBlock, lobe_cosines) == (5 + 2 * methods::vct::VoxelGrid::most_levels) * 16);
static_assert(sizeof(GpuConeBlock) <= 16384, "what every driver offers for a uniform block");

/// Cones (std430): direction about the normal, tangent of the half angle.
using GpuCone = vec4;
static_assert(sizeof(GpuCone) == 16);

/// VirtualLight (std430).
struct GpuVirtualLight {
  vec4 place{0};   // w: radius of a spherical one
  vec4 normal{0};  // unit
  vec4 power{0};   // [W], over π
};
static_assert(sizeof(GpuVirtualLight) == 3 * 16 && offsetof(GpuVirtualLight, power) == 2 * 16);

namespace binding {
inline constexpr unsigned cone_block = 5;
inline constexpr unsigned cones = 0, virtual_lights = 1;  // storage
}  // namespace binding
namespace unit {
inline constexpr unsigned voxels = 4, virtual_light_maps = 4;
}

}  // namespace ssphh::realtime
