#pragma once
/// Single voxels, fast where questions are close together.

#include <array>

#include <ssphh/gi/vct/pyramid.h>

namespace ssphh::gi::vct {

class VoxelReader {
 public:
  explicit VoxelReader(const Pyramid& voxels) : voxels_(voxels) {}

  /// As Pyramid::find. Remembers the eight bricks of each level in which it was last.
  const Voxel* find(int level, const Cell& c) {
    const Cell brick{c.x >> shift, c.y >> shift, c.z >> shift};
    Slot& slot = slots_[static_cast<std::size_t>(level)]
                       [static_cast<std::size_t>((brick.x & 1) | (brick.y & 1) << 1 | (brick.z & 1) << 2)];
    if (!(slot.brick == brick)) slot = {brick, voxels_.view(level, brick)};
    if (!slot.view.first) return nullptr;
    return slot.view.first + (c.z & mask) * slot.view.layer + (c.y & mask) * slot.view.row + (c.x & mask);
  }

  const Pyramid& voxels() const { return voxels_; }

 private:
  static constexpr int shift = 2, mask = VoxelGrid::brick - 1;
  static_assert(1 << shift == VoxelGrid::brick);

  struct Slot {
    Cell brick{-1 << 20, 0, 0};  // nowhere
    BrickView view;
  };
  const Pyramid& voxels_;
  std::array<std::array<Slot, 8>, VoxelGrid::most_levels> slots_;
};

}  // namespace ssphh::gi::vct
