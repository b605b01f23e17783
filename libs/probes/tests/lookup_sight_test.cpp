/// Which probes a lookup asks for, from where, and what those count that nobody sees.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/probes/lookup_weights.h>

#include "open_space.h"

namespace ssphh::probes {
namespace {

const SeesProbe nothing = [](const vec3&, const vec3&) { return false; };

std::unique_ptr<LookupWeights> by_distance(const std::vector<vec3>& positions, const SeesProbe& sees) {
  WeightParams params;
  params.method = WeightMethod::distance;
  return make_weights(positions, sees, params);
}

/// Twenty at x = 1 … 20, a metre apart.
std::vector<vec3> row() {
  std::vector<vec3> positions;
  for (int i = 1; i <= 20; ++i) positions.emplace_back(i, 0, 0);
  return positions;
}

TEST(LookupSight, EightOfTheSixteenNearestLight) {
  // The first `hidden` are; of the rest so many count.
  for (const auto& [hidden, expected] : {std::pair(0, 8), {5, 8}, {8, 8}, {11, 5}, {15, 1}}) {
    const float last_hidden = static_cast<float>(hidden) + 0.5f;
    const ProbeWeights at =
        by_distance(row(), [&](const vec3&, const vec3& p) { return p.x > last_hidden; })->at({vec3(0), up});
    ASSERT_EQ(at.count, expected) << hidden;
    double sum = 0;
    for (int k = 1; k <= expected; ++k) sum += 1.0 / ((hidden + k) * (hidden + k));
    for (const ProbeWeight& entry : at.used()) {
      const double d = entry.probe + 1;
      EXPECT_NEAR(double(entry.weight), 1 / (d * d) / sum, 1e-5);
    }
  }
}

TEST(LookupSight, StartsAHundredthOfTheDistanceOffTheSurfaceAndAtMostOfTheSpacing) {
  for (const float distance : {0.3f, 0.9f, 5.0f}) {
    std::vector<vec3> starts;
    by_distance(row(), [&](const vec3& from, const vec3&) {
      starts.push_back(from);
      return true;
    })->at({{1, -distance, 0}, up});
    ASSERT_FALSE(starts.empty());
    EXPECT_NEAR(starts[0].y + distance, 0.01f * std::min(distance, 1.0f), 1e-6f);
  }
}

TEST(LookupSight, ReachesBehindItsSurfaceOverNoEdge) {
  // A wall in the plane y = 0 that ends at x = 0; probes stand behind it, and see what moves before it.
  const SeesProbe sees = [](const vec3& from, const vec3& p) {
    const float share = from.y / (from.y - p.y);
    return from.y > 0 && from.x + share * (p.x - from.x) > 0;
  };
  const float lift = 0.01f * glm::length(vec3(0.505f, -0.5f, 0));
  ASSERT_TRUE(sees(vec3(-0.005f, lift, 0), vec3(0.5f, -0.5f, 0)));
  for (const WeightMethod method : {WeightMethod::distance, WeightMethod::mls}) {
    WeightParams params;
    params.method = method;
    const auto weights = make_weights(std::vector{vec3(0.5f, -0.5f, 0), vec3(0.9f, -0.6f, 0)}, sees, params);
    for (const bool moves : {false, true}) {
      const ProbeWeights at = weights->at({{-0.005f, 0, 0}, up, moves});
      float sum = 0;
      for (const ProbeWeight& entry : at.used()) sum += entry.weight;
      EXPECT_NEAR(sum, moves ? 1 : 0, 1e-6f);
    }
  }
}

TEST(LookupSight, AHiddenProbeInFrontCountsInFullFromAQuarterOfTheCosineOn) {
  for (const float cosine : {-0.5f, 0.0f, 0.1f, 0.2f, 0.24f, 0.26f, 1.0f}) {
    const vec3 n(0, cosine, std::sqrt(1 - cosine * cosine));
    const ProbeWeights at = by_distance({{0, 3, 0}}, nothing)->at({vec3(0), n});
    ASSERT_EQ(at.count, 1);
    EXPECT_NEAR(at.entries[0].weight, std::min(1.0f, std::max(0.0f, 4 * cosine)), 1e-6f);
  }
}

TEST(LookupSight, WeightsAreByTheWrappedCosineSquaredAndAFloor) {
  // One straight ahead, one aside, one behind, all equally far.
  const ProbeWeights at = by_distance({{0, 2, 0}, {2, 0, 0}, {0, -2, 0}}, [](const vec3&, const vec3&) {
                            return true;
                          })->at({vec3(0), up});
  ASSERT_EQ(at.count, 3);
  const double expected[3] = {1.05, 0.30, 0.05};
  for (const ProbeWeight& entry : at.used())
    EXPECT_NEAR(double(entry.weight), expected[entry.probe] / 1.40, 1e-6);
}

}  // namespace
}  // namespace ssphh::probes
