/// Points thinned out evenly: their number, their spread, and both sides of a wall.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/gi/fitted_weights.h>

namespace ssphh::gi {
namespace {

/// Random places on a floor of 8 m × 8 m and on both sides of a wall of no thickness across it.
std::vector<scene::SurfacePoint> floor_and_wall(int count) {
  Pcg32 random(1);
  std::vector<scene::SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    const float u = 8 * random.uniform(), v = 8 * random.uniform();
    points.push_back({{u, 0, v}, {0, 1, 0}});
    points.push_back({{4, v, u}, {i % 2 ? -1.0f : 1.0f, 0, 0}});
  }
  return points;
}

TEST(SpreadPoints, AreAsManyAsAskedForAndOfThePointsInTheirOrder) {
  const std::vector<scene::SurfacePoint> points = floor_and_wall(4000);
  for (const int count : {1, 5, 6, 100, 1000, 5000}) {
    const std::vector<scene::SurfacePoint> spread = spread_points(points, count);
    EXPECT_LE(spread.size(), static_cast<std::size_t>(count));
    // A floor of 5² cells and a wall of as many on each side are 75; 6² would be 108
    if (count >= 100) {
      EXPECT_GT(spread.size(), static_cast<std::size_t>(0.69 * count));
    }
    auto at = points.begin();
    for (const scene::SurfacePoint& p : spread) {
      at = std::find_if(at, points.end(), [&](const scene::SurfacePoint& q) {
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
  const std::vector<scene::SurfacePoint> points = floor_and_wall(4000);
  const std::vector<scene::SurfacePoint> spread = spread_points(points, 300);
  // 192 m² in 300 cells of 0.8 m: two points of one cell are no farther apart than its diagonal
  for (const scene::SurfacePoint& p : points) {
    float nearest = 1e9f;
    for (const scene::SurfacePoint& q : spread) {
      if (q.normal == p.normal) nearest = std::min(nearest, glm::distance(p.position, q.position));
    }
    EXPECT_LT(nearest, 1.05f * 0.8f * std::sqrt(2.0f));
  }
}

}  // namespace
}  // namespace ssphh::gi
