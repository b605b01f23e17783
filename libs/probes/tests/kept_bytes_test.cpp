/// Memory as the tool tells of it: of the plain data that lookups keep.

#include <gtest/gtest.h>

#include <ssphh/probes/fitted_points.h>
#include <ssphh/probes/lookup_weights.h>

namespace ssphh::probes {
namespace {

const std::vector<vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};
const SeesProbe open = [](const vec3&, const vec3&) { return true; };

TEST(KeptBytes, OfWeightsAreThoseOfPlacesAndTheirTree) {
  for (const WeightMethod method : {WeightMethod::distance, WeightMethod::trilinear, WeightMethod::mls}) {
    WeightParams params;
    params.method = method;
    const auto weights = make_weights(five, open, params);
    EXPECT_EQ(weights->bytes(), 5u * (12 + 17));
  }
}

TEST(KeptBytes, OfFittedPointsAreThoseThatHaveWeights) {
  FittedPoints fitted;
  fitted.points.resize(3);
  fitted.weights.resize(3);
  fitted.points[1].position = {1, 0, 0}, fitted.points[2].position = {0, 0, 1};
  fitted.weights[0].add(0, 1);
  fitted.weights[2].add(0, 0.5f), fitted.weights[2].add(4, 0.5f);
  const auto weights = make_weights(five, open, {}, &fitted);
  // Two points with 12 bytes of place, 4 of spacing, 6 of normal, 2 of cover and 20 in the tree, with its one
  // box of 24; three places of first weights; three weights of 2 + 4 bytes; and the fallback.
  EXPECT_EQ(weights->bytes(), 2u * (12 + 4 + 6 + 2 + 20) + 24 + 3 * 4 + 3 * 6 + 5 * (12 + 17));
}

}  // namespace
}  // namespace ssphh::probes
