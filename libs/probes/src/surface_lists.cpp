#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/surface_lists.h>

#include "surface_grids.h"
#include "surface_list_maker.h"

namespace ssphh::probes {
namespace {

/// Cells along a block, whose cells may share lists.
constexpr int block_cells = 8;

class Preparation {
 public:
  Preparation(SurfaceLists& out, std::vector<StillTriangle> triangles, const SeesProbe& sees)
      : out_(out), maker_(out.points, std::move(triangles), sees) {
    out_.grids = surface_grids(maker_.triangles(), out_.points, maker_.spacings());
  }

  void run(const Control& control) {
    for (SurfaceGrid& grid : out_.grids) {
      grid.first = out_.ranges.size();
      if (grid.count() == 0) continue;
      grid_ = &grid;
      in_cells_ = triangle_cells(maker_.triangles(), grid.origin, grid.cell_size, grid.cells);
      const ivec3 along = (grid.cells + block_cells - 1) / block_cells;
      std::vector<Block> blocks(static_cast<std::size_t>(along.x) * static_cast<std::size_t>(along.y) *
                                static_cast<std::size_t>(along.z));
      parallel_for(
          blocks.size(), 1,
          [&](std::size_t begin, std::size_t end) {
            ListWork work;
            for (std::size_t b = begin; b < end; ++b) {
              const auto i = static_cast<int>(b);
              const ivec3 number(i % along.x, i / along.x % along.y, i / (along.x * along.y));
              fill(blocks[b], {block_cells * number, block_cells}, work);
            }
          },
          control);
      append(blocks, along);
    }
  }

 private:
  /// Some cells of the grid, as many along each axis.
  struct Cells {
    ivec3 low;
    int along;
  };
  /// The lists of a block's cells.
  struct Block {
    std::vector<std::vector<uvec4>> lists;
    std::array<std::int16_t, block_cells * block_cells * block_cells> of_cell;  ///< −1: none
    static std::size_t number(const ivec3& cell) {
      const ivec3 at = cell % block_cells;
      return static_cast<std::size_t>((at.z * block_cells + at.y) * block_cells + at.x);
    }
  };

  /// Gives all these cells one list, where one serves them, else each eighth of them its own.
  void fill(Block& block, const Cells& cells, ListWork& work) const {
    const ivec3 end = glm::min(cells.low + cells.along, grid_->cells);
    const auto visit = [&](const auto& of_cell) {
      for (int z = cells.low.z; z < end.z; ++z) {
        for (int y = cells.low.y; y < end.y; ++y) {
          for (int x = cells.low.x; x < end.x; ++x) of_cell(ivec3(x, y, z));
        }
      }
    };
    work.triangles.clear();
    visit([&](const ivec3& cell) {
      const std::size_t c = cell_number(cell);
      for (std::size_t i = in_cells_.first[c]; i < in_cells_.first[c + 1]; ++i)
        work.triangles.push_back(in_cells_.triangles[i]);
      block.of_cell[Block::number(cell)] = -1;
    });
    if (work.triangles.empty()) return;
    const ListedBox box{grid_->origin + grid_->cell_size * vec3(cells.low),
                        static_cast<float>(cells.along) * grid_->cell_size, grid_->cell_size};
    if (hidden_by_first(box)) return;
    if (maker_.make(box, work)) {
      if (work.list.empty()) return;
      visit([&](const ivec3& cell) {
        const std::size_t c = cell_number(cell);
        if (in_cells_.first[c] < in_cells_.first[c + 1])
          block.of_cell[Block::number(cell)] = static_cast<std::int16_t>(block.lists.size());
      });
      return block.lists.push_back(work.list);
    }
    const int half = cells.along / 2;
    for (int part = 0; part < 8; ++part)
      fill(block, {cells.low + half * ivec3(part & 1, part >> 1 & 1, part >> 2), half}, work);
  }

  std::size_t cell_number(const ivec3& cell) const {
    return static_cast<std::size_t>((cell.z * grid_->cells.y + cell.y) * grid_->cells.x + cell.x);
  }

  void append(const std::vector<Block>& blocks, const ivec3& along) {
    std::vector<std::vector<uvec2>> ranges;
    for (const Block& block : blocks) {
      std::vector<uvec2>& of_block = ranges.emplace_back();
      for (const std::vector<uvec4>& list : block.lists) {
        of_block.emplace_back(out_.lists.size(), list.size());
        out_.lists.insert(out_.lists.end(), list.begin(), list.end());
      }
    }
    for (int z = 0; z < grid_->cells.z; ++z) {
      for (int y = 0; y < grid_->cells.y; ++y) {
        for (int x = 0; x < grid_->cells.x; ++x) {
          const ivec3 cell(x, y, z), in = cell / block_cells;
          const auto b = static_cast<std::size_t>((in.z * along.y + in.y) * along.x + in.x);
          const int list = blocks[b].of_cell[Block::number(cell)];
          out_.ranges.push_back(list < 0 ? uvec2(0) : ranges[b][static_cast<std::size_t>(list)]);
        }
      }
    }
  }

  /// Whether the first grid is asked in all of a box of the second.
  bool hidden_by_first(const ListedBox& box) const {
    const SurfaceGrid& first = out_.grids[0];
    return grid_ != &first && glm::all(glm::greaterThanEqual(box.corner, first.origin)) &&
           glm::all(glm::lessThanEqual(box.corner + box.size, first.end()));
  }

  SurfaceLists& out_;
  SurfaceListMaker maker_;
  const SurfaceGrid* grid_ = nullptr;  ///< whose lists are made
  TriangleCells in_cells_;             ///< of that
};

}  // namespace

SurfaceLists prepare_surfaces(const scene::Scene& scene, float time, std::vector<rays::SurfacePoint> points,
                              const SeesProbe& sees, const Control& control) {
  require(sees != nullptr, "surface points", "nothing tells what sees them");
  scene::check_indices(scene);
  SurfaceLists out;
  out.points = std::move(points);
  if (out.points.size() > SurfaceLists::most_points)
    throw Error("surface points", fmt::format("there are {}, at most {} can be drawn", out.points.size(),
                                              SurfaceLists::most_points));
  std::vector<StillTriangle> triangles = still_triangles(scene, time);
  const bool apart = std::ranges::any_of(
      out.points, [&](const rays::SurfacePoint& p) { return p.position != out.points[0].position; });
  if (!apart || triangles.empty()) return out;
  Preparation(out, std::move(triangles), sees).run(control);
  return out;
}

}  // namespace ssphh::probes
