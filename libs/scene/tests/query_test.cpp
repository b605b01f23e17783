#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

TEST(Bounds, EncloseTransformedInstancesAndCountEachInstance) {
  Scene scene;
  scene.meshes.push_back(make_box(vec3(-1), vec3(1)));
  scene.nodes.resize(2);
  scene.nodes[1].local.translation = {10, 0, 0};
  scene.nodes[1].local.scale = {1, 2, 3};
  scene.instances.resize(2);
  scene.instances[0].mesh = scene.instances[1].mesh = 0;
  scene.instances[0].node = 0, scene.instances[1].node = 1;
  const Bounds bounds = world_bounds(scene, world_matrices(scene));
  EXPECT_EQ(bounds.min, vec3(-1, -2, -3));
  EXPECT_EQ(bounds.max, vec3(11, 2, 3));
  EXPECT_EQ(triangle_count(scene), 24u);
  EXPECT_TRUE(world_bounds(Scene{}, {}).empty());
  EXPECT_EQ(Bounds{}.radius(), 0);
}

TEST(Bounds, WhatStandsAtNoNodeStandsAtTheOrigin) {
  Scene scene;
  scene.meshes.push_back(make_box({1, 2, 3}, {4, 5, 6}));
  scene.instances = {{0, -1, -1, {}}};
  scene.sphls = {{"s", -1, 0.1f, true}};
  scene.cameras.resize(1);
  EXPECT_EQ(world_bounds(scene, {}).min, vec3(1, 2, 3));
  EXPECT_EQ(world_bounds(scene, {}).max, vec3(4, 5, 6));
  EXPECT_EQ(sphl_places(scene).at(0).position, vec3(0));
  EXPECT_EQ(camera_pose(scene, "").world, mat4(1));
}

TEST(LightGroups, FollowFirstUseAndDefaultToNames) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].emission = vec3(1);
  scene.meshes.resize(1);
  scene.nodes.resize(1);
  scene.nodes[0].name = "panel";
  scene.instances = {{0, 0, 0, "never lit"}, {0, 0, 1, ""}, {0, 0, 1, "b"}};
  scene.lights.resize(3);
  scene.lights[0].name = "a", scene.lights[1].name = "x", scene.lights[1].group = "b",
  scene.lights[2].name = "a";
  scene.environment.emplace();
  const std::vector<std::string> groups = light_groups(scene);
  EXPECT_EQ(groups, (std::vector<std::string>{"a", "b", "panel", "environment"}));
  EXPECT_EQ(light_group_index(groups, "panel"), 2);
}

TEST(LightGroups, BeyondTheLimitShareTheLastOne) {
  Scene scene;
  for (int i = 0; i < 300; ++i) {
    scene.lights.emplace_back();
    scene.lights.back().name = std::to_string(i);
  }
  const std::vector<std::string> groups = light_groups(scene);
  ASSERT_EQ(groups.size(), 256u);
  EXPECT_EQ(groups.back(), "other");
  EXPECT_EQ(light_group_index(groups, "254"), 254);
  EXPECT_EQ(light_group_index(groups, "255"), 255);
  EXPECT_EQ(light_group_index(groups, "299"), 255);
}

TEST(LightGroups, AsManyAsTheLimitKeepTheirNames) {
  Scene scene;
  scene.lights.resize(256);
  for (std::size_t i = 0; i < 256; ++i) scene.lights[i].name = std::to_string(i);
  EXPECT_EQ(light_groups(scene).back(), "255");
}

TEST(Cameras, AreFoundByNameAndTheFirstIsTheDefault) {
  const Scene scene = make_builtin("two-rooms");
  EXPECT_EQ(find_camera(scene, "").name, "room-a");
  EXPECT_EQ(find_camera(scene, "room-b").name, "room-b");
  try {
    find_camera(scene, "room-c");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(e.hint().find("room-a, room-b"), std::string::npos);
  }
}

TEST(Cameras, PoseHasNoScaleAndLooksAlongMinusZ) {
  Scene scene = make_builtin("two-rooms");
  scene.nodes[scene.cameras[0].node].local.scale = {2, 0.3f, 4};
  const mat4 pose = camera_pose(scene, "").world;
  EXPECT_NEAR(glm::determinant(mat3(pose)), 1, 1e-5f);  // float rounding
  const vec3 expected = glm::normalize(vec3(0, 1.2f, -0.1f) - vec3(-3.8f, 1.6f, 0.9f));
  EXPECT_LT(glm::distance(-vec3(pose[2]), expected), 1e-5f);
}

TEST(Cameras, SceneWithoutAnyIsSeenWhole) {
  Scene scene;
  scene.meshes.push_back(make_sphere(3, 32, 16));
  scene.nodes.resize(1);
  scene.nodes[0].local.translation = {5, 6, 7};
  scene.instances.resize(1);
  scene.instances[0].mesh = scene.instances[0].node = 0;
  const CameraPose pose = camera_pose(scene, "");
  const vec3 to_center = vec3(5, 6, 7) - vec3(pose.world[3]);
  EXPECT_LT(to_center.z, 0);
  EXPECT_LT(glm::distance(glm::normalize(to_center), vec3(0, 0, -1)), 1e-6f);  // float rounding
  // As near as sees the sphere around the bounds, whose half diagonal is 3 √3, whole
  EXPECT_NEAR(std::sin(pose.camera.yfov / 2) * glm::length(to_center), 3 * std::sqrt(3.0f), 1e-5f);
  EXPECT_EQ(pose.camera.name, "default");
  EXPECT_EQ(mat3(pose.world), mat3(1));
  EXPECT_EQ(pose.world[3].w, 1);
  EXPECT_EQ(camera_pose(Scene{}, "").camera.name, "default");
  EXPECT_THROW(camera_pose(scene, "main"), Error);
}

TEST(SphlPlaces, LeaveOutDisabledOnesAndFollowAnimations) {
  Scene scene;
  scene.nodes.resize(2);
  scene.nodes[0].local.translation = {1, 2, 3};
  scene.sphls = {{"a", 0, 0.2f, true}, {"b", 0, 0.1f, false}, {"c", 1, 0.1f, true}};
  scene.animations.resize(1);
  scene.animations[0].channels.push_back(
      {1, AnimationPath::translation, Interpolation::linear, {0, 1}, {vec4(0), vec4(4)}});
  const std::vector<ProbePlace> places = sphl_places(scene, 0.5f);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].name, "a");
  EXPECT_EQ(places[0].position, vec3(1, 2, 3));
  EXPECT_EQ(places[0].radius, 0.2f);
  EXPECT_EQ(places[1].position, vec3(2));
}

}  // namespace
}  // namespace ssphh::scene
