#include <bit>

#include "parts.h"

namespace ssphh::cook {
namespace {

/// An entry as libs/probes/src/surface_entry.h packs it.
struct Entry {
  explicit Entry(const probes::uvec4& e)
      : point(e.x & 0x7ffffu),
        cover(e.x >> 19 & 7u),
        cut(e.x >> 22),
        mask(std::uint64_t{e.z} << 32 | e.y),
        spacing(std::bit_cast<float>(e.w)) {}

  std::uint32_t point, cover, cut;
  std::uint64_t mask;
  float spacing;
};

}  // namespace

void add_points(Sections& out, const probes::SurfaceLists& lists) {
  ssphh_cooked_header& h = out.header;
  h.point_count = static_cast<std::uint32_t>(lists.points.size());
  std::vector<ssphh_cooked_point> points(lists.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [position, normal, moves] = lists.points[i];
    // One that no list names has no spacing of its own
    points[i] = {
        {position.x, position.y, position.z}, lists.grids[0].cell_size, {normal.x, normal.y, normal.z}, 0};
  }

  constexpr std::uint64_t all = ~std::uint64_t{0};
  std::vector<ssphh_cooked_cell> cells;
  std::uint32_t brick_count = 0;
  for (std::size_t g = 0; g < lists.grids.size(); ++g) {
    const probes::SurfaceGrid& grid = lists.grids[g];
    ssphh_cooked_grid& to = h.surface_grids[g];
    to = {{grid.origin.x, grid.origin.y, grid.origin.z}, grid.cell_size, {}, brick_count};
    for (glm::length_t c = 0; c < 3; ++c) to.cells[c] = static_cast<std::uint32_t>(grid.cells[c]);
    const probes::ivec3 bricks = (grid.cells + 3) / 4;
    for (int z = 0; z < bricks.z; ++z) {
      for (int y = 0; y < bricks.y; ++y) {
        for (int x = 0; x < bricks.x; ++x) {
          ssphh_cooked_brick brick{0, static_cast<std::uint32_t>(cells.size()), 0};
          for (int bit = 0; bit < 64; ++bit) {
            const probes::ivec3 at(4 * x + bit % 4, 4 * y + bit / 4 % 4, 4 * z + bit / 16);
            if (glm::any(glm::greaterThanEqual(at, grid.cells))) continue;
            const probes::uvec2 range =
                lists.ranges[grid.first +
                             static_cast<std::size_t>((at.z * grid.cells.y + at.y) * grid.cells.x + at.x)];
            if (range.y == 0) continue;
            brick.mask |= std::uint64_t{1} << bit;
            cells.push_back({h.entry_count, h.mask_count});
            for (unsigned k = 0; k < range.y; ++k) {
              const Entry entry(lists.lists[range.x + k]);
              points[entry.point].spacing = entry.spacing;
              points[entry.point].cover = entry.cover;
              const bool masked = entry.mask != all;
              const std::uint32_t how = SSPHH_COOKED_MASKED | entry.cut << SSPHH_COOKED_CUT_SHIFT;
              out.append(SSPHH_COOKED_ENTRIES, entry.point | (masked ? how : 0u));
              if (masked) out.append(SSPHH_COOKED_MASKS, entry.mask);
              h.mask_count += masked;
              ++h.entry_count;
            }
          }
          out.append(SSPHH_COOKED_BRICKS, brick);
          ++brick_count;
        }
      }
    }
  }
  h.cell_count = static_cast<std::uint32_t>(cells.size());
  cells.push_back({h.entry_count, h.mask_count});
  out.append(SSPHH_COOKED_CELLS, std::span<const ssphh_cooked_cell>(cells));
  out.append(SSPHH_COOKED_POINTS, std::span<const ssphh_cooked_point>(points));
}

}  // namespace ssphh::cook
