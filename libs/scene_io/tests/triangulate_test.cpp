#include "triangulate.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ssphh::scene_io {
namespace {

// Signed area along z of all triangles, and their total size.
struct Areas {
  double signed_area = 0, total = 0;
};

Areas areas(const std::vector<vec3>& polygon, std::uint64_t work = 1'000'000) {
  std::vector<uvec3> triangles;
  triangulate(polygon, work, triangles);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  Areas out;
  for (const uvec3& t : triangles) {
    const vec3 a = polygon[t.x], b = polygon[t.y], c = polygon[t.z];
    const double area = 0.5 * double{(b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)};
    out.signed_area += area;
    out.total += std::abs(area);
  }
  return out;
}

TEST(Triangulate, ConcavePolygonIsCoveredOnceAndNotBeyond) {
  // An arrow head: area 1 − 1/2·… by the shoelace formula: (0,0) (2,0) (2,2) (1,0.5) → 1/2 |0 + 4 + (1 − 2) +
  // 0| = 1.5
  const std::vector<vec3> arrow = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5f, 0}};
  const Areas a = areas(arrow);
  EXPECT_DOUBLE_EQ(a.signed_area, 1.5);
  EXPECT_DOUBLE_EQ(a.total, 1.5) << "no triangle lies outside";
}

TEST(Triangulate, CombWithManyNotchesIsCoveredOnce) {
  std::vector<vec3> comb = {{0, 0, 0}, {20, 0, 0}};
  for (int x = 20; x > 0; --x) comb.emplace_back(static_cast<float>(x) - 0.5f, x % 2 == 0 ? 3.0f : 1.0f, 0);
  double shoelace = 0;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const vec3 a = comb[i], b = comb[(i + 1) % comb.size()];
    shoelace += 0.5 * double{a.x * b.y - b.x * a.y};
  }
  const Areas a = areas(comb);
  EXPECT_NEAR(a.signed_area, shoelace,
              1e-9);  // sums of small multiples of 1/4: exact up to the order of addition
  EXPECT_NEAR(a.total, shoelace, 1e-9);
}

TEST(Triangulate, ClockwisePolygonsKeepTheirOrientation) {
  const std::vector<vec3> arrow = {{1, 0.5f, 0}, {2, 2, 0}, {2, 0, 0}, {0, 0, 0}};
  const Areas a = areas(arrow);
  EXPECT_DOUBLE_EQ(a.signed_area, -1.5);
  EXPECT_DOUBLE_EQ(a.total, 1.5);
}

TEST(Triangulate, WithoutBudgetAFanStillHasAllTriangles) {
  const std::vector<vec3> arrow = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5f, 0}};
  EXPECT_DOUBLE_EQ(areas(arrow, 0).signed_area, 1.5) << "signed areas of a fan add up in any case";
}

TEST(Triangulate, AllCornersInOnePlaceEnd) {
  const std::vector<vec3> nothing(100, vec3(1));
  EXPECT_EQ(areas(nothing).total, 0);
}

}  // namespace
}  // namespace ssphh::scene_io
