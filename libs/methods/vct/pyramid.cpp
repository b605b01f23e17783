#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/methods/vct/pyramid.h>

namespace ssphh::methods::vct {
namespace {

constexpr int brick = VoxelGrid::brick;

std::size_t volume(const Cell& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
         static_cast<std::size_t>(size.z);
}

std::size_t place_in(const Cell& size, const Cell& c) {
  return (static_cast<std::size_t>(c.z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(c.y)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(c.x);
}

std::size_t octant(const Cell& brick_cell, int shift) {
  return static_cast<std::size_t>((brick_cell.x >> shift & 1) | (brick_cell.y >> shift & 1) << 1 |
                                  (brick_cell.z >> shift & 1) << 2);
}

void check_bytes(std::size_t bytes, std::size_t most) {
  if (bytes <= most) return;
  throw Error("method vct", fmt::format("its voxels would take {:.1f} GB", static_cast<double>(bytes) / 1e9),
              "take a lower resolution, or storage=sparse");
}

}  // namespace

Pyramid::Pyramid(const VoxelGrid& grid, Storage storage, std::span<const VoxelKey> occupied,
                 std::size_t most_bytes)
    : grid_(grid), storage_(storage), levels_(static_cast<std::size_t>(grid.levels())) {
  for (int k = 0; k < levels(); ++k) levels_[k].size = grid.level_size(k);
  if (storage == Storage::dense) {
    std::size_t all = 0;
    for (const Level& level : levels_) all += volume(level.size);
    check_bytes(all * sizeof(Voxel), most_bytes);
    for (Level& level : levels_) level.voxels.resize(volume(level.size));
    return;
  }
  // Bricks of each level, level 0 first, each list sorted, so that nodes lie in a fixed order.
  const int top = levels() - 1;
  std::vector<std::vector<VoxelKey>> bricks(levels_.size());
  for (int k = 0; k <= top; ++k) {
    auto& keys = bricks[k];
    const auto add = [&](VoxelKey key, int divide) {
      const Cell c = voxel_cell(key);
      keys.push_back(voxel_key({c.x / divide, c.y / divide, c.z / divide}));
    };
    if (k == 0)
      for (const VoxelKey voxel : occupied) add(voxel, brick);
    else
      for (const VoxelKey finer : bricks[k - 1]) add(finer, 2);
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  }
  if (bricks.back().empty()) bricks.back().push_back(0);
  std::size_t all = 0;
  for (const auto& keys : bricks) all += keys.size();
  check_bytes(all * (brick_voxels * sizeof(Voxel) + sizeof(Node)), most_bytes);
  for (int k = top; k >= 0; --k) {
    Level& level = levels_[k];
    for (const VoxelKey key : bricks[k]) {
      const Cell cell = voxel_cell(key);
      if (k < top) {
        const Cell above{cell.x / 2, cell.y / 2, cell.z / 2};
        const Node* parent = descend(k + 1, above);
        const_cast<Node*>(parent)->child[octant(cell, 0)] = static_cast<std::int32_t>(level.nodes.size());
      }
      Node node;
      node.child.fill(-1);
      node.brick = cell;
      level.nodes.push_back(node);
    }
    level.voxels.resize(level.nodes.size() * brick_voxels);
  }
}

const Pyramid::Node* Pyramid::descend(int level, const Cell& brick_cell) const {
  const int top = levels() - 1;
  const Node* node = levels_.back().nodes.data();
  for (int k = top - 1; k >= level; --k) {
    const std::int32_t child = node->child[octant(brick_cell, k - level)];
    if (child < 0) return nullptr;
    node = &levels_[k].nodes[child];
  }
  return node;
}

BrickView Pyramid::view(int level, const Cell& at) const {
  const Level& stored = levels_[level];
  const Cell& size = stored.size;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= size.x / brick || at.y >= size.y / brick ||
      at.z >= size.z / brick)
    return {};
  if (storage_ == Storage::dense)
    return {&stored.voxels[place_in(size, {at.x * brick, at.y * brick, at.z * brick})], size.x,
            size.x * size.y};
  const Node* node = descend(level, at);
  if (!node) return {};
  return {&stored.voxels[static_cast<std::size_t>(node - stored.nodes.data()) * brick_voxels], brick,
          brick * brick};
}

const Voxel* Pyramid::find(int level, const Cell& c) const {
  if (c.x < 0 || c.y < 0 || c.z < 0) return nullptr;
  const BrickView found = view(level, {c.x / brick, c.y / brick, c.z / brick});
  if (!found.first) return nullptr;
  return found.first + (c.z % brick) * found.layer + (c.y % brick) * found.row + c.x % brick;
}

std::size_t Pyramid::bricks(int level) const {
  return levels_[level].voxels.size() / brick_voxels;
}

std::size_t Pyramid::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_)
    sum += level.voxels.size() * sizeof(Voxel) + level.nodes.size() * sizeof(Node);
  return sum;
}

}  // namespace ssphh::methods::vct
