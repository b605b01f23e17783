/// Fitted weights between their points: a linear fit, what may serve, and what must not.

#include <map>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/probes/fitted_points.h>

#include "open_space.h"

namespace ssphh::probes {
namespace {

const std::vector<vec3> probes{{0, 1, 0}, {4, 1, 0}, {0, 1, 4}};

/// Points 0.5 m apart on the floor [0, 4]², facing up; weights of three probes that are linear in place and
/// sum to 0.9: 0.9 (1 − x/8 − z/8), 0.9 x/8, 0.9 z/8.
FittedPoints floor_points() {
  FittedPoints fitted;
  for (int i = 0; i < 81; ++i) {
    const float x = 0.5f * static_cast<float>(i % 9), z = 0.5f * static_cast<float>(i / 9);
    fitted.points.push_back({{x, 0, z}, {0, 1, 0}});
    PointWeights& weights = fitted.weights.emplace_back();
    weights.add(0, 0.9f * (1 - x / 8 - z / 8));
    if (x > 0) weights.add(1, 0.9f * x / 8);
    if (z > 0) weights.add(2, 0.9f * z / 8);
  }
  return fitted;
}

std::unique_ptr<LookupWeights> lookup(const FittedPoints& fitted, const SeesProbe& sees = everything) {
  WeightParams params;
  params.fallback = WeightMethod::distance;
  return make_weights(probes, sees, params, &fitted);
}

std::map<int, float> weights_by_probe(const ProbeWeights& weights) {
  std::map<int, float> result;
  for (const ProbeWeight& entry : weights.used())
    EXPECT_TRUE(result.emplace(entry.probe, entry.weight).second) << "probe twice";
  return result;
}

TEST(FittedPoints, AreEqualInPlacesNormalsAndWeights) {
  const FittedPoints fitted = floor_points();
  EXPECT_EQ(fitted, floor_points());
  FittedPoints moved = fitted, turned = fitted, weighed = fitted, more = fitted;
  moved.points[80].position.x += 1e-3f;
  turned.points[0].normal = {0, -1, 0};
  weighed.weights[40].used()[1].weight += 1e-3f;
  more.points.push_back(more.points.back());
  for (const FittedPoints& other : {moved, turned, weighed, more}) EXPECT_FALSE(fitted == other);
}

TEST(FittedLookupWeights, AreLinearBetweenPointsAndKeepTheirSum) {
  const auto weights = lookup(floor_points());
  for (const vec3& x : {vec3(2, 0, 2), vec3(1.1f, 0, 2.3f), vec3(2.6f, 0, 1.4f), vec3(2.25f, 0, 1.75f)}) {
    const std::map<int, float> at = weights_by_probe(weights->at({x, {0, 1, 0}}));
    // The ridge gives up a few per cent of the slope over the distance to the points' middle: under 0.1 m.
    EXPECT_NEAR(at.at(1), 0.9f * x.x / 8, 0.004f) << x.x;
    EXPECT_NEAR(at.at(2), 0.9f * x.z / 8, 0.004f) << x.z;
    EXPECT_NEAR(at.at(0) + at.at(1) + at.at(2), 0.9f, 1e-5f);
  }
}

TEST(FittedLookupWeights, ReachIntoACornerFurtherThanTheMeanWithoutOvershoot) {
  const auto weights = lookup(floor_points());
  const std::map<int, float> at = weights_by_probe(weights->at({{0, 0, 0}, {0, 1, 0}}));
  // 0.9 is right; the mean of the points around lies inside and gives 0.797. No point counts less
  // than −¼ of its share of the mean, so that the fit stays between.
  EXPECT_GT(at.at(0), 0.82f);
  EXPECT_LT(at.at(0), 0.905f);
  EXPECT_NEAR(at.at(0) + at.at(1) + at.at(2), 0.9f, 1e-5f);
}

TEST(FittedLookupWeights, WhatMovesOrHasNoPointsNearGetsOtherWeights) {
  const FittedPoints fitted = floor_points();
  const auto weights = lookup(fitted);
  WeightParams by_distance;
  by_distance.method = WeightMethod::distance;
  const auto other = make_weights(probes, everything, by_distance);
  const rays::SurfacePoint on_floor{{2, 0, 2}, {0, 1, 0}}, moving{{2, 0, 2}, {0, 1, 0}, true};
  EXPECT_EQ(weights->at(moving), other->at(moving));
  EXPECT_FALSE(weights->at(on_floor) == other->at(on_floor));
  for (const rays::SurfacePoint& p : {rays::SurfacePoint{{2, 0, 2}, {0, -1, 0}},    // faces away
                                      rays::SurfacePoint{{2, 1.5f, 2}, {0, 1, 0}},  // above the floor
                                      rays::SurfacePoint{{20, 0, 2}, {0, 1, 0}}})   // far off
    EXPECT_EQ(weights->at(p), other->at(p));
}

TEST(FittedLookupWeights, APointBehindAWallDoesNotCount) {
  // Beyond x = 2 the floor has another probe alone; a wall stands there.
  FittedPoints fitted = floor_points();
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    fitted.weights[i] = {};
    fitted.weights[i].add(fitted.points[i].position.x > 2.01f ? 1 : 0, 1);
  }
  const auto walled =
      lookup(fitted, [](const vec3& a, const vec3& b) { return (a.x > 2.01f) == (b.x > 2.01f); });
  for (const float x : {1.6f, 1.9f, 2.0f}) {
    const std::map<int, float> at = weights_by_probe(walled->at({{x, 0, 2}, {0, 1, 0}}));
    EXPECT_FALSE(at.contains(1)) << x;
    EXPECT_TRUE(weights_by_probe(lookup(fitted)->at({{x, 0, 2}, {0, 1, 0}})).contains(1))
        << x << ", without the wall";
  }
}

TEST(FittedLookupWeights, AreChosenWhereTheyAreAndRefusedWhereNot) {
  const FittedPoints fitted = floor_points();
  WeightParams params;
  EXPECT_EQ(params.chosen(true), WeightMethod::fitted);
  EXPECT_EQ(params.chosen(false), params.fallback);
  params.method = WeightMethod::fitted;
  EXPECT_THROW(make_weights(probes, everything, params), Error);
  params.method = WeightMethod::distance;
  EXPECT_EQ(params.chosen(true), WeightMethod::distance);
  FittedPoints wrong = fitted;
  wrong.weights[5].used()[0].probe = 3;
  EXPECT_THROW(lookup(wrong), Error);
}

TEST(FittedLookupWeights, PointsWithoutWeightsAreNoPoints) {
  FittedPoints none = floor_points();
  for (PointWeights& weights : none.weights) weights.count = 0;
  WeightParams by_distance;
  by_distance.method = WeightMethod::distance;
  const rays::SurfacePoint p{{2, 0, 2}, {0, 1, 0}};
  EXPECT_EQ(lookup(none)->at(p), make_weights(probes, everything, by_distance)->at(p));
}

TEST(FittedLookupWeights, ManyProbesKeepTheSumOfTheirWeights) {
  // Each point has 16 probes of its own: 12 points bring more than a lookup returns.
  FittedPoints fitted = floor_points();
  std::vector<vec3> many;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    fitted.weights[i] = {};
    for (int k = 0; k < max_weights; ++k) {
      fitted.weights[i].add(static_cast<int>(many.size()), 1.0f / static_cast<float>(max_weights + k));
      many.push_back(fitted.points[i].position + vec3(0, 1, 0));
    }
  }
  float one = 0;
  for (int k = 0; k < max_weights; ++k) one += 1.0f / static_cast<float>(max_weights + k);
  const ProbeWeights at = make_weights(many, everything, {}, &fitted)->at({{2.1f, 0, 1.9f}, {0, 1, 0}});
  EXPECT_EQ(at.count, 48);
  float sum = 0;
  for (const ProbeWeight& entry : at.used()) sum += entry.weight;
  EXPECT_NEAR(sum, one, 1e-4f);
}

}  // namespace
}  // namespace ssphh::probes
