/// What a beam of rays says that it may meet, against points within what it does meet; and sketches put
/// together.

#include "beam.h"

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::sketch {
namespace {

/// Whether a point lies in the cone.
bool holds(const Beam& beam, const vec3& x) {
  const vec3 p = x - beam.axis.origin;
  const float along = glm::dot(p, beam.axis.direction);
  return glm::length(p - along * beam.axis.direction) <= beam.radius + along * beam.tangent;
}

TEST(Beam, MeetsTheBallsThatReachIntoIt) {
  Pcg32 random(9);
  int met = 0, missed = 0;
  for (int round = 0; round < 400; ++round) {
    Beam beam;
    beam.axis = {random.uniform3(), sample_uniform_sphere(random.uniform2())};
    beam.radius = 0.3f * random.uniform();
    beam.tangent = 0.8f * random.uniform();
    const vec3 center = beam.axis.origin + (1 + 4 * random.uniform()) * beam.axis.direction +
                        2.5f * (2.0f * random.uniform3() - 1.0f);
    const float radius = 0.05f + random.uniform();
    int inside = 0;
    constexpr int points = 400;
    for (int i = 0; i < points; ++i)
      inside += holds(
          beam, center + std::cbrt(random.uniform()) * radius * sample_uniform_sphere(random.uniform2()));
    const bool meets = beam.meets_ball(center, radius);
    EXPECT_TRUE(meets || inside == 0) << round;
    // A ball that does reach in does so visibly, but for the few that hardly do
    EXPECT_TRUE(!beam.meets_ball(center, 0.8f * radius) || inside > 0) << round;
    met += inside > 0, missed += !meets;
  }
  EXPECT_GT(met, 80);
  EXPECT_GT(missed, 80);
}

TEST(Sketch, HasAllThatIsAddedInItsOrder) {
  const auto one_of_each = [](float at) {
    Sketch sketch;
    sketch.lines.emplace_back().a = vec3(at);
    sketch.discs.emplace_back().center = vec3(at);
    sketch.boxes.emplace_back().min = vec3(at);
    sketch.balls.emplace_back().center = vec3(at);
    sketch.lobes.emplace_back().center = vec3(at);
    return sketch;
  };
  Sketch both = one_of_each(1);
  both += one_of_each(2);
  both += one_of_each(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const vec3 at(static_cast<float>(i + 1));
    ASSERT_EQ(both.lines.size(), 3u);
    ASSERT_EQ(both.lobes.size(), 3u);
    EXPECT_EQ(both.lines[i].a, at);
    EXPECT_EQ(both.discs.at(i).center, at);
    EXPECT_EQ(both.boxes.at(i).min, at);
    EXPECT_EQ(both.balls.at(i).center, at);
    EXPECT_EQ(both.lobes[i].center, at);
  }
}

}  // namespace
}  // namespace ssphh::sketch
