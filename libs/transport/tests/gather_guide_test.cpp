// Where the rays of records go.

#include "../src/gather_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::transport {
namespace {

const rays::SurfacePoint tilted{{1, 2, 3}, glm::normalize(vec3(0.3f, 0.8f, -0.5f))};

/// A bright place in a direction of the point's frame, that faces it.
BrightPoint bright_at(const rays::SurfacePoint& point, const vec3& local, float distance, float flux) {
  const vec3 direction = Frame::around(point.normal).to_world(glm::normalize(local));
  return {{point.position + distance * direction, -direction}, flux};
}

TEST(HemisphereParts, DirectionsOfAPartFallIntoIt) {
  for (const std::uint32_t rays : {4u, 48u, 256u, 1024u, 4096u}) {
    const HemisphereParts parts(rays);
    EXPECT_GE(parts.count(), 4u);
    EXPECT_LE(parts.count(), std::max(4u, rays / 2));
    for (std::size_t part = 0; part < parts.count(); ++part) {
      for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(parts.part_of(parts.direction(part, i, 7)), part);
    }
  }
}

TEST(HemisphereParts, HoldTheSameShareOfCosineDistributedDirections) {
  const HemisphereParts parts(256);
  std::vector<double> counts(parts.count());
  Pcg32 random(3);
  constexpr int draws = 40000;
  for (int i = 0; i < draws; ++i) ++counts[parts.part_of(sample_cosine_hemisphere(random.uniform2()))];
  const double expected = draws / static_cast<double>(parts.count());
  double chi2 = 0;
  for (const double c : counts) chi2 += (c - expected) * (c - expected) / expected;
  const auto freedom = static_cast<double>(parts.count() - 1);
  EXPECT_LT(chi2, freedom + 4 * std::sqrt(2 * freedom)) << "χ², passed about once in 10⁴";
}

TEST(HemisphereParts, SpreadWeightsReachTheNeighboursAndGoAroundThePole) {
  const HemisphereParts parts(256);  // 5 rings of 20
  std::vector<float> weights(parts.count(), 0);
  weights[2 * 20] = 18;
  parts.spread(weights);
  EXPECT_FLOAT_EQ(weights[2 * 20], 10);
  for (const std::size_t near : {1 * 20 + 0, 3 * 20 + 0, 2 * 20 + 1, 2 * 20 + 19, 1 * 20 + 19, 3 * 20 + 1})
    EXPECT_FLOAT_EQ(weights[near], 1) << near;
  EXPECT_FLOAT_EQ(std::accumulate(weights.begin(), weights.end(), 0.0f), 18);
}

TEST(RaysOfParts, AreAllThatThereAreAndOneAtLeast) {
  const std::vector<BrightPoint> bright = {bright_at(tilted, {0.2f, 0.1f, 1}, 3, 0.4f),
                                           bright_at(tilted, {-1, 0.4f, 0.3f}, 0.5f, 0.01f)};
  for (const std::uint32_t rays : {4u, 7u, 48u, 256u, 1000u, 4096u}) {
    const HemisphereParts parts(rays);
    for (const std::span<const BrightPoint> seen : {std::span<const BrightPoint>(), std::span(bright)}) {
      const std::vector<std::uint32_t> count = rays_of_parts(parts, rays, tilted, seen);
      EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0u), rays);
      EXPECT_GE(std::ranges::min(count), 1u);
    }
  }
}

TEST(RaysOfParts, AreEvenWhereNothingIsBrightAndGoToWhatIs) {
  const HemisphereParts parts(1024);
  const auto even = rays_of_parts(parts, 1024, tilted, {});
  EXPECT_LE(std::ranges::max(even) - std::ranges::min(even), 1u);
  const vec3 local(0.5f, -0.3f, 0.8f);
  const std::vector<BrightPoint> one = {bright_at(tilted, local, 2, 1)};
  const auto guided = rays_of_parts(parts, 1024, tilted, one);
  const std::size_t there = parts.part_of(glm::normalize(local));
  EXPECT_EQ(std::ranges::max_element(guided) - guided.begin(), static_cast<std::ptrdiff_t>(there));
  EXPECT_GT(guided[there], 200u);
  // What is behind the surface, or turns its back, says nothing
  BrightPoint behind = bright_at(tilted, {0.1f, 0.2f, -1}, 2, 1), away = one[0];
  away.point.normal = -away.point.normal;
  EXPECT_EQ(rays_of_parts(parts, 1024, tilted, std::vector{behind, away}), even);
  // By flux, cosines and the square of the distance
  const std::vector<BrightPoint> two = {bright_at(tilted, {0.6f, 0.05f, 0.8f}, 1, 1),
                                        bright_at(tilted, {-0.6f, 0.05f, 0.8f}, 2, 1)};
  const auto both = rays_of_parts(parts, 1024, tilted, two);
  const auto at = [&](const vec3& d) { return static_cast<double>(both[parts.part_of(glm::normalize(d))]); };
  EXPECT_NEAR(at({0.6f, 0.05f, 0.8f}) / at({-0.6f, 0.05f, 0.8f}), 4, 0.5);
}

TEST(SpatialOrder, NamesEveryPointOnceAndKeepsNeighboursTogether) {
  Pcg32 random(5);
  std::vector<rays::SurfacePoint> points(4096);
  for (rays::SurfacePoint& p : points) p.position = vec3(3, -40, 500) + 20.0f * random.uniform3();
  const std::vector<std::uint32_t> order = spatial_order(points);
  EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), points.size());
  double way = 0, by_chance = 0;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    way += double(glm::distance(points[order[i]].position, points[order[i + 1]].position));
    by_chance += double(glm::distance(points[i].position, points[i + 1].position));
  }
  EXPECT_LT(way, 0.25 * by_chance);
  EXPECT_EQ(spatial_order(std::vector<rays::SurfacePoint>(3)).size(), 3u) << "all in one place";
}

}  // namespace
}  // namespace ssphh::transport
