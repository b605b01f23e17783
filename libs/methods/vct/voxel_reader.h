#pragma once
/// Neighbouring voxels, fast where questions are close together.

#include <array>

#include <ssphh/methods/vct/pyramid.h>

namespace ssphh::methods::vct {

class VoxelReader {
 public:
  explicit VoxelReader(const Pyramid& voxels) : voxels_(voxels) {}

  /// Eight neighbours, `low` and those beyond it in the order of x, y, z; null for those that are not stored.
  /// False if none is.
  bool find8(int level, const Cell& low, std::array<const Voxel*, 8>& out) {
    const int x = low.x & mask, y = low.y & mask, z = low.z & mask;
    if (x < mask && y < mask && z < mask) {  // all in one brick
      const BrickView& view = brick_of(level, low);
      if (!view.first) return false;
      const Voxel* first = view.first + z * view.layer + y * view.row + x;
      for (int k = 0; k < 8; ++k) out[k] = first + (k >> 2) * view.layer + (k >> 1 & 1) * view.row + (k & 1);
      return true;
    }
    bool any = false;
    for (int k = 0; k < 8; ++k) {
      const Cell c{low.x + (k & 1), low.y + (k >> 1 & 1), low.z + (k >> 2)};
      const BrickView& view = brick_of(level, c);
      const Voxel*& voxel = out[k];
      voxel = view.first ? view.first + (c.z & mask) * view.layer + (c.y & mask) * view.row + (c.x & mask)
                         : nullptr;
      any |= voxel != nullptr;
    }
    return any;
  }

  const Pyramid& voxels() const { return voxels_; }

 private:
  static constexpr int shift = 2, mask = VoxelGrid::brick - 1;
  static_assert(1 << shift == VoxelGrid::brick);

  struct Slot {
    Cell brick{-1 << 20, 0, 0};  // nowhere
    BrickView view;
  };
  /// Of the voxel; remembers the eight bricks of each level in which it was last.
  const BrickView& brick_of(int level, const Cell& c) {
    const Cell brick{c.x >> shift, c.y >> shift, c.z >> shift};
    Slot& slot = slots_[level][(brick.x & 1) | (brick.y & 1) << 1 | (brick.z & 1) << 2];
    if (!(slot.brick == brick)) slot = {brick, voxels_.view(level, brick)};
    return slot.view;
  }

  const Pyramid& voxels_;
  std::array<std::array<Slot, 8>, VoxelGrid::most_levels> slots_;
};

}  // namespace ssphh::methods::vct
