// What the Cornell box and the court are meant to be: which way their walls face, where they are open, and
// that all that stands in them does so on the floor.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>

#include "geometry.h"

namespace ssphh::scene {
namespace {

std::vector<Triangle> named_triangles(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<Triangle> all;
  for (const std::string& name : names) {
    const std::vector<Triangle> part = world_triangles(scene, 0, name);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

Bounds bounds_of(const std::vector<Triangle>& triangles) {
  Bounds bounds;
  for (const Triangle& t : triangles)
    for (const vec3& p : t) bounds.add(p);
  return bounds;
}

bool faces(const Triangle& t, const vec3& place) {
  return glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), place - t[0]) > 0;
}

TEST(Cornell, IsABoxOfTwoMetresThatFacesInwardAndIsOpenToTheCamera) {
  const Scene scene = make_builtin("cornell");
  const std::vector<Triangle> walls =
      named_triangles(scene, {"floor", "ceiling", "back wall", "left wall", "right wall"});
  EXPECT_EQ(open_edges(walls), 4) << "around the open side";
  EXPECT_EQ(bounds_of(walls).min, vec3(-1, 0, -1));
  EXPECT_EQ(bounds_of(walls).max, vec3(1, 2, 1));
  for (const Triangle& t : walls) EXPECT_TRUE(faces(t, {0, 1, 0}));
  // A fifth of a sixth is missing: the cone from the middle to the open side.
  EXPECT_NEAR(winding_number({0, 1, 0}, walls), -5.0 / 6, 1e-6);
  EXPECT_EQ(vec3(camera_pose(scene, "front").world[3]), vec3(0, 1, 3.9f));
}

TEST(Cornell, TheLampHangsUnderTheCeilingAndShinesDown) {
  const Scene scene = make_builtin("cornell");
  const std::vector<Triangle> lamp = world_triangles(scene, 0, "lamp");
  for (const Triangle& t : lamp) {
    EXPECT_TRUE(faces(t, {0, 1, 0}));
    for (const vec3& p : t) EXPECT_FLOAT_EQ(p.y, 1.98f);
  }
  EXPECT_NEAR(area(lamp), 0.47 * 0.38, 1e-6);  // float rounding
  EXPECT_EQ(light_groups(scene), std::vector<std::string>{"lamp"});
}

TEST(Cornell, BoxesStandOnTheFloorWithoutTouching) {
  const Scene scene = make_builtin("cornell");
  const std::vector<Triangle> tall = world_triangles(scene, 0, "tall"),
                              small = world_triangles(scene, 0, "short");
  for (const auto& [box, height] : {std::pair{tall, 1.2f}, {small, 0.6f}}) {
    const Bounds b = bounds_of(box);
    EXPECT_EQ(b.min.y, 0);
    EXPECT_EQ(b.max.y, height);
    EXPECT_NEAR(signed_volume(box), 0.36 * static_cast<double>(height), 1e-6);
    EXPECT_GT(b.min.x, -1);
    EXPECT_LT(b.max.x, 1);
    EXPECT_GT(b.min.z, -1);
    EXPECT_LT(b.max.z, 1);
  }
  for (const Triangle& t : small)
    for (const vec3& p : t)
      for (const Triangle& other : tall) EXPECT_GT(distance(p, other), 0.02f);
}

TEST(Court, StandsAroundAFloorUnderAnOpenSky) {
  const Scene scene = make_builtin("court");
  const Bounds floor = bounds_of(world_triangles(scene, 0, "floor"));
  EXPECT_EQ(floor.min, vec3(-2, 0, -2));
  EXPECT_EQ(floor.max, vec3(2, 0, 2));
  EXPECT_EQ(bounds_of(named_triangles(scene, {"left", "right", "back", "sill"})).max, vec3(2.2f, 2, 2));
  for (const char* body : {"block", "knot", "ball"}) {
    const std::vector<Triangle> triangles = world_triangles(scene, 0, body);
    const Bounds b = bounds_of(triangles);
    EXPECT_EQ(
        open_edges(triangles_of(scene.meshes[std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                                          [&](const Mesh& m) { return m.name == body; }) -
                                             scene.meshes.begin()])),
        0)
        << body;
    EXPECT_GE(b.min.y, -1e-6f) << body;
    EXPECT_LT(b.min.y, 0.1f) << body << " does not hover";
    EXPECT_GT(b.min.x, -2) << body;
    EXPECT_LT(b.max.x, 2) << body;
    EXPECT_GT(b.min.z, -2) << body;
    EXPECT_LT(b.max.z, 1.8f) << body;
  }
  EXPECT_TRUE(scene.lights.empty());
  for (const float v : scene.environment->equirect.pixels) EXPECT_GT(v, 0);
}

}  // namespace
}  // namespace ssphh::scene
