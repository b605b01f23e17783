#pragma once
/// Voxels of all levels: a sparse octree of bricks, or whole arrays.

#include <span>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/methods/vct/voxel_grid.h>

namespace ssphh::methods::vct {

enum class Storage { sparse, dense };
constexpr auto enum_table(Storage) {
  using enum Storage;
  return std::to_array<EnumName<Storage>>({{sparse, "sparse"}, {dense, "dense"}});
}

/// Where the 4³ voxels of a brick lie: `first` and from there on `row` voxels further per y, `layer` per z.
struct BrickView {
  const Voxel* first = nullptr;  ///< null: the brick is not stored
  int row = 0, layer = 0;
};

/// Sparse: a node of the octree is a brick of 4³ voxels of one level and has up to eight children, the bricks
/// of the next finer level in its octants; bricks without surface do not exist (Crassin et al., Interactive
/// Indirect Illumination Using Voxel Cone Tracing, 2011, §4). Dense: every voxel of every level.
class Pyramid {
 public:
  /// All voxels empty. `occupied`: keys of level 0's voxels that will be written. Throws Error for more than
  /// `most_bytes`.
  Pyramid(const VoxelGrid& grid, Storage storage, std::span<const VoxelKey> occupied,
          std::size_t most_bytes = std::size_t{6} << 30);

  const VoxelGrid& grid() const { return grid_; }
  Storage storage() const { return storage_; }
  int levels() const { return static_cast<int>(levels_.size()); }

  /// The voxel, or null for one that is not stored: outside of the grid, or in a brick without surface.
  const Voxel* find(int level, const Cell& cell) const;
  Voxel* find(int level, const Cell& cell) {
    return const_cast<Voxel*>(static_cast<const Pyramid*>(this)->find(level, cell));
  }

  /// `brick` in bricks of the level.
  BrickView view(int level, const Cell& brick) const;

  /// Fills the coarser levels from level 0. A voxel shows to a side the mean of its four columns along that
  /// axis, and a column what its front voxel shows and lets through of the one behind.
  void filter();

  /// Bricks of level 0, of all levels; dense: as many as would fill the arrays.
  std::size_t bricks(int level) const;
  std::size_t bytes() const;

 private:
  static constexpr int brick_voxels = VoxelGrid::brick * VoxelGrid::brick * VoxelGrid::brick;

  struct Node {
    std::array<std::int32_t, 8> child;  ///< node of the next finer level; −1: none
    Cell brick;                         ///< in bricks of its level
  };
  /// Voxels of dense levels in order of x, y, z; of sparse ones brick after brick.
  struct Level {
    Cell size;
    std::vector<Node> nodes;
    std::vector<Voxel> voxels;
  };

  const Node* descend(int level, const Cell& brick) const;
  void filter_sparse(int level);
  void filter_dense(int level);

  VoxelGrid grid_;
  Storage storage_;
  std::vector<Level> levels_;
};

/// Sums up eight voxels into the one that they fill, in the order of x, y, z; null: empty.
Voxel join_voxels(const std::array<const Voxel*, 8>& children);

}  // namespace ssphh::methods::vct
