#include <cmath>

#include <gtest/gtest.h>

#include "expect_near.h"
#include "model/view_camera.h"

namespace ssphh::viewer {
namespace {

using test::expect_near;

TEST(ViewCamera, LooksAtItsTarget) {
  for (const vec3& target : {vec3(3, 0, 0), vec3(0, 5, 0), vec3(0, -5, 0), vec3(-1, 2, 4)}) {
    const View view = look_at({0.5f, 1, 0.25f}, target, 1);
    expect_near(view.center(), target, 1e-5f);
    EXPECT_NEAR(view.right().y, 0, 1e-6f) << "the horizon is level";
    EXPECT_GE(view.up().y, -1e-6f);
  }
}

TEST(ViewCamera, ASceneCameraComesBackTheSame) {
  scene::CameraPose pose;
  pose.world = mat4(2.0f);  // a scaled node
  pose.world[3] = vec4(1, 2, 3, 1);
  pose.camera.yfov = 0.7f;
  const scene::CameraPose back = pose_of(view_of(pose, 2));
  EXPECT_EQ(vec3(back.world[3]), vec3(1, 2, 3));
  expect_near(vec3(back.world[2]), {0, 0, 1}, 1e-6f);
  EXPECT_EQ(back.camera.yfov, 0.7f);
}

TEST(ViewCamera, TurnsLeftAndUpAndStopsBeforeThePole) {
  const View ahead = look_at({0, 0, 0}, {0, 0, -1}, 1);
  expect_near(turned(ahead, pi / 2, 0).forward(), {-1, 0, 0}, 1e-6f);
  expect_near(turned(ahead, 0, pi / 4).forward(), {0, std::sqrt(0.5f), -std::sqrt(0.5f)}, 1e-6f);
  EXPECT_NEAR(turned(ahead, 0, 10).forward().y, std::sin(glm::radians(89.0f)), 1e-6f);
}

TEST(ViewCamera, OrbitKeepsTheCenterAndItsDistance) {
  const View view = look_at({4, 2, 1}, {1, 1, 1}, 1);
  const View after = orbited(view, 0.7f, -0.3f);
  expect_near(after.center(), view.center(), 1e-5f);
  EXPECT_NEAR(glm::distance(after.eye, after.center()), view.focus, 1e-5f);
  EXPECT_GT(glm::distance(after.eye, view.eye), 0.5f);
  const View nearer = dollied(view, 0.5f);
  expect_near(nearer.center(), view.center(), 1e-5f);
  EXPECT_NEAR(glm::distance(nearer.eye, nearer.center()), 0.5f * view.focus, 1e-5f);
}

TEST(ViewCamera, FramedShowsAllCornersOfABox) {
  scene::Bounds box;
  box.add({-3, 0, -1}), box.add({5, 2, 1});
  for (const float aspect : {0.5f, 1.0f, 2.0f}) {
    for (const bool orthographic : {false, true}) {
      View view = look_at({0, 0, 0}, {1, -2, 3}, 0.9f);
      view.orthographic = orthographic;
      view = framed(view, box, aspect);
      for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                     corner & 4 ? box.max.z : box.min.z);
        const vec3 seen = project(view, p, aspect);
        EXPECT_GT(seen.z, 0);
        EXPECT_TRUE(seen.x >= 0 && seen.x <= 1 && seen.y >= 0 && seen.y <= 1);
      }
    }
  }
}

TEST(ViewCamera, APixelsRayGoesThroughWhatIsProjectedThere) {
  for (const bool orthographic : {false, true}) {
    View view = look_at({1, 2, 3}, {0, 0.5f, -1}, 0.8f);
    view.orthographic = orthographic;
    const vec2 at(0.2f, 0.9f);
    const rays::RayQuery ray = pixel_ray(view, at, 1.6f);
    const vec3 seen = project(view, ray.origin + 3.0f * ray.direction, 1.6f);
    EXPECT_NEAR(seen.x, at.x, 1e-5f);
    EXPECT_NEAR(seen.y, at.y, 1e-5f);
    EXPECT_NEAR(glm::length(ray.direction), 1, 1e-6f);
  }
}

TEST(ViewCamera, EveryFieldGoesToTheSceneCameraAndBack) {
  View view = look_at({1, 2, 3}, {-1, 1, 0}, 0.6f);
  view.orthographic = true, view.yheight = 5, view.focus = 4;
  const View back = view_of(pose_of(view), 4);
  EXPECT_EQ(back.eye, view.eye);
  EXPECT_NEAR(std::abs(glm::dot(back.orientation, view.orientation)), 1, 1e-6f);
  EXPECT_EQ(back.yfov, 0.6f);
  EXPECT_EQ(back.focus, 4);
  EXPECT_TRUE(back.orthographic);
  EXPECT_EQ(back.yheight, 5);
}

// Three axes of different lengths, one of them leaning.
TEST(ViewCamera, LeavesScaleAndShearOfANodeOut) {
  scene::CameraPose pose;
  pose.world = {vec4(0, 2, 0, 0), vec4(-3, 1, 0, 0), vec4(0, 0, 5, 0), vec4(0, 0, 0, 1)};
  const View view = view_of(pose, 1);
  expect_near(view.forward(), {0, 0, -1}, 1e-6f);
  expect_near(view.up(), glm::normalize(vec3(-3, 1, 0)), 1e-6f);
  expect_near(view.right(), glm::normalize(vec3(1, 3, 0)), 1e-6f);
}

TEST(ViewCamera, StraightUpAndDownTheTopOfThePictureTellsWhereItFaces) {
  expect_near(look_at({0, 0, 0}, {0, 5, 0}, 1).up(), {0, 0, 1}, 1e-6f);
  expect_near(look_at({0, 0, 0}, {0, -5, 0}, 1).up(), {0, 0, -1}, 1e-6f);
  // Facing −x; a turn to the left from straight above or below faces +z.
  const View ahead = look_at({0, 0, 0}, {-1, 0, 0}, 1);
  for (const float pole : {-1.0f, 1.0f}) {
    View view = ahead;
    view.orientation = glm::angleAxis(pi / 2, vec3(0, 1, 0)) * glm::angleAxis(pole * pi / 2, vec3(1, 0, 0));
    const View turned_left = turned(turned(view, pi / 2, 0), 0, -pole * glm::radians(89.0f));
    expect_near(turned_left.forward(), {0, 0, 1}, 1e-3f);
  }
}

TEST(ViewCamera, TurnsKeepWhereItStandsAndWhatItSees) {
  View view = look_at({1, 2, 3}, {4, 2, 2}, 0.7f);
  view.focus = 9, view.yheight = 3;
  const View out = turned(view, 0.25f, 0.5f);
  EXPECT_EQ(out.eye, view.eye);
  EXPECT_EQ(out.focus, 9);
  EXPECT_EQ(out.yheight, 3);
  EXPECT_EQ(out.yfov, 0.7f);
  EXPECT_NEAR(out.forward().y, std::sin(0.5f), 1e-6f);
  EXPECT_NEAR(turned(view, 0, -10).forward().y, -std::sin(glm::radians(89.0f)), 1e-6f);
  View rolled = view;
  rolled.orientation = view.orientation * glm::angleAxis(0.5f, vec3(0, 0, 1));
  EXPECT_NEAR(turned(rolled, 0, 0).right().y, 0, 1e-6f) << "levels the horizon";
}

TEST(ViewCamera, MovesAlongItsOwnAxes) {
  const View view = look_at({1, 2, 3}, {0, 3, 1}, 1);
  const View out = moved(view, {2, -3, 5});
  expect_near(out.eye, view.eye + 2.0f * view.right() - 3.0f * view.up() + 5.0f * view.forward(), 1e-5f);
  EXPECT_EQ(out.orientation, view.orientation);
  EXPECT_EQ(out.focus, view.focus);
}

TEST(ViewCamera, AMillimetreRemainsBeforeTheFocus) {
  View view = look_at({0, 0, 0}, {0, 0, -2}, 1);
  view.yheight = 3;
  const View near = dollied(view, 1e-9f);
  EXPECT_FLOAT_EQ(near.focus, 1e-3f);
  EXPECT_FLOAT_EQ(near.yheight, 1e-3f);
  expect_near(near.eye, {0, 0, -1.999f}, 1e-5f);
  const View far = dollied(view, 2);
  EXPECT_EQ(far.focus, 4);
  EXPECT_EQ(far.yheight, 6);
  expect_near(far.eye, {0, 0, 2}, 1e-5f);
  EXPECT_EQ(look_at({1, 1, 1}, {1, 1, 1}, 1).focus, 1e-3f);
}

// The ball around the box touches the picture's nearer edges: half the angle's sine is radius over distance.
TEST(ViewCamera, FramedIsNoFartherAwayThanNeeded) {
  scene::Bounds box;
  box.add({-2, -1, -2}), box.add({2, 1, 2});
  const float radius = 3;
  for (const float aspect : {0.5f, 1.0f, 2.0f}) {
    const View view = framed(look_at({0, 0, 0}, {0, 0, -1}, 0.9f), box, aspect);
    const float half = std::min(0.45f, std::atan(aspect * std::tan(0.45f)));
    EXPECT_NEAR(view.focus, radius / std::sin(half), 1e-4f) << aspect;
    expect_near(view.eye, {0, 0, view.focus}, 1e-4f);
    EXPECT_NEAR(view.yheight, 2 * radius / std::min(aspect, 1.0f), 1e-4f) << aspect;
  }
  const View view = look_at({0, 0, 0}, {0, 0, -1}, 0.9f);
  EXPECT_EQ(framed(view, scene::Bounds{}, 1), view);
}

// A view along −z, 90 degrees high: one metre at one metre's distance, twice as wide.
TEST(ViewCamera, ProjectsByHandOverTwoAxes) {
  View view = look_at({0, 0, 0}, {0, 0, -1}, pi / 2);
  expect_near(project(view, {2, -1, -2}, 2), {0.75f, 0.25f, 2}, 1e-6f);
  EXPECT_LT(project(view, {0, 0, 1}, 2).z, 0);
  view.orthographic = true, view.yheight = 8;
  expect_near(project(view, {2, -1, -2}, 2), {0.625f, 0.375f, 2}, 1e-6f);
  const rays::RayQuery ray = pixel_ray(view, {0.625f, 0.375f}, 2);
  expect_near(ray.origin, {2, -1, 0}, 1e-6f);
  expect_near(ray.direction, {0, 0, -1}, 1e-6f);
}

TEST(ViewCamera, StartsWithTheseValues) {
  const View view;
  EXPECT_EQ(view.yfov, 0.8f);
  EXPECT_EQ(view.focus, 3);
  EXPECT_EQ(view.yheight, 2);
  EXPECT_FALSE(view.orthographic);
  EXPECT_EQ(view.forward(), vec3(0, 0, -1));
}

}  // namespace
}  // namespace ssphh::viewer
