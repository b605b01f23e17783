/// Cells of a wide plain share their lists, where nothing stands between them and the points.

#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/probes/surface_lists.h>
#include <ssphh/scene/primitives.h>

#include "surface_entry.h"

namespace ssphh::probes {
namespace {

constexpr vec3 up{0, 1, 0};

/// 64 m along each side, from the origin on.
scene::Scene plain() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.meshes.push_back(scene::make_quad({0, 0, 0}, {0, 0, 64}, {64, 0, 0}));
  scene.instances = {{0, 0, -1, ""}};
  return scene;
}

/// Half a metre apart in a corner of 8 m, then four metres.
std::vector<rays::SurfacePoint> points() {
  std::vector<rays::SurfacePoint> out;
  const auto add = [&](float from, float to, float apart) {
    for (float z = from + 0.5f * apart; z < to; z += apart) {
      for (float x = from + 0.5f * apart; x < to; x += apart)
        if (apart < 1 || x > 8 || z > 8) out.push_back({{x, 0, z}, up});
    }
  };
  add(0, 8, 0.5f);
  add(0, 64, 4);
  return out;
}

std::size_t cell_at(const SurfaceGrid& grid, const vec3& x, vec3& within) {
  const vec3 u = (x - grid.origin) / grid.cell_size;
  const ivec3 cell(glm::floor(u));
  within = u - vec3(cell);
  return static_cast<std::size_t>((cell.z * grid.cells.y + cell.y) * grid.cells.x + cell.x);
}

/// The points that are listed where x lies.
std::set<std::uint32_t> listed(const SurfaceLists& lists, const vec3& x) {
  vec3 within;
  const uvec2 range = lists.ranges[cell_at(lists.grids[0], x, within)];
  std::set<std::uint32_t> found;
  for (unsigned i = range.x; i < range.x + range.y; ++i) {
    const uvec4 entry = lists.lists[i];
    const std::uint64_t parts = entry.y | std::uint64_t{entry.z} << 32;
    if (parts >> surface_part(within, static_cast<int>(entry.x >> 22)) & 1) found.insert(entry.x & 0x7ffffu);
  }
  return found;
}

std::size_t number_of_lists(const SurfaceLists& lists) {
  std::set<std::uint32_t> first;
  for (const uvec2& range : lists.ranges)
    if (range.y > 0) first.insert(range.x);
  return first.size();
}
std::size_t number_of_cells(const SurfaceLists& lists) {
  std::size_t count = 0;
  for (const uvec2& range : lists.ranges) count += range.y > 0;
  return count;
}

TEST(SharedLists, HaveThePointsThatALookupByRaysTakes) {
  const auto everything = [](const vec3&, const vec3&) { return true; };
  const SurfaceLists lists = prepare_surfaces(plain(), 0, points(), everything);
  ASSERT_EQ(lists.grids[1].count(), 0u) << "one grid is asked here";
  // Cells of a third of a metre; far from the corner 64 of them have one list
  EXPECT_GT(number_of_cells(lists), 20'000u);
  EXPECT_LT(number_of_lists(lists), number_of_cells(lists) / 8);
  const SurfaceInterpolation by_rays(points(), everything);
  Pcg32 random(3);
  for (int i = 0; i < 2000; ++i) {
    const float side = i % 2 == 0 ? 64.0f : 12.0f;
    const vec3 x(side * random.uniform(), 0, side * random.uniform());
    const std::set<std::uint32_t> here = listed(lists, x);
    SurfaceShares shares;
    for (const SurfaceShare& share : by_rays.at({x, up}, shares)) {
      EXPECT_TRUE(std::abs(share.weight) < 0.01f || here.contains(share.point))
          << share.weight << " at " << x.x << " " << x.z;
    }
  }
}

TEST(SharedLists, EndWhereSomethingStandsInTheWay) {
  constexpr float wall = 41.3f;
  const auto sees = [](const vec3& a, const vec3& b) { return (a.x < wall) == (b.x < wall); };
  const SurfaceLists lists = prepare_surfaces(plain(), 0, points(), sees);
  const float part = lists.grids[0].cell_size / 8;
  Pcg32 random(4);
  int beside = 0;
  for (int i = 0; i < 2000; ++i) {
    const vec3 x(wall + 16 * (random.uniform() - 0.5f), 0, 8 + 56 * random.uniform());
    if (std::abs(x.x - wall) < part) continue;
    const std::set<std::uint32_t> here = listed(lists, x);
    EXPECT_FALSE(here.empty());
    for (const std::uint32_t p : here) {
      EXPECT_EQ(lists.points[p].position.x < wall, x.x < wall)
          << lists.points[p].position.x << " from " << x.x;
      beside += std::abs(lists.points[p].position.x - wall) < 4;
    }
  }
  EXPECT_GT(beside, 1000);
  EXPECT_LT(number_of_lists(lists), number_of_cells(lists) / 3) << "far from the wall they are shared";
}

}  // namespace
}  // namespace ssphh::probes
