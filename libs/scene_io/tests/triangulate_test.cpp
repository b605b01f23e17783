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

TEST(Triangulate, EveryEarThatIsTriedCostsAsManyTestsAsThereAreCorners) {
  // Going round from corner 0 the second ear fits: the notch at corner 3 stands in the first.
  const std::vector<vec3> arrow = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5f, 0}};
  std::vector<uvec3> triangles;
  std::uint64_t work = 100;
  triangulate(arrow, work, triangles);
  EXPECT_EQ(work, 100u - 2 * 4);
  EXPECT_EQ(triangles, (std::vector<uvec3>{{1, 2, 3}, {0, 1, 3}}));
  work = 7, triangles.clear();
  triangulate(arrow, work, triangles);
  EXPECT_EQ(work, 3u) << "the second try is not paid for";
  EXPECT_EQ(triangles, (std::vector<uvec3>{{0, 1, 2}, {0, 2, 3}})) << "the rest is a fan";
  work = 8, triangles.clear();
  triangulate(arrow, work, triangles);
  EXPECT_EQ(work, 0u);
  EXPECT_EQ(triangles[0], uvec3(1, 2, 3));
  triangles.clear(), work = 100;
  triangulate(std::vector<vec3>{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, work, triangles);
  EXPECT_EQ(work, 100u) << "a convex polygon costs nothing";
  EXPECT_EQ(triangles, (std::vector<uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

/// The same arrow seen along every axis from either side, tilted: each time projected where it is widest.
TEST(Triangulate, PolygonsOfEveryDirectionAreCutAlike) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      for (const float tilt : {-0.7f, 0.0f, 0.7f}) {
        std::vector<vec3> arrow;
        for (const vec2 p : {vec2(0, 0), vec2(2, 0), vec2(2, 2), vec2(1, 0.5f)}) {
          vec3 at(0);
          at[(axis + 1) % 3] = side * p.x, at[(axis + 2) % 3] = p.y,
                          at[axis] = tilt * p.x + 0.2f * tilt * p.y;
          arrow.push_back(at);
        }
        std::uint64_t work = 100;
        std::vector<uvec3> triangles;
        triangulate(arrow, work, triangles);
        EXPECT_EQ(triangles, (std::vector<uvec3>{{1, 2, 3}, {0, 1, 3}})) << axis << side << tilt;
      }
    }
  }
}

TEST(Triangulate, ACornerOnAnEdgeBlocksAnEarAndOneInItsCornersPlaceDoesNot) {
  const auto cut = [](const std::vector<vec3>& polygon) {
    std::vector<uvec3> triangles;
    std::uint64_t work = 1000;
    triangulate(polygon, work, triangles);
    return triangles;
  };
  // The notch touches the diagonal of the ear (0, 1, 2).
  EXPECT_EQ(cut({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}})[0], uvec3(1, 2, 3));
  // A square of side 8 with a square hole of side 2, joined to it by a way there and back between two places
  // that are two corners each; in every turn and mirrored.
  for (int turn = 0; turn < 8; ++turn) {
    std::vector<vec3> frame = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {0, 0, 0},
                               {3, 3, 0}, {3, 5, 0}, {5, 5, 0}, {5, 3, 0}, {3, 3, 0}};
    for (vec3& p : frame) {
      if (turn >= 4) p.x = -p.x;
      for (int k = 0; k < turn % 4; ++k) p = {-p.y, p.x, 0};
    }
    const Areas a = areas(frame);
    EXPECT_DOUBLE_EQ(std::abs(a.signed_area), 60) << turn;
    EXPECT_DOUBLE_EQ(a.total, 60) << turn;
  }
}

TEST(Triangulate, AllCornersInOnePlaceEnd) {
  const std::vector<vec3> nothing(100, vec3(1));
  EXPECT_EQ(areas(nothing).total, 0);
}

}  // namespace
}  // namespace ssphh::scene_io
