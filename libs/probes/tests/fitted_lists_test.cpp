/// What lists of fitted points are made of: their bits, and the surfaces that stand still.

#include <algorithm>
#include <bit>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "still_surface.h"
#include "surface_entry.h"

namespace ssphh::probes {
namespace {

TEST(StillSurface, PartsCoverTheirTriangleWithinTheBox) {
  const StillTriangle whole{{0, 0, 0}, {4, 0, 0}, {0, 3, 1}};
  const auto area = [](const StillTriangle& t) {
    return 0.5f * glm::length(glm::cross(t.b - t.a, t.c - t.a));
  };
  float sum = 0;
  visit_parts(whole, vec3(-1), vec3(5), 0.3f, [&](const StillTriangle& t) {
    sum += area(t);
    EXPECT_LE(std::max({glm::distance(t.a, t.b), glm::distance(t.b, t.c), glm::distance(t.c, t.a)}), 0.3f);
  });
  EXPECT_NEAR(sum, area(whole), 1e-3f);
  float some = 0;
  visit_parts(whole, {0, 0, -1}, {1, 1, 1}, 0.3f, [&](const StillTriangle& t) { some += area(t); });
  const float inside = std::sqrt(1 + 1.0f / 9);  // a unit square seen along z, on the triangle's slope
  EXPECT_GT(some, inside);
  EXPECT_LT(some, inside + 0.3f * 2.2f);
}

TEST(FittedEntry, PartsAreCountedByTheCut) {
  const vec3 place(0.2f, 0.55f, 0.9f);  // eighths 1, 4, 7
  EXPECT_EQ(surface_part(place, 0), 4 + 8 * 7);
  EXPECT_EQ(surface_part(place, 1), 1 + 8 * 7);
  EXPECT_EQ(surface_part(place, 2), 1 + 8 * 4);
  EXPECT_EQ(surface_part(place, cubes_cut), 0 + 4 * 2 + 16 * 3);
  EXPECT_EQ(surface_part({-1, 0.5f, 2}, 1), 0 + 8 * 7) << "the nearest part";
}

TEST(FittedEntry, PartsGrowByAllThatTouchThem) {
  for (int cut = 0; cut < cut_count; ++cut) {
    const ivec3 size = cut == cubes_cut ? ivec3(4) : ivec3(8, 8, 1);
    const auto at = [&](int part) {
      return ivec3(part % size.x, part / size.x % size.y, part / (size.x * size.y));
    };
    for (int part = 0; part < 64; ++part) {
      std::uint64_t expected = 0;
      for (int other = 0; other < 64; ++other) {
        const ivec3 d = glm::abs(at(other) - at(part));
        if (std::max({d.x, d.y, d.z}) <= 1) expected |= std::uint64_t{1} << other;
      }
      EXPECT_EQ(grown_parts(std::uint64_t{1} << part, cut), expected) << cut << " " << part;
    }
  }
}

TEST(FittedEntry, AxisIsThatOfTheLargestComponent) {
  EXPECT_EQ(surface_axis({0.9f, 0.1f, -0.3f}), 0);
  EXPECT_EQ(surface_axis({0.3f, -0.9f, 0.1f}), 1);
  EXPECT_EQ(surface_axis({0.1f, 0.3f, -0.9f}), 2);
}

/// As fitted_lookup.glsl takes an entry apart.
TEST(FittedEntry, HoldsAllOfAPointInItsBits) {
  const std::uint64_t parts = 0x123456789abcdef0ull;
  for (const int cut : {0, 1, 2, 3}) {
    const uvec4 e = pack_surface_entry(0x5bcde, 5, cut, parts, 0.125f);
    EXPECT_EQ(e.x & 0x7ffffu, 0x5bcdeu);
    EXPECT_EQ(e.x >> 19 & 7u, 5u);
    EXPECT_EQ(e.x >> 22, static_cast<std::uint32_t>(cut));
    EXPECT_EQ((static_cast<std::uint64_t>(e.z) << 32 | e.y), parts);
    EXPECT_EQ(std::bit_cast<float>(e.w), 0.125f);
  }
}

TEST(StillSurface, LeavesOutWhatMovesShinesAloneOrHasNoArea) {
  scene::Scene s;
  s.materials.resize(2);
  s.materials[1].unlit = true;
  s.meshes = {scene::make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
              scene::make_quad({0, 0, 0}, {1, 0, 0}, {2, 0, 0})};
  s.nodes.resize(2);
  s.nodes[0].local.translation = {5, 0, 0};
  s.nodes[1].movable = true;
  s.instances.resize(6);
  s.instances[0].mesh = 0, s.instances[0].node = 0;
  s.instances[1].mesh = 0, s.instances[1].node = 1;
  s.instances[2].mesh = 0, s.instances[2].material = 1;
  s.instances[3].mesh = 1;
  s.instances[4].mesh = -1;
  s.instances[5].mesh = 0, s.instances[5].material = 0;
  const std::vector<StillTriangle> found = still_triangles(s, 0);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].a, vec3(5, 0, 0));
  EXPECT_EQ(found[0].b, vec3(6, 0, 0));
  EXPECT_EQ(found[0].c, vec3(6, 1, 0));
  EXPECT_EQ(found[2].a, vec3(0)) << "at no node";
}

TEST(StillSurface, CellsListTheTrianglesThatPassThem) {
  // A long triangle along x at z 0.5, a small one in the last cell of y
  const std::vector<StillTriangle> triangles = {{{0.1f, 0.1f, 0.5f}, {2.9f, 0.1f, 0.5f}, {2.9f, 0.3f, 0.5f}},
                                                {{1.2f, 1.2f, 0.2f}, {1.4f, 1.2f, 0.2f}, {1.2f, 1.4f, 0.2f}}};
  const TriangleCells cells = triangle_cells(triangles, {0, 0, 0}, 1, {3, 2, 1});
  ASSERT_EQ(cells.first.size(), 7u);
  const auto list = [&](std::size_t cell) {
    return std::vector<std::uint32_t>(
        cells.triangles.begin() + static_cast<std::ptrdiff_t>(cells.first[cell]),
        cells.triangles.begin() + static_cast<std::ptrdiff_t>(cells.first[cell + 1]));
  };
  for (std::size_t x = 0; x < 3; ++x) EXPECT_THAT(list(x), testing::ElementsAre(0u)) << x;
  EXPECT_THAT(list(3), testing::IsEmpty());
  EXPECT_THAT(list(4), testing::ElementsAre(1u));
  EXPECT_THAT(list(5), testing::IsEmpty());
  // What lies beyond the grid belongs to no cell of it
  EXPECT_EQ(triangle_cells(triangles, {5, 5, 5}, 1, {2, 2, 2}).first.back(), 0u);
  const TriangleCells within = triangle_cells(triangles, {2, 0, 0}, 1, {2, 2, 2});
  EXPECT_EQ(within.first[1], 1u);
  EXPECT_EQ(within.first.back(), 1u) << "the long one's end";
}

}  // namespace
}  // namespace ssphh::probes
