/// How much each fitted point counts, where closed forms tell: by distance, by tilt, by height, by place.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/probes/fitted_points.h>
#include <ssphh/probes/surface_spacing.h>

#include "open_space.h"

namespace ssphh::probes {
namespace {

/// Points around the origin on a surface that faces `up`, each with a probe of its own kind.
class Around {
 public:
  explicit Around(const vec3& up = {0, 1, 0}) : frame_(Frame::around(up)) {}
  /// In the surface's frame, z off it; tilted by `degrees` toward the second tangent.
  void add(const vec3& local, int probe, float degrees = 0) {
    const float a = glm::radians(degrees);
    fitted_.points.push_back({frame_.to_world(local), frame_.to_world({0, std::sin(a), std::cos(a)})});
    fitted_.weights.emplace_back().add(probe, 1);
  }
  /// Four at one distance, so that their middle is the origin.
  void add_ring(float radius, float turn, int probe, float height = 0, float degrees = 0) {
    for (int k = 0; k < 4; ++k) {
      const float a = glm::radians(turn + 90 * static_cast<float>(k));
      add({radius * std::cos(a), radius * std::sin(a), height}, probe, degrees);
    }
  }
  /// What probe 1 counts at the origin; both have to be found.
  float share(const SeesProbe& sees = everything) const {
    const std::vector<vec3> probes{{0, 1, 0}, {3, 1, 0}, {0, 1, 3}};
    WeightParams params;
    params.fallback = WeightMethod::distance;
    const ProbeWeights at =
        make_weights(probes, sees, params, &fitted_)->at({vec3(0), frame_.to_world({0, 0, 1})});
    float result = 0, sum = 0;
    for (const ProbeWeight& entry : at.used()) {
      sum += entry.weight;
      if (entry.probe == 1) result = entry.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-5f);
    return result;
  }
  double spacing(std::size_t point) const { return double(surface_spacings(fitted_.points)[point]); }
  /// What the point counts by its distance from the origin: (1 − q²/9)⁸ within three spacings, over one.
  double by_distance(std::size_t point) const {
    const double q = double(glm::length(fitted_.points[point].position)) / spacing(point);
    return q < 3 ? std::pow(1 - q * q / 9, 8) / spacing(point) : 0;
  }
  /// What it keeps of that where it and another count so much: 1 / (1 + (d / 2.5 s)⁴), s their mean spacing.
  double beside(std::size_t point, std::size_t other) const {
    const double one = by_distance(point), two = by_distance(other);
    const double mean = (one + two) / (one / spacing(point) + two / spacing(other));
    return one / (1 + std::pow(double(glm::length(fitted_.points[point].position)) / (2.5 * mean), 4));
  }
  vec3 place(std::size_t point) const { return frame_.to_local(fitted_.points[point].position); }

 private:
  Frame frame_;
  FittedPoints fitted_;
};

TEST(FittedShare, FallsWithDistanceToThreeOfThePointsSpacings) {
  for (const float far : {0.9f, 1.2f, 1.5f}) {
    Around points;
    points.add_ring(0.6f, 0, 0);
    points.add_ring(far, 45, 1);
    const double one = points.beside(0, 4), other = points.beside(4, 0);
    ASSERT_GT(other, 0.02 * one);
    // Lifted by the rounding of normals to 16 bits
    EXPECT_NEAR(double(points.share()), other / (one + other), 1e-4) << far;
  }
  // A ring of many reaches as much less far
  Around points;
  points.add_ring(0.6f, 0, 0);
  for (int k = 0; k < 10; ++k) points.add_ring(1, 9 * static_cast<float>(k), 1);
  EXPECT_EQ(points.by_distance(4), 0);
  EXPECT_EQ(points.share(), 0);
}

TEST(FittedShare, IsOfEachPointsOwnSpacing) {
  // A lattice of a metre, and within it a denser one: what lies between is lit from both.
  Around points;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      if (x < 0) points.add({static_cast<float>(x) - 0.25f, static_cast<float>(y), 0}, 0);
    }
  }
  for (int x = 0; x < 10; ++x) {
    for (int y = -10; y <= 10; ++y)
      points.add({0.2f * static_cast<float>(x) + 0.25f, 0.2f * static_cast<float>(y), 0}, 1);
  }
  EXPECT_GT(points.spacing(9 * 2 + 4), 4 * points.spacing(36 + 21 * 5 + 10));
  // Neither the sparse side's distance nor the dense side's number rules: by one spacing for all, it was 1
  EXPECT_NEAR(points.share(), 0.5f, 0.45f);
}

TEST(FittedShare, FallsWithTheCosineToNothingAtFortyFiveDegreesOfTilt) {
  // cos 45.57° = 0.7.
  for (const float degrees : {-45.3f, -20.0f, 10.0f, 28.0f, 40.0f}) {
    Around points({0.6f, 0, -0.8f});
    points.add_ring(1, 0, 0);
    points.add_ring(1, 45, 1, 0, degrees);
    const double facing = (std::cos(glm::radians(double(degrees))) - 0.7) / 0.3;
    const double one = points.by_distance(0), other = facing * points.by_distance(4);
    EXPECT_NEAR(double(points.share()), other / (one + other), other > 0.05 * one ? 2e-4 : 0.011) << degrees;
  }
  for (const float degrees : {-46.0f, 46.0f, 60.0f, 90.0f, 135.0f, 180.0f}) {
    Around points({0.6f, 0, -0.8f});
    points.add_ring(1, 0, 0);
    points.add_ring(1, 45, 1, 0, degrees);
    EXPECT_EQ(points.share(), 0) << degrees;
  }
}

TEST(FittedShare, FallsToNothingHalfASpacingAndATenthOfTheDistanceOffThePlane) {
  for (const float radius : {0.7f, 1.5f}) {
    for (const float height : {-0.2f, 0.3f, -0.45f, 0.6f, 0.9f}) {
      Around points({0, 0, 1});
      points.add_ring(1, 0, 0);
      points.add_ring(radius, 45, 1, height);
      const double limit = 0.5 * points.spacing(4) + 0.1 * std::hypot(double(radius), double(height));
      const double off = double(height) / limit;
      const double counts = std::abs(off) < 1 ? std::pow(1 - off * off, 2) * points.by_distance(4) : 0;
      EXPECT_NEAR(double(points.share()), counts / (counts + points.by_distance(0)), 0.011)
          << radius << " " << height;
      if (counts == 0) {
        EXPECT_EQ(points.share(), 0) << radius << " " << height;
      }
    }
  }
}

/// In closed form, for points on a line through the origin: with the sum of weights W, their moment M and
/// second moment S what each counts is w (S − M x) / (W S − M²); the ridge is 5 % of W spacings squared.
TEST(FittedShare, IsThatOfALinearFitWhateverWayThePointsLie) {
  for (const float turn : {0.0f, 30.0f, 90.0f, 200.0f}) {
    const vec3 along(std::cos(glm::radians(turn)), std::sin(glm::radians(turn)), 0);
    Around points({0, -0.6f, 0.8f});
    const double a = 1.0, b = -0.5;
    points.add(float(a) * along, 0);
    points.add(float(b) * along, 1);
    const double wa = points.beside(0, 1), wb = points.beside(1, 0), s = points.spacing(0);
    ASSERT_GT(wa, 0.05 * wb);
    const double sum = wa + wb, moment = wa * a + wb * b;
    const double second = wa * a * a + wb * b * b + 0.05 * sum * s * s;
    EXPECT_NEAR(double(points.share()), wb * (second - moment * b) / (sum * second - moment * moment), 1e-3)
        << turn;
  }
}

TEST(FittedShare, ThatIsNegativeIsAQuarterOfAllAtMost) {
  // Both on one side: the fit to them, taken at the origin, gives the farther one much less than nothing
  for (const float turn : {0.0f, 120.0f}) {
    const vec3 along(std::cos(glm::radians(turn)), std::sin(glm::radians(turn)), 0);
    Around points;
    const double a = 0.5, b = 1.2;
    points.add(float(a) * along, 0);
    points.add(float(b) * along, 1);
    const double wa = points.beside(0, 1), wb = points.beside(1, 0), s = points.spacing(0);
    ASSERT_GT(wb, 0.02 * wa);
    const double sum = wa + wb, moment = wa * a + wb * b;
    const double ridge = 0.05 * (wa * s * s + wb * std::pow(points.spacing(1), 2));
    const double second = wa * a * a + wb * b * b + ridge;
    const double relative = sum * (second - moment * b) / (sum * second - moment * moment);
    const double most = std::min(1.0, 0.25 * sum / (wb * -relative));
    ASSERT_LT(relative, 0);
    EXPECT_NEAR(double(points.share()), wb / sum * (1 - most + most * relative), 1e-3) << turn;
    EXPECT_LT(most, 1);
  }
}

TEST(FittedShare, SightIsAFiftiethOfASpacingOffTheSurfacesAndOnceMoreAQuarter) {
  Around points;
  points.add({1, 0, 0}, 0);
  points.add({0, 0, 0}, 1);  // at the place itself: nothing is between
  const auto spacing = static_cast<float>(points.spacing(0));
  std::vector<float> lifts;
  points.share([&](const vec3& from, const vec3& to) {
    if (glm::distance(from, to) < 0.6f) return true;  // asks what is close before a point
    EXPECT_NEAR(glm::distance(from, to), 1, 1e-5f);
    EXPECT_NEAR(from.y, to.y, 1e-5f);
    lifts.push_back(from.y);
    return true;
  });
  ASSERT_EQ(lifts.size(), 2u);
  EXPECT_NEAR(lifts[0], 0.02f * spacing, 1e-5f);
  EXPECT_NEAR(lifts[1], 0.25f * spacing, 1e-5f);
}

TEST(FittedShare, WithinAThousandthOfASpacingNothingIsBetween) {
  for (const float far : {0.0005f, 0.0009f, 0.0011f, 0.002f}) {
    Around points;
    points.add({0, 0.5f, 0}, 0);
    points.add({far, 0, 0}, 1);
    const double spacing = points.spacing(1);
    // Only the first is seen.
    const float share =
        points.share([](const vec3&, const vec3& to) { return std::hypot(to.x, to.z) > 0.3f; });
    EXPECT_EQ(share > 0, double(far) < 0.001 * spacing) << far << " of " << spacing;
  }
}

}  // namespace
}  // namespace ssphh::probes
