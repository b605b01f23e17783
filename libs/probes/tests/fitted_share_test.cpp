/// How much each fitted point counts, where closed forms tell: by distance, by tilt, by height, by place.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/probes/fitted_points.h>

namespace ssphh::probes {
namespace {

const SeesProbe everything = [](const vec3&, const vec3&) { return true; };

/// Points around the origin on a surface that faces `up`, each with a probe of its own kind. The points'
/// spacing is 1 m: many far away stand on a grid.
class Around {
 public:
  explicit Around(const vec3& up = {0, 1, 0}) : frame_(Frame::around(up)) {
    for (int i = 0; i < 100; ++i) add({100 + i % 10, i / 10, 0}, 0);
  }
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

 private:
  Frame frame_;
  FittedPoints fitted_;
};

/// With fewer than twelve points near, a lookup reaches four spacings: what a point at a distance counts
/// there.
double fade(double distance, double reach = 4) {
  const double t = 1 - distance * distance / (reach * reach);
  return t * t;
}

TEST(FittedShare, FallsWithDistanceToFourSpacings) {
  for (const float far : {0.9f, 2.0f, 3.2f, 3.9f}) {
    Around points;
    points.add_ring(0.6f, 0, 0);
    points.add_ring(far, 45, 1);
    const double expected = fade(double(far)) / (fade(double(far)) + fade(0.6));
    // Lifted by the rounding of normals to 16 bits.
    EXPECT_NEAR(double(points.share()), expected, 1e-4) << far;
  }
  Around points;
  points.add_ring(0.6f, 0, 0);
  points.add_ring(4.05f, 45, 1);
  EXPECT_EQ(points.share(), 0);
}

TEST(FittedShare, FallsToNothingAtTheTwelfthPointWhereThereAreMore) {
  Around points;
  points.add_ring(0.6f, 0, 0);
  points.add_ring(0.8f, 45, 1);
  points.add_ring(1.1f, 20, 2);
  points.add_ring(1.2f, 70, 1);
  EXPECT_NEAR(double(points.share()), fade(0.8, 1.1) / (fade(0.8, 1.1) + fade(0.6, 1.1)), 1e-3);
}

TEST(FittedShare, IsByTheCosineUpToFortyFiveDegreesOfTiltAndNothingBeyond) {
  // cos 45.57° = 0.7.
  for (const float degrees : {-45.3f, -20.0f, 10.0f, 30.0f, 45.3f}) {
    Around points({0.6f, 0, -0.8f});
    points.add_ring(1, 0, 0);
    points.add_ring(1, 45, 1, 0, degrees);
    const double cosine = std::cos(glm::radians(double(degrees)));
    EXPECT_NEAR(double(points.share()), cosine / (1 + cosine), 1e-4) << degrees;
  }
  for (const float degrees : {-46.0f, 46.0f, 60.0f, 90.0f, 135.0f, 180.0f}) {
    Around points({0.6f, 0, -0.8f});
    points.add_ring(1, 0, 0);
    points.add_ring(1, 45, 1, 0, degrees);
    EXPECT_EQ(points.share(), 0) << degrees;
  }
}

TEST(FittedShare, EndsHalfASpacingAndATenthOfTheDistanceOffThePlane) {
  for (const float radius : {0.5f, 1.5f}) {
    for (const float side : {-1.0f, 1.0f}) {
      // h = ½ + 0.1 √(r² + h²), solved for h
      const float limit = (0.5f + 0.1f * std::sqrt(0.25f + 0.99f * radius * radius)) / 0.99f;
      for (const float height : {0.97f * limit, 1.03f * limit}) {
        Around points({0, 0, 1});
        points.add_ring(1, 0, 0);
        points.add_ring(radius, 45, 1, side * height);
        const float distance = std::hypot(radius, height);
        const double counts = height < limit ? fade(double(distance)) : 0;
        EXPECT_NEAR(double(points.share()), counts / (counts + fade(1)), 1e-4) << radius << " " << height;
      }
    }
  }
}

TEST(FittedShare, IsThatOfALinearFitWhateverWayThePointsLie) {
  // Along a line through the origin; the slope's ridge is 5 % of the points' weight. In closed form: the sum
  // of weights W, their moment M and second moment S give what each counts, w (S − M x) / (W S − M²).
  for (const float turn : {0.0f, 30.0f, 90.0f, 200.0f}) {
    const vec3 along(std::cos(glm::radians(turn)), std::sin(glm::radians(turn)), 0);
    Around points({0, -0.6f, 0.8f});
    const double a = 1.5, b = -0.5, wa = fade(a), wb = fade(b);
    points.add(float(a) * along, 0);
    points.add(float(b) * along, 1);
    const double sum = wa + wb, moment = wa * a + wb * b, second = wa * a * a + wb * b * b + 0.05 * sum;
    EXPECT_NEAR(double(points.share()), wb * (second - moment * b) / (sum * second - moment * moment), 1e-4)
        << turn;
  }
}

TEST(FittedShare, IsNeverLessThanMinusAQuarterOfThatInTheMean) {
  // Both on one side: the fit to them, taken at the origin, would give the farther one much less.
  for (const float turn : {0.0f, 120.0f}) {
    const vec3 along(std::cos(glm::radians(turn)), std::sin(glm::radians(turn)), 0);
    Around points;
    points.add(1.0f * along, 0);
    points.add(2.0f * along, 1);
    EXPECT_NEAR(double(points.share()), -0.25 * fade(2) / (fade(1) + fade(2)), 1e-4) << turn;
  }
}

TEST(FittedShare, SightStartsAndEndsAFiftiethOfASpacingOffTheSurfaces) {
  Around points;
  points.add({1, 0, 0}, 0);
  points.add({0, 0, 0}, 1);  // at the place itself: nothing is between
  int asked = 0;
  points.share([&](const vec3& from, const vec3& to) {
    if (glm::distance(from, to) < 0.6f) return true;  // asks what is close before a point
    ++asked;
    EXPECT_NEAR(from.y, 0.02f, 1e-5f);
    EXPECT_NEAR(to.y, 0.02f, 1e-5f);
    EXPECT_NEAR(glm::distance(from, to), 1, 1e-5f);
    return true;
  });
  EXPECT_EQ(asked, 1);
}

TEST(FittedShare, WithinAThousandthOfASpacingNothingIsBetween) {
  for (const float far : {0.0005f, 0.0009f, 0.0011f, 0.002f}) {
    Around points;
    points.add({0, 0.5f, 0}, 0);
    points.add({far, 0, 0}, 1);
    // Only the first is seen.
    const float share =
        points.share([](const vec3&, const vec3& to) { return std::hypot(to.x, to.z) > 0.3f; });
    EXPECT_EQ(share > 0, far < 0.001f) << far;
  }
}

}  // namespace
}  // namespace ssphh::probes
