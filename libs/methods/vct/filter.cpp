/// From fine voxels to coarse ones.

#include <ssphh/core/parallel.h>
#include <ssphh/methods/vct/pyramid.h>

namespace ssphh::methods::vct {

Voxel join_voxels(const std::array<const Voxel*, 8>& children) {
  Voxel joined;
  for (int side = 0; side < side_count; ++side) {
    const int axis = side / 2, step = 1 << axis;
    vec4 sum(0);
    for (int column = 0; column < 8; ++column) {
      if (column & step) continue;
      // + sides are seen from the far end of their axis
      const int front = side % 2 == 0 ? column + step : column;
      const Voxel* first = children[front];
      const Voxel* second = children[front ^ step];
      const auto s = static_cast<std::size_t>(side);
      vec4 shown = first ? first->side[s] : vec4(0);
      if (second) cover(shown, second->side[s]);
      sum += shown;
    }
    joined.side[side] = 0.25f * sum;
  }
  return joined;
}

void Pyramid::filter() {
  for (int level = 1; level < levels(); ++level) {
    if (storage_ == Storage::dense)
      filter_dense(level);
    else
      filter_sparse(level);
  }
}

void Pyramid::filter_sparse(int level) {
  constexpr int brick = VoxelGrid::brick;
  Level& at = levels_[level];
  const Level& finer = levels_[level - 1];
  parallel_for(at.nodes.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      for (int v = 0; v < brick_voxels; ++v) {
        const int x = v % brick, y = v / brick % brick, z = v / (brick * brick);
        const std::int32_t child = at.nodes[n].child[x / 2 | y / 2 << 1 | z / 2 << 2];
        if (child < 0) continue;
        const Voxel* voxels = &finer.voxels[static_cast<std::size_t>(child) * brick_voxels];
        std::array<const Voxel*, 8> children;
        for (int c = 0; c < 8; ++c) {
          const int fx = 2 * (x % 2) + (c & 1), fy = 2 * (y % 2) + (c >> 1 & 1), fz = 2 * (z % 2) + (c >> 2);
          children[c] = voxels + (fz * brick + fy) * brick + fx;
        }
        at.voxels[n * brick_voxels + static_cast<std::size_t>(v)] = join_voxels(children);
      }
    }
  });
}

void Pyramid::filter_dense(int level) {
  Level& at = levels_[level];
  const auto row = static_cast<std::size_t>(at.size.x);
  const auto rows = static_cast<std::size_t>(at.size.y) * static_cast<std::size_t>(at.size.z);
  parallel_for(rows, 16, [&](std::size_t r) {
    const int y = static_cast<int>(r) % at.size.y, z = static_cast<int>(r) / at.size.y;
    for (int x = 0; x < at.size.x; ++x) {
      std::array<const Voxel*, 8> children;
      for (int c = 0; c < 8; ++c) {
        children[c] = static_cast<const Pyramid*>(this)->find(
            level - 1, {2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2)});
      }
      at.voxels[r * row + static_cast<std::size_t>(x)] = join_voxels(children);
    }
  });
}

}  // namespace ssphh::methods::vct
