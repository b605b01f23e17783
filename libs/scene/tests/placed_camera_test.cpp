/// Cameras given as text.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/placed_camera.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

TEST(PlacedCamera, StandsUprightAtItsPlaceAndLooksAtTheOther) {
  Pcg32 rng(5);
  for (int i = 0; i < 100; ++i) {
    const auto place = [&] { return 20.0f * vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 10.0f; };
    const vec3 eye = place(), to = place();
    const auto camera =
        placed_camera(fmt::format("{},{},{}:{},{},{}:{}", eye.x, eye.y, eye.z, to.x, to.y, to.z, 10 + i));
    ASSERT_TRUE(camera);
    const mat4& world = camera->pose.world;
    EXPECT_EQ(vec3(world[3]), eye);
    const vec3 ahead = glm::normalize(to - eye);
    EXPECT_LT(glm::distance(-vec3(world[2]), ahead), 1e-5f);
    EXPECT_LT(std::abs(world[0].y), 1e-5f) << "its right is level";
    EXPECT_GT(world[1].y, 0) << "and its top up";
    EXPECT_NEAR(glm::determinant(mat3(world)), 1, 1e-5);
    EXPECT_FLOAT_EQ(camera->distance, glm::distance(eye, to));
    EXPECT_FLOAT_EQ(camera->pose.camera.yfov, glm::radians(10.0f + static_cast<float>(i)));
  }
}

TEST(PlacedCamera, StraightDownHasMinusZAtItsTop) {
  const auto down = placed_camera("1,5,2:1,0,2");
  ASSERT_TRUE(down);
  EXPECT_LT(glm::distance(vec3(down->pose.world[1]), vec3(0, 0, -1)), 1e-6f);
  EXPECT_FLOAT_EQ(down->pose.camera.yfov, glm::radians(50.0f));
}

TEST(PlacedCamera, NamesAreNone) {
  for (const char* name : {"", "door", "view 3", "1,2", "a:b", "1,2,x:3,4,5"})
    EXPECT_FALSE(placed_camera(name)) << name;
}

TEST(PlacedCamera, WhatBeginsWithAPlaceAndIsNoneIsRefused) {
  for (const char* text :
       {"1,2,3", "1,2,3:4,5", "1,2,3:", "1,2,3:4,5,6:", "1,2,3:4,5,6:x", "1,2,3:4,5,6:50:7"})
    EXPECT_EQ(test::message_of([&] { placed_camera(text); }),
              fmt::format("camera {}: it cannot be read (a camera that is placed is X,Y,Z:TO_X,TO_Y,TO_Z or "
                          "X,Y,Z:TO_X,TO_Y,TO_Z:DEGREES)",
                          text));
  EXPECT_EQ(test::message_of([] { placed_camera("1,2,3:1,2,3"); }),
            "camera 1,2,3:1,2,3: it looks at the place where it stands");
  for (const char* degrees : {"0", "-5", "180"})
    EXPECT_EQ(test::message_of([&] { placed_camera(fmt::format("0,0,0:0,0,1:{}", degrees)); }),
              fmt::format("camera 0,0,0:0,0,1:{0}: its field of view is {0}° (it must lie between 0 and 180)",
                          degrees));
}

TEST(PlacedCamera, IsTakenWhereACameraIsAskedForUnlessOneHasItsName) {
  Scene scene = make_builtin("two-rooms");
  const CameraPose placed = camera_pose(scene, "1,1.5,2:0,1,0:35");
  EXPECT_EQ(vec3(placed.world[3]), vec3(1, 1.5f, 2));
  scene.cameras[1].name = "1,1.5,2:0,1,0:35";
  const CameraPose named = camera_pose(scene, "1,1.5,2:0,1,0:35");
  EXPECT_EQ(named.camera.node, scene.cameras[1].node);
}

}  // namespace
}  // namespace ssphh::scene
