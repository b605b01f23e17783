/// What finds the nearest, against all of them one after another.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/geometry/balls.h>
#include <ssphh/geometry/box.h>
#include <ssphh/geometry/near_grid.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/geometry/triangle_tree.h>

#include "error_message.h"

namespace ssphh::geometry {
namespace {

TEST(NearGrid, FindsAllNearerThanTheRadiusInTheirOrder) {
  Pcg32 random(4);
  NearGrid grid(1.5f);
  std::vector<vec3> points;
  for (int i = 0; i < 400; ++i) grid.add(points.emplace_back(8.0f * random.uniform3() - 4.0f));
  EXPECT_EQ(grid.size(), 400u);
  for (const float radius : {0.4f, 1.5f}) {
    for (int q = 0; q < 50; ++q) {
      const vec3 at = 8.0f * random.uniform3() - 4.0f;
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < points.size(); ++i)
        if (glm::distance(points[i], at) < radius) expected.push_back(i);
      EXPECT_EQ(grid.near(at, radius), expected);
    }
  }
}

TEST(Boxes, AreApartAlongAnyAxisAndNotWhereTheyTouch) {
  const vec3 low(1, 2, 3), high(2, 4, 6);
  for (int axis = 0; axis < 3; ++axis) {
    vec3 beside(0), gap(0);
    beside[axis] = high[axis] - low[axis], gap[axis] = 0.01f;
    EXPECT_FALSE(apart(low, high, low + beside, high + beside)) << axis;
    EXPECT_FALSE(apart(low, high, low - beside, high - beside)) << axis;
    EXPECT_TRUE(apart(low, high, low + beside + gap, high + beside + gap)) << axis;
    EXPECT_TRUE(apart(low, high, low - beside - gap, high - beside - gap)) << axis;
  }
  EXPECT_FALSE(apart(low, high, vec3(0), vec3(9))) << "one within the other";
  EXPECT_FALSE(apart(low, high, vec3(NAN), vec3(NAN)));
}

TEST(Balls, ThatHoldAPlaceOrTouchABoxAreThoseOfAll) {
  Pcg32 random(8);
  for (const int number : {0, 1, 8, 9, 17, 500}) {
    std::vector<vec3> centres;
    std::vector<float> radii;
    for (int i = 0; i < number; ++i) {
      centres.push_back(9.0f * random.uniform3());
      radii.push_back(i % 7 == 0 ? 0 : std::exp2(6 * random.uniform() - 4));
    }
    const Balls balls(centres, radii);
    EXPECT_EQ(balls.count(), centres.size());
    for (int q = 0; q < 100; ++q) {
      const vec3 low = 11.0f * random.uniform3() - 1.0f;
      const vec3 high = q % 2 == 0 ? low : low + 2.0f * random.uniform3();
      std::vector<std::uint32_t> expected, found;
      for (std::uint32_t i = 0; i < centres.size(); ++i) {
        if (glm::distance(centres[i], glm::clamp(centres[i], low, high)) < radii[i]) expected.push_back(i);
      }
      balls.visit_box(low, high, [&](std::uint32_t i, float distance2) {
        EXPECT_FLOAT_EQ(std::sqrt(distance2), glm::distance(centres[i], glm::clamp(centres[i], low, high)));
        found.push_back(i);
      });
      std::ranges::sort(found);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(Balls, ThatAreNoneAreRefused) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<vec3> centres(2, vec3(0));
  EXPECT_THROW(Balls(centres, std::vector<float>{1}), Error);
  EXPECT_THROW(Balls(centres, std::vector<float>{1, -1}), Error);
  EXPECT_THROW(Balls(centres, std::vector<float>{1, inf}), Error);
  EXPECT_THROW(Balls(std::vector<vec3>{vec3(0), vec3(inf)}, std::vector<float>{1, 1}), Error);
}

TEST(TriangleTree, NearestIsThatOfAllTriangles) {
  std::vector<Corners> triangles;
  Pcg32 random(11);
  for (int i = 0; i < 300; ++i) {
    const vec3 at = 5.0f * random.uniform3();
    triangles.push_back({at, at + random.uniform3(), i % 10 == 0 ? at : at + random.uniform3()});
  }
  const TriangleTree tree(triangles);
  for (int i = 0; i < 500; ++i) {
    const vec3 p = 9.0f * random.uniform3() - 2.0f;
    float least = std::numeric_limits<float>::infinity();
    for (const Corners& t : triangles) least = std::min(least, nearest_on_triangle(t, p).distance2);
    const TriangleTree::Found found = tree.nearest(p);
    EXPECT_EQ(found.place.distance2, least);
    const Corners& t = triangles[found.triangle];
    const vec3& w = found.place.weight;
    EXPECT_NEAR(glm::length(p - (w.x * t[0] + w.y * t[1] + w.z * t[2])), std::sqrt(least), 1e-5f);
    EXPECT_EQ(tree.nearest(p, 0.5f * std::sqrt(least), [](std::int32_t) { return true; }).triangle, -1);
  }
}

TEST(TriangleTree, OfEquallyNearOnesTheFirstAndOneAtItsReach) {
  // Five times the same on either side, those with the lower indices where boxes are opened last.
  std::vector<Corners> triangles(10, {vec3(1, 0, 0), vec3(1, 1, 0), vec3(1, 0, 1)});
  for (std::size_t i = 5; i < 10; ++i)
    for (vec3& corner : triangles[i]) corner.x = -1;
  const TriangleTree tree(triangles);
  const vec3 p(0, 0.25f, 0.25f);
  const auto all = [](std::int32_t) { return true; };
  EXPECT_EQ(tree.nearest(p).triangle, 0);
  EXPECT_EQ(tree.nearest(p, 1, all).triangle, 0) << "within its reach, itself included";
  EXPECT_EQ(tree.nearest(p, 0.999f, all).triangle, -1);
  EXPECT_EQ(tree.nearest(p, 9, [](std::int32_t i) { return i > 3; }).triangle, 4);
  EXPECT_EQ(tree.nearest(p - vec3(0.5f, 0, 0), 9, all).triangle, 5);
  EXPECT_EQ(TriangleTree().nearest(p).triangle, -1);
}

TEST(TriangleTree, TakesAsMuchAsItsTrianglesAndBoxes) {
  const Corners one{vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
  // Corners and an index each; of four one box with its range, of five that and two below it.
  EXPECT_EQ(TriangleTree(std::vector<Corners>(4, one)).bytes(), 4u * (36 + 4) + 32);
  EXPECT_EQ(TriangleTree(std::vector<Corners>(5, one)).bytes(), 5u * (36 + 4) + 3 * 32);
  EXPECT_EQ(TriangleTree().bytes(), 0u);
  EXPECT_EQ(TriangleTree(std::vector<Corners>(5, one)).triangles().size(), 5u);
}

TEST(NearestPoints, TakeAsMuchAsTheirPlacesAndTree) {
  const std::vector<vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};
  // A place and its index, and the axis of a split.
  EXPECT_EQ(NearestPoints(five).bytes(), 5u * (16 + 1));
}

TEST(NearestPoints, RefuseWhatIsNotFinite) {
  constexpr float endless = std::numeric_limits<float>::infinity();
  EXPECT_EQ(test::message_of([] {
              NearestPoints(std::vector<vec3>{vec3(0), vec3(endless)});
            }),
            "nearest points: a point is not finite");
}

TEST(TriangleTree, HasFoundNothingAtFirst) {
  EXPECT_EQ(OnTriangle().weight, vec3(1, 0, 0));
  EXPECT_EQ(TriangleTree::Found().triangle, -1);
}

TEST(NearestOnTriangle, IsWithinOnEachEdgeAndAtEachCorner) {
  const Corners triangle{vec3(0, 0, 0), vec3(2, 0, 0), vec3(0, 4, 0)};
  const auto expect = [&](const vec3& p, const vec3& weight, float distance2) {
    const OnTriangle found = nearest_on_triangle(triangle, p);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.weight[c], weight[c], 1e-6f) << p.x << " " << p.y;
    EXPECT_NEAR(found.distance2, distance2, 1e-5f);
  };
  expect({0.5f, 1, 3}, {0.5f, 0.25f, 0.25f}, 9);
  expect({1, -2, 0}, {0.5f, 0.5f, 0}, 4);
  expect({3, 3, 0}, {0, 0.5f, 0.5f}, 5);
  expect({-1, 1, 1}, {0.75f, 0, 0.25f}, 2);
  expect({-1, -1, 0}, {1, 0, 0}, 2);
  expect({4, -1, 0}, {0, 1, 0}, 5);
  expect({-1, 6, 0}, {0, 0, 1}, 5);
}

TEST(NearestOnTriangle, OfASegmentOrAPointIsThatOfTheSegmentOrPoint) {
  const vec3 a(1, 2, 3), b(1, 4, 3), p(0, 3, 3);
  for (const Corners& segment : {Corners{a, a, b}, {a, b, b}, {a, b, a}, {a, 0.5f * (a + b), b}}) {
    const OnTriangle found = nearest_on_triangle(segment, p);
    EXPECT_EQ(found.distance2, 1);
    EXPECT_EQ(found.weight.x * segment[0] + found.weight.y * segment[1] + found.weight.z * segment[2],
              vec3(1, 3, 3));
  }
  EXPECT_EQ(nearest_on_triangle({a, a, a}, p).distance2, 2);
}

TEST(NearGrid, LooksIntoAllCellsAround) {
  NearGrid grid(1);
  for (int i = 0; i < 27; ++i) grid.add(0.5f + vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
  EXPECT_EQ(grid.near(vec3(0.5f), 1).size(), 1u) << "nearer than a metre is one alone";
  EXPECT_EQ(grid.near(vec3(0.999f), 1), (std::vector<std::uint32_t>{13, 14, 16, 17, 22, 23, 25, 26}));
  EXPECT_EQ(grid.near(vec3(0.001f), 1), (std::vector<std::uint32_t>{0, 1, 3, 4, 9, 10, 12, 13}));
}

}  // namespace
}  // namespace ssphh::geometry
