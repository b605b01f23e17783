/// Lists of the probes that stand around a point, against all probes one after another.

#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include <ssphh/probes/candidate_grid.h>

#include "random_points.h"

namespace ssphh::probes {
namespace {

using test::random_points;

TEST(CandidateGrid, ListsHoldTheNearestOfEveryPointInOrderFromTheMiddle) {
  const std::vector<vec3> probes = random_points(300, 4);
  const CandidateGrid grid = make_candidate_grid(probes, {vec3(-4), vec3(4)}, 1.1f);
  ASSERT_GT(grid.length, CandidateGrid::wanted);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> inside(0, 1);
  const auto nearest = [&](const vec3& x) {
    std::vector<std::pair<float, int>> order;
    for (std::size_t i = 0; i < probes.size(); ++i)
      order.emplace_back(glm::distance(probes[i], x), static_cast<int>(i));
    std::sort(order.begin(), order.end());
    return order;
  };
  int full = 0;
  const int cells = grid.cells.x * grid.cells.y * grid.cells.z;
  for (int cell = 0; cell < cells; cell += 41) {
    const vec3 low =
        grid.origin + grid.cell_size * vec3(cell % grid.cells.x, cell / grid.cells.x % grid.cells.y,
                                            cell / (grid.cells.x * grid.cells.y));
    std::vector<int> list(static_cast<std::size_t>(grid.length));
    std::copy_n(grid.lists.begin() + cell * grid.length, grid.length, list.begin());
    std::erase(list, -1);
    float before = 0;
    for (const int probe : list) {
      const float d = glm::distance(probes[probe], low + 0.5f * grid.cell_size);
      EXPECT_GE(d, before);
      before = d;
    }
    if (list.size() == CandidateGrid::longest) {
      ++full;  // some may have been left out
      continue;
    }
    for (int i = 0; i < 20; ++i) {
      const auto order = nearest(low + grid.cell_size * vec3(inside(random), inside(random), inside(random)));
      for (std::size_t k = 0; k < CandidateGrid::wanted; ++k)
        EXPECT_THAT(list, testing::Contains(order[k].second));
    }
  }
  EXPECT_LT(full, cells / 41 / 3) << "most cells have all their probes";
}

TEST(CandidateGrid, NoPointIsFartherThanTheReachOfAProbeThatItMayChoose) {
  const std::vector<vec3> probes = random_points(300, 4);
  const CandidateGrid grid = make_candidate_grid(probes, {vec3(-4), vec3(4)}, 1.1f);
  const std::vector<float> reach = probe_reach(grid, probes);
  float closest = 0;  // of all distances to their probe's reach
  for (const vec3& x : random_points(2000, 4)) {
    const glm::ivec3 c(glm::floor((x - grid.origin) / grid.cell_size));
    const int cell = (c.z * grid.cells.y + c.y) * grid.cells.x + c.x;
    for (int i = 0; i < grid.length; ++i) {
      const int probe = grid.lists[cell * grid.length + i];
      if (probe < 0) break;
      const auto p = static_cast<std::size_t>(probe);
      EXPECT_LE(glm::distance(probes[p], x), reach[p]);
      closest = std::max(closest, glm::distance(probes[p], x) / reach[p]);
    }
  }
  EXPECT_GT(closest, 0.9f) << "and some are nearly as far";
}

TEST(CandidateGrid, StaysWithinItsCellsForAnySpacing) {
  const std::vector<vec3> probes = random_points(5, 1);
  const CandidateGrid fine = make_candidate_grid(probes, {vec3(-50), vec3(50)}, 1e-6f, 1000);
  EXPECT_LE(fine.cells.x * fine.cells.y * fine.cells.z, 1000);
  EXPECT_EQ(fine.length, 5) << "there are five probes only";
  const CandidateGrid one = make_candidate_grid(std::span(probes).first(1), {vec3(-1), vec3(1)},
                                                std::numeric_limits<float>::infinity());
  EXPECT_EQ(one.lists[0], 0);
}

}  // namespace
}  // namespace ssphh::probes
