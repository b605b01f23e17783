/// What finds the nearest, against all of them one after another.

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
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
    const Corners& t = triangles[static_cast<std::size_t>(found.triangle)];
    const vec3& w = found.place.weight;
    EXPECT_NEAR(glm::length(p - (w.x * t[0] + w.y * t[1] + w.z * t[2])), std::sqrt(least), 1e-5f);
    EXPECT_EQ(tree.nearest(p, 0.5f * std::sqrt(least), [](std::int32_t) { return true; }).triangle, -1);
  }
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

}  // namespace
}  // namespace ssphh::geometry
