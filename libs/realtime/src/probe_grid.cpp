#include "probe_grid.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>

namespace ssphh::realtime {

ProbeGrid make_probe_grid(std::span<const vec3> probes, const scene::Bounds& bounds, float spacing,
                          std::size_t most_cells) {
  ProbeGrid grid;
  const vec3 extent = glm::max(bounds.max - bounds.min, vec3(1e-6f));
  grid.origin = bounds.min;
  grid.cell_size = std::isfinite(spacing) ? 0.5f * spacing : max_component(extent);
  const auto cells_of = [&](float size) { return glm::max(glm::ivec3(glm::ceil(extent / size)), 1); };
  // Twice the side, an eighth of the cells; as floats, for absurd spacings overflow integers
  const auto too_many = [&](float size) {
    const vec3 n = glm::ceil(extent / size);
    return n.x * n.y * n.z > static_cast<float>(most_cells);
  };
  while (too_many(grid.cell_size)) grid.cell_size *= 1.26f;
  grid.cells = cells_of(grid.cell_size);

  const auto count = static_cast<std::size_t>(grid.cells.x) * static_cast<std::size_t>(grid.cells.y) *
                     static_cast<std::size_t>(grid.cells.z);
  constexpr auto length = static_cast<std::size_t>(ProbeGrid::list_length);
  grid.lists.assign(count * length, -1);
  parallel_for(count, 64, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<float, int>> order(probes.size());
    for (std::size_t cell = begin; cell < end; ++cell) {
      const auto c = static_cast<int>(cell);
      const vec3 place(c % grid.cells.x, c / grid.cells.x % grid.cells.y, c / (grid.cells.x * grid.cells.y));
      const vec3 middle = grid.origin + grid.cell_size * (place + 0.5f);
      for (std::size_t i = 0; i < probes.size(); ++i) {
        const vec3 d = probes[i] - middle;
        order[i] = {glm::dot(d, d), static_cast<int>(i)};
      }
      const std::size_t kept = std::min(length, order.size());
      std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end());
      for (std::size_t i = 0; i < kept; ++i) grid.lists[cell * length + i] = order[i].second;
    }
  });
  return grid;
}

}  // namespace ssphh::realtime
