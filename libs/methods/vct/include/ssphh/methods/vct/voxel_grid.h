#pragma once
/// The grid of voxel cone tracing: cubes of equal size over the scene, and what each keeps.

#include <array>
#include <cstdint>

#include <ssphh/scene/query.h>

namespace ssphh::methods::vct {

/// Index of a voxel, or a size in voxels, along x, y, z.
struct Cell {
  int x = 0, y = 0, z = 0;
  int operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Cubes of edge `voxel` from `origin` on. Level k joins 2^k voxels along each axis; the coarsest level fits
/// into one brick.
struct VoxelGrid {
  static constexpr int brick = 4;  ///< voxels along the edge of a brick
  static constexpr int most_levels = 9;

  vec3 origin{0};          ///< [m]
  float voxel = 1;         ///< [m]
  int resolution = brick;  ///< voxels along the longest edge of the bounds, margins included; a power of two
  Cell size{brick, brick, brick};  ///< of level 0, each a multiple of the brick

  int levels() const;
  /// In voxels of the level, whole bricks.
  Cell level_size(int level) const;
  /// World to units of level 0's voxels, 0 at the grid's corner.
  vec3 to_grid(const vec3& p) const { return (p - origin) / voxel; }
  vec3 to_world(const vec3& p) const { return origin + voxel * p; }
};

/// Bounds with a margin of a voxel all round, divided into `resolution` (a power of two, 8..1024) voxels
/// along the longest edge.
VoxelGrid make_grid(const scene::Bounds& bounds, int resolution);

/// Voxels in order of x, then y, then z, in one word.
using VoxelKey = std::uint32_t;
constexpr VoxelKey voxel_key(const Cell& c) {
  return static_cast<VoxelKey>(c.z) << 20 | static_cast<VoxelKey>(c.y) << 10 | static_cast<VoxelKey>(c.x);
}
constexpr Cell voxel_cell(VoxelKey key) {
  return {static_cast<int>(key & 1023), static_cast<int>(key >> 10 & 1023), static_cast<int>(key >> 20)};
}

/// Sides of a voxel: +x −x +y −y +z −z, the direction *from* which it is seen.
constexpr int side_count = 6;
constexpr int opposite(int side) {
  return side ^ 1;
}
/// The side of an axis that something going along `direction` meets.
inline int facing_side(const vec3& direction, int axis) {
  return 2 * axis + (direction[axis] > 0 ? 1 : 0);
}

/// What a voxel shows to each side. w: opacity, the share 0..1 of that face which the surface in the voxel
/// covers. xyz: opacity times the mean radiance [W sr⁻¹ m⁻²] of what covers it. Both are linear in the
/// surface, and so may be interpolated.
struct Voxel {
  std::array<vec4, side_count> side{};
};

/// Puts what lies behind after what is seen so far: it covers of the rest as much as it can, as the pieces of
/// one surface do that passes through several voxels. (Were they independent, (1 − a)(1 − b) would show
/// through, and every wall that does not lie along the grid would let a sixth of the light pass.)
inline void cover(vec4& seen, const vec4& behind) {
  if (!(behind.w > 0)) return;
  const float share = glm::min(behind.w, 1 - seen.w);
  seen += (share / behind.w) * behind;
}

}  // namespace ssphh::methods::vct
