// Where the commands put cameras that they move by themselves, and the times that they tell.

#include "results/moving_camera.h"

#include <gtest/gtest.h>

#include "results/percentile.h"

namespace ssphh::app {
namespace {

void expect_near(const vec3& a, const vec3& b, float tolerance = 1e-5f) {
  EXPECT_LE(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Percentile, IsTheSmallestValueThatTheShareDoesNotExceed) {
  const std::vector<double> values = {7, 1, 5, 3};
  EXPECT_EQ(percentile(values, 0.25), 1);
  EXPECT_EQ(percentile(values, 0.26), 3);
  EXPECT_EQ(percentile(values, 0.5), 3);
  EXPECT_EQ(percentile(values, 0.51), 5);
  EXPECT_EQ(percentile(values, 0.99), 7);
  EXPECT_EQ(percentile(values, 0), 1);
  EXPECT_EQ(percentile({2, 9, 4}, 0.5), 4);
  EXPECT_EQ(percentile({}, 0.5), 0);
}

TEST(MovingCamera, TurnsAboutTheVerticalWhereItStands) {
  scene::CameraPose pose;
  pose.world = mat4(1);
  pose.world[3] = vec4(4, 5, 6, 1);
  const scene::CameraPose left = turned(pose, 0.25f), back = turned(pose, 0.5f), all = turned(pose, 1);
  expect_near(-vec3(left.world[2]), {-1, 0, 0});
  expect_near(vec3(left.world[0]), {0, 0, -1});
  expect_near(vec3(left.world[1]), {0, 1, 0});
  expect_near(-vec3(back.world[2]), {0, 0, 1});
  expect_near(-vec3(all.world[2]), {0, 0, -1});
  for (const scene::CameraPose& turn : {left, back, all}) EXPECT_EQ(turn.world[3], pose.world[3]);
}

TEST(MovingCamera, OrbitsSoThatABallAroundTheBoxFits) {
  const scene::Bounds box{vec3(1, 2, 3), vec3(3, 5, 9)};  // of radius 3.5 about (2, 3.5, 6)
  for (const float aspect : {0.5f, 1.0f, 2.0f}) {
    for (const float turn : {0.0f, 0.5f * pi, 2.0f}) {
      const float elevation = 0.4f, yfov = 0.9f;
      const scene::CameraPose pose = orbit(box, yfov, aspect, elevation, turn);
      EXPECT_EQ(pose.camera.yfov, yfov);
      const vec3 eye(pose.world[3]), forward = -vec3(pose.world[2]), to_middle = vec3(2, 3.5f, 6) - eye;
      expect_near(glm::normalize(to_middle), forward);
      // Up and to the side of the turn, level on the horizon.
      const vec3 away = -glm::normalize(to_middle);
      EXPECT_NEAR(std::asin(away.y), elevation, 1e-5f);
      EXPECT_NEAR(std::remainder(std::atan2(away.x, away.z) - turn, 2 * pi), 0, 1e-5f);
      EXPECT_NEAR(pose.world[0].y, 0, 1e-6f);
      EXPECT_GT(pose.world[1].y, 0);
      // Distance of the middle from the plane through the eye and the picture's narrower edge.
      const float half = 0.5f * yfov, side = std::atan(aspect * std::tan(half));
      EXPECT_NEAR(glm::length(to_middle) * std::sin(std::min(half, side)), 1.05f * 3.5f, 1e-4f);
    }
  }
  const scene::CameraPose point = orbit({vec3(1), vec3(1)}, 0.9f, 1, 0, 0);
  EXPECT_NEAR(point.world[3].z, 1 + 1.05e-3f / std::sin(0.45f), 1e-6f) << "a box without size";
}

TEST(MovingCamera, ForthAndBackTakesAHundredFrames) {
  EXPECT_EQ(forth_and_back(0), 0);
  EXPECT_NEAR(forth_and_back(25), 0.5f, 1e-6f);
  EXPECT_NEAR(forth_and_back(10), 0.5f - 0.5f * std::cos(0.2f * pi), 1e-6f);
  EXPECT_NEAR(forth_and_back(50), 1, 1e-6f);
  EXPECT_EQ(forth_and_back(90), forth_and_back(190));
  EXPECT_NEAR(forth_and_back(90), forth_and_back(110), 1e-6f);
}

}  // namespace
}  // namespace ssphh::app
