/// The k-d tree against a sort of all points.

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/geometry/nearest.h>

namespace ssphh::geometry {
namespace {

std::vector<std::pair<float, int>> sorted_by_distance(const std::vector<vec3>& points, const vec3& x,
                                                      float radius) {
  std::vector<std::pair<float, int>> all;  // by distance, then by index
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vec3 d = points[i] - x;
    if (glm::dot(d, d) <= radius * radius) all.emplace_back(glm::dot(d, d), static_cast<int>(i));
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_nearest(const std::vector<vec3>& points, const vec3& x, std::size_t wanted, float radius) {
  const NearestPoints tree(points);
  std::vector<Near> found(wanted);
  const auto count = static_cast<std::size_t>(tree.find(x, found, radius));
  const std::vector<std::pair<float, int>> expected = sorted_by_distance(points, x, radius);
  ASSERT_EQ(count, std::min(wanted, expected.size()));
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(found[k].index, expected[k].second) << "neighbour " << k << " of " << points.size();
    EXPECT_EQ(found[k].distance2, expected[k].first);
  }
}

TEST(NearestPoints, EqualsASortOfAllPoints) {
  Pcg32 random(1);
  for (const int count : {1, 2, 3, 7, 64, 500}) {
    std::vector<vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(random.uniform3());
    for (int trial = 0; trial < 40; ++trial) {
      const vec3 x = 2.0f * random.uniform3() - 0.5f;
      for (const std::size_t wanted : {std::size_t{1}, std::size_t{4}, std::size_t{16}}) {
        expect_nearest(points, x, wanted, std::numeric_limits<float>::infinity());
        expect_nearest(points, x, wanted, 0.3f);
      }
    }
  }
}

TEST(NearestPoints, TiesGoByIndexHoweverThePointsLie) {
  // A lattice asked at its points, edges and middles, in shuffled order and every point twice.
  Pcg32 random(2);
  std::vector<vec3> points;
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < 125; ++i)
      points.push_back(
          {static_cast<float>(i % 5), static_cast<float>(i / 5 % 5), static_cast<float>(i / 25)});
  }
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[static_cast<std::size_t>(random.uniform() * static_cast<float>(i))]);
  for (const vec3& x :
       {vec3(2), vec3(2, 2, 2.5f), vec3(1.5f), vec3(0), vec3(-3, 2, 2), vec3(2.5f, 2.5f, 0)}) {
    for (const std::size_t wanted : {std::size_t{1}, std::size_t{5}, std::size_t{16}, std::size_t{300}}) {
      expect_nearest(points, x, wanted, std::numeric_limits<float>::infinity());
      expect_nearest(points, x, wanted, 1);  // points at the radius itself count
    }
  }
}

TEST(NearestPoints, NothingWantedOrNothingThere) {
  std::array<Near, 4> found;
  EXPECT_EQ(NearestPoints({}).find(vec3(0), found), 0);
  const std::vector<vec3> one{vec3(1)};
  EXPECT_EQ(NearestPoints(one).find(vec3(0), {}), 0);
  EXPECT_EQ(NearestPoints(one).find(vec3(0), found, 1.5f), 0);
  EXPECT_EQ(NearestPoints(one).find(vec3(0), found), 1);
}

}  // namespace
}  // namespace ssphh::geometry
