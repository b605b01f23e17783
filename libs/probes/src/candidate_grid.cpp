#include <algorithm>
#include <atomic>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/candidate_grid.h>

namespace ssphh::probes {
namespace {

/// The part of `near`, sorted by distance from the middle of a cube of half side `half`, that may be among
/// the `wanted` nearest of some point of the cube; moved to the front, in order.
std::size_t keep_possible(std::span<geometry::Near> near, std::span<const vec3> probes, const vec3& middle,
                          float half) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    // |x − a|² − |x − b|² is linear in x: it is below 0 all over the cube if it is at its worst corner
    int nearer = 0;
    const vec3 b = probes[near[i].index] - middle;
    for (std::size_t j = 0; j < i && nearer < CandidateGrid::wanted; ++j) {
      const vec3 a = probes[near[j].index] - middle;
      const vec3 apart = glm::abs(a - b);
      nearer += glm::dot(a, a) - glm::dot(b, b) + 2 * half * (apart.x + apart.y + apart.z) < 0;
    }
    if (nearer < CandidateGrid::wanted) near[kept++] = near[i];
  }
  return kept;
}

}  // namespace

CandidateGrid make_candidate_grid(std::span<const vec3> probes, const scene::Bounds& bounds, float spacing,
                                  std::size_t most_cells) {
  CandidateGrid grid;
  const vec3 extent = glm::max(bounds.max - bounds.min, vec3(1e-6f));
  grid.origin = bounds.min;
  grid.cell_size = std::isfinite(spacing) && spacing > 0 ? spacing / 3 : max_component(extent);
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
  constexpr auto stride = static_cast<std::size_t>(CandidateGrid::longest);
  std::vector<int> lists(count * stride, -1);
  std::atomic<int> longest = 1;
  const geometry::NearestPoints nearest(probes);
  const float half = 0.5f * grid.cell_size, diagonal = 2 * std::sqrt(3.0f) * half;
  parallel_for(count, 64, [&](std::size_t begin, std::size_t end) {
    std::vector<geometry::Near> near(4 * stride);
    for (std::size_t cell = begin; cell < end; ++cell) {
      const auto c = static_cast<int>(cell);
      const vec3 place(c % grid.cells.x, c / grid.cells.x % grid.cells.y, c / (grid.cells.x * grid.cells.y));
      const vec3 middle = grid.origin + grid.cell_size * (place + 0.5f);
      const int wanted = nearest.find(middle, std::span(near).first(CandidateGrid::wanted));
      if (wanted == 0) continue;
      const float farthest = std::sqrt(near[wanted - 1].distance2);
      const int found = nearest.find(middle, near, farthest + diagonal);
      const std::size_t possible =
          keep_possible(std::span(near).first(static_cast<std::size_t>(found)), probes, middle, half);
      const std::size_t kept = std::min(possible, stride);
      for (std::size_t i = 0; i < kept; ++i) lists[cell * stride + i] = near[i].index;
      int before = longest;
      while (before < static_cast<int>(kept) &&
             !longest.compare_exchange_weak(before, static_cast<int>(kept))) {
      }
    }
  });
  grid.length = longest;
  const auto length = static_cast<std::size_t>(grid.length);
  for (std::size_t cell = 0; cell < count; ++cell)
    std::copy_n(lists.begin() + static_cast<std::ptrdiff_t>(cell * stride), length,
                lists.begin() + static_cast<std::ptrdiff_t>(cell * length));
  lists.resize(count * length);
  grid.lists = std::move(lists);
  return grid;
}

std::vector<float> probe_reach(const CandidateGrid& grid, std::span<const vec3> probes) {
  const auto size = static_cast<std::size_t>(grid.length) * static_cast<std::size_t>(grid.cells.x) *
                    static_cast<std::size_t>(grid.cells.y) * static_cast<std::size_t>(grid.cells.z);
  require(
      grid.lists.size() == size &&
          std::ranges::all_of(grid.lists, [&](int probe) { return probe < static_cast<int>(probes.size()); }),
      "candidate grid", "it is of other probes");
  std::vector<float> reach(probes.size(), 0);
  std::size_t entry = 0;
  for (int z = 0; z < grid.cells.z; ++z) {
    for (int y = 0; y < grid.cells.y; ++y) {
      for (int x = 0; x < grid.cells.x; ++x) {
        const vec3 low = grid.origin + grid.cell_size * vec3(x, y, z), high = low + grid.cell_size;
        for (int i = 0; i < grid.length; ++i, ++entry) {
          if (grid.lists[entry] < 0) continue;
          const auto probe = static_cast<std::size_t>(grid.lists[entry]);
          const vec3 farthest = glm::max(glm::abs(low - probes[probe]), glm::abs(high - probes[probe]));
          reach[probe] = std::max(reach[probe], glm::length(farthest));
        }
      }
    }
  }
  return reach;
}

}  // namespace ssphh::probes
