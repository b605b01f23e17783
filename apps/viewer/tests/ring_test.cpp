// Rings by which lamps are turned, and round steps, as pure functions.

#include "model/ring.h"

#include <cmath>

#include <gtest/gtest.h>

#include "model/lamp.h"
#include "model/view_camera.h"

namespace ssphh::viewer {
namespace {

rays::RayQuery through(const View& view, const vec3& point) {
  const vec3 p = project(view, point, 1.5f);
  return pixel_ray(view, vec2(p), 1.5f);
}

TEST(Ring, TurnsByTheAngleThatTheMouseGoesAboutItsAxis) {
  const Ring ring{{1, 2, 3}, {0, 1, 0}, 0.5f};
  const auto at = [&](float angle) {
    return ring.center + ring.radius * vec3(std::cos(angle), 0, -std::sin(angle));
  };
  // From above, from below, and slantwise: always counter-clockwise about +y.
  for (const vec3& eye : {vec3(1, 6, 3.01f), vec3(1.2f, -3, 3), vec3(3, 3.5f, 6)}) {
    const View view = look_at(eye, ring.center, 0.8f);
    const RingGrip grip = taken(ring, through(view, at(0.3f)), mat4(1));
    EXPECT_FALSE(grip.edge_on);
    for (const float by : {0.5f, -1.0f, 2.5f})
      EXPECT_NEAR(turned_by(grip, through(view, at(0.3f + by))).value(), by, 1e-3f) << eye.y;
  }
}

TEST(Ring, SeenFromTheSideFollowsItsTangent) {
  const Ring ring{{0, 0, 0}, {0, 1, 0}, 0.5f};
  const View view = look_at({0, 0.1f, 4}, {0, 0, 0}, 0.8f);
  const vec3 front(0, 0, 0.5f);
  const RingGrip grip = taken(ring, through(view, front), mat4(1));
  EXPECT_TRUE(grip.edge_on);
  const RingGrip aside = taken(ring, through(view, {-0.49f, 0, 0}), mat4(1));
  EXPECT_GT(turned_by(aside, through(view, {-0.2f, 0, 0})).value(), 0.4f)
      << "where its tangent faces the eye";
  EXPECT_NEAR(turned_by(grip, through(view, front + vec3(0.25f, 0, 0))).value(), 0.5f, 1e-3f);
  EXPECT_NEAR(turned_by(grip, through(view, front - vec3(1, 0, 0))).value(), -2, 1e-3f)
      << "farther than the ring is wide";
  const Ring across{{0, 0, 0}, {0, 0, 1}, 0.5f};
  const RingGrip held = taken(across, through(view, {0.5f, 0, 0}), mat4(1));
  EXPECT_FALSE(turned_by(held, {{0, 0, 4}, {1, 0, 0}, 1e30f})) << "a ray beside its plane";
}

TEST(Ring, IsACircleAboutItsAxis) {
  const Ring ring{{1, 2, 3}, glm::normalize(vec3(1, 1, 0)), 2};
  const std::vector<vec3> points = ring_points(ring, 10);
  ASSERT_EQ(points.size(), 11u);
  EXPECT_EQ(points.front(), points.back());
  for (const vec3& p : points) {
    EXPECT_NEAR(glm::distance(p, ring.center), 2, 1e-5f);
    EXPECT_NEAR(glm::dot(p - ring.center, ring.axis), 0, 1e-5f);
  }
}

TEST(Ring, APoseIsTurnedOnTheSpot) {
  const mat4 world = with_position(with_direction(mat4(1), {0, 0, -1}), {4, 5, 6});
  const mat4 turned = turned_about(world, {0, 1, 0}, pi / 2);
  EXPECT_EQ(light_position(turned), vec3(4, 5, 6));
  EXPECT_LT(glm::distance(light_direction(turned), vec3(-1, 0, 0)), 1e-6f);
}

TEST(Steps, AreWholeMultiples) {
  EXPECT_FLOAT_EQ(in_steps(1.26f, 0.1f), 1.3f);
  EXPECT_FLOAT_EQ(in_steps(-1.26f, 0.5f), -1.5f);
  EXPECT_EQ(in_steps(1.26f, 0), 1.26f);
  EXPECT_EQ(in_steps(vec3(0.4f, 0.6f, 1.4f), -1, 1), vec3(0, 1, 1));
  EXPECT_EQ(in_steps(vec3(0.4f, 0.6f, 1.4f), 1, 1), vec3(0.4f, 1, 1.4f)) << "along one axis";
}

TEST(PanTilt, AreDegreesToTheLeftAndAboveTheHorizon) {
  const auto is = [](const vec3& direction, float pan, float tilt) {
    const PanTilt angles = pan_tilt_of(direction);
    EXPECT_NEAR(angles.pan, pan, 1e-3f);
    EXPECT_NEAR(angles.tilt, tilt, 1e-3f);
    EXPECT_LT(glm::distance(direction_of(angles), glm::normalize(direction)), 1e-5f);
  };
  is({0, 0, -2}, 0, 0);
  is({-1, 0, 0}, 90, 0);
  is({1, -std::sqrt(2.0f), -1}, -45, -45);
  is({0, -1, 0}, 0, -90);
  is({0, 3, 0}, 0, 90);
}

}  // namespace
}  // namespace ssphh::viewer
