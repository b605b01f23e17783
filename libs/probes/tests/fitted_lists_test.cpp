/// What lists of fitted points are made of: their bits, and the surfaces that stand still.

#include <algorithm>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "random_points.h"
#include "still_surface.h"
#include "surface_entry.h"

namespace ssphh::probes {
namespace {

using test::random_points;

TEST(FittedEntry, NormalsKeepTheirDirectionAndAxesExactly) {
  for (const vec3& n : {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)})
    EXPECT_EQ(CoarseNormal::of(n).unit(), n);
  for (vec3 n : random_points(500, 1)) {
    n = glm::normalize(n);
    // A step of 2/62 on the map is at most 0.09 on the sphere, of which half and that across the diagonal
    EXPECT_GT(glm::dot(CoarseNormal::of(n).unit(), n), std::cos(0.07f));
  }
}

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

TEST(FittedEntry, SquaresAreCountedAcrossTheAxis) {
  const vec3 place(0.2f, 0.55f, 0.9f);  // squares 1, 4, 7
  EXPECT_EQ(surface_square(place, 0), 4 + 8 * 7);
  EXPECT_EQ(surface_square(place, 1), 1 + 8 * 7);
  EXPECT_EQ(surface_square(place, 2), 1 + 8 * 4);
  EXPECT_EQ(surface_square({-1, 0.5f, 2}, 1), 0 + 8 * 7) << "the nearest square";
}

TEST(FittedEntry, AxisIsThatOfTheLargestComponent) {
  EXPECT_EQ(CoarseNormal::of({0.9f, 0.1f, -0.3f}).axis(), 0);
  EXPECT_EQ(CoarseNormal::of({0.3f, -0.9f, 0.1f}).axis(), 1);
  EXPECT_EQ(CoarseNormal::of({0.1f, 0.3f, -0.9f}).axis(), 2);
  EXPECT_EQ((CoarseNormal{0, 0}.axis()), 2);
}

/// As fitted_lookup.glsl takes an entry apart.
TEST(FittedEntry, HoldsAllOfAPointInItsBits) {
  const std::uint64_t squares = 0x123456789abcdef0ull;
  for (const CoarseNormal& normal : {CoarseNormal{-31, 0}, {31, -5}, {-7, 30}, {0, -1}}) {
    const uvec4 e = pack_surface_entry(0x5bcde, 5, {-6, 0.5f, 7}, normal, squares);
    EXPECT_EQ(e.x >> 10 & 0x7ffffu, 0x5bcdeu);
    EXPECT_EQ(e.x >> 29, 5u);
    EXPECT_EQ(static_cast<int>((e.x >> 5 & 31u) | (e.y >> 30 & 1u) << 5) - 32, normal.u);
    EXPECT_EQ(static_cast<int>((e.x & 31u) | (e.y >> 31) << 5) - 32, normal.v);
    EXPECT_EQ(e.y & 1023u, 0u);
    EXPECT_NEAR(static_cast<double>(e.y >> 10 & 1023u) * 13 / 1023 - 6, 0.5, 6.51 / 1023);
    EXPECT_EQ(e.y >> 20 & 1023u, 1023u);
    EXPECT_EQ((static_cast<std::uint64_t>(e.w) << 32 | e.z), squares);
  }
  const uvec4 far = pack_surface_entry(0, 0, {-9, 2, 99}, {}, 0);
  EXPECT_EQ(far.y & 1023u, 0u) << "as near as there is room for";
  EXPECT_EQ(far.y >> 20 & 1023u, 1023u);
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
  // What lies beyond the grid belongs to its edge
  const TriangleCells moved = triangle_cells(triangles, {5, 5, 5}, 1, {2, 2, 2});
  EXPECT_EQ(moved.first[1] - moved.first[0], 2u);
  EXPECT_EQ(moved.first.back(), 2u);
}

}  // namespace
}  // namespace ssphh::probes
