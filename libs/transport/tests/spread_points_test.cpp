/// Points thinned out evenly: their number, their spread, and both sides of a wall.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/transport/fitted_weights.h>

namespace ssphh::transport {
namespace {

/// Random places on a floor of 8 m × 8 m and on both sides of a wall of no thickness across it.
std::vector<rays::SurfacePoint> floor_and_wall(int count) {
  Pcg32 random(1);
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    const float u = 8 * random.uniform(), v = 8 * random.uniform();
    points.push_back({{u, 0, v}, {0, 1, 0}});
    points.push_back({{4, v, u}, {i % 2 ? -1.0f : 1.0f, 0, 0}});
  }
  return points;
}

TEST(SpreadPoints, AreAsManyAsAskedForAndOfThePointsInTheirOrder) {
  const std::vector<rays::SurfacePoint> points = floor_and_wall(4000);
  for (const int count : {1, 5, 6, 100, 1000, 5000}) {
    const std::vector<rays::SurfacePoint> spread = spread_points(points, count);
    EXPECT_LE(spread.size(), static_cast<std::size_t>(count));
    // A floor of 5² cells and a wall of as many on each side are 75; 6² would be 108
    if (count >= 100) {
      EXPECT_GT(spread.size(), static_cast<std::size_t>(0.69 * count));
    }
    auto at = points.begin();
    for (const rays::SurfacePoint& p : spread) {
      at = std::find_if(at, points.end(), [&](const rays::SurfacePoint& q) {
        return q.position == p.position && q.normal == p.normal;
      });
      ASSERT_NE(at, points.end());
    }
  }
  EXPECT_EQ(spread_points(points, 8000).size(), points.size());
  EXPECT_TRUE(spread_points({}, 5).empty());
  EXPECT_THROW(spread_points(points, 0), Error);
}

TEST(SpreadPoints, LeaveNoPlaceFarFromOneThatFacesTheSameWay) {
  const std::vector<rays::SurfacePoint> points = floor_and_wall(4000);
  const std::vector<rays::SurfacePoint> spread = spread_points(points, 300);
  // 192 m² in 300 cells of 0.8 m: two points of one cell are no farther apart than its diagonal
  for (const rays::SurfacePoint& p : points) {
    float nearest = 1e9f;
    for (const rays::SurfacePoint& q : spread) {
      if (q.normal == p.normal) nearest = std::min(nearest, glm::distance(p.position, q.position));
    }
    EXPECT_LT(nearest, 1.05f * 0.8f * std::sqrt(2.0f));
  }
}

TEST(SpreadPoints, OfALevelStandTwiceAsFarApartAsOfTheOneBelow) {
  // A floor of 8 m × 8 m, its halves of levels 0 and 2: sixteen times as many points in the first
  Pcg32 random(5);
  std::vector<rays::SurfacePoint> points;
  std::vector<int> levels;
  for (int i = 0; i < 20000; ++i) {
    points.push_back({{8 * random.uniform(), 0, 8 * random.uniform()}, {0, 1, 0}});
    levels.push_back(points.back().position.x < 4 ? 0 : 2);
  }
  int fine = 0, coarse = 0;
  for (const rays::SurfacePoint& p : spread_points(points, 1100, levels))
    ++(p.position.x < 4 ? fine : coarse);
  EXPECT_NEAR(static_cast<double>(fine) / coarse, 16, 4) << "cells at the edges are cut";
  EXPECT_THROW(spread_points(points, 1100, std::span(levels).first(3)), Error);
}

TEST(SpreadPoints, KeepOneForEachOfSixSides) {
  // Two points of each side in the same place, the normals a little aslant.
  std::vector<rays::SurfacePoint> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      vec3 normal(0.3f, -0.2f, 0.1f);
      normal[axis] = sign;
      for (int k = 0; k < 2; ++k) points.push_back({vec3(1), glm::normalize(normal)});
    }
  }
  const std::vector<rays::SurfacePoint> spread = spread_points(points, 6);
  ASSERT_EQ(spread.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(spread[i].normal, points[2 * i].normal);
}

TEST(SpreadPoints, StandForTheMiddleOfTheirCell) {
  const vec3 up(0, 1, 0);
  std::vector<rays::SurfacePoint> points;
  for (const float x : {0.0f, 5.0f, 1.5f, 0.5f}) points.push_back({{x, 0, 0}, up});
  // Their mean is at 1.75.
  const std::vector<rays::SurfacePoint> one = spread_points(points, 1);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].position.x, 1.5f);
}

}  // namespace
}  // namespace ssphh::transport
