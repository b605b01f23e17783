#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/builtin.h>

#include "geometry.h"

namespace ssphh::scene {
namespace {

std::vector<Triangle> inner_skin(const Scene& scene) {
  std::vector<Triangle> skin = world_triangles(scene, 0, "room");
  const auto doorway = world_triangles(scene, 0, "doorway");
  skin.insert(skin.end(), doorway.begin(), doorway.end());
  return skin;
}

TEST(TwoRooms, InnerAndOuterSkinAreClosedAndEncloseTheStatedVolumes) {
  const Scene scene = make_builtin("two-rooms");
  const auto inside = inner_skin(scene), outside = world_triangles(scene, 0, "outside");
  EXPECT_EQ(open_edges(inside), 0);
  EXPECT_EQ(open_edges(outside), 0);
  // Faces inward: two rooms and the doorway. Float coordinates: 1e-5 of it.
  EXPECT_NEAR(signed_volume(inside), -(2 * 4 * 3 * 4 + 0.9 * 2.1 * 0.15), 1e-3);
  EXPECT_NEAR(signed_volume(outside), (8.15 + 0.3) * 3.3 * 4.3, 1e-3);
}

TEST(TwoRooms, LampCamerasAndSphlsStandInside) {
  const Scene scene = make_builtin("two-rooms");
  const auto inside = inner_skin(scene), door = world_triangles(scene, 0, "door ");
  const auto expect_inside = [&](const vec3& p, const std::string& name) {
    EXPECT_NEAR(winding_number(p, inside), -1, 1e-4) << name;
  };
  for (const ProbePlace& place : sphl_places(scene)) expect_inside(place.position, place.name);
  for (const Camera& camera : scene.cameras) {
    expect_inside(vec3(camera_pose(scene, camera.name).world[3]), camera.name);
  }
  ASSERT_EQ(scene.lights.size(), 1u);
  const vec3 lamp(world_matrices(scene)[scene.lights[0].node][3]);
  expect_inside(lamp, "lamp");
  EXPECT_LT(lamp.x, -0.1f);
}

vec3 point_in_room(Pcg32& random, float sign) {
  const vec3 u = random.uniform3();
  return {sign * (0.08f + 3.99f * u.x), 0.002f + 2.996f * u.y, -1.998f + 3.996f * u.z};
}

/// Straight ways from room A to B that nothing blocks, among n random ones.
int open_ways(float time, int n) {
  const Scene scene = make_builtin("two-rooms");
  const auto triangles = world_triangles(scene, time);
  Pcg32 random(7);
  int open = 0;
  for (int i = 0; i < n; ++i) {
    const vec3 a = point_in_room(random, -1), b = point_in_room(random, 1);
    open +=
        std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return crosses(a, b, t); });
  }
  return open;
}

TEST(TwoRooms, ShutDoorLetsNothingPass) {
  EXPECT_EQ(open_ways(0, 100'000), 0);
}

TEST(TwoRooms, OpenDoorLetsSomePass) {
  EXPECT_GT(open_ways(1, 20'000), 200);
  EXPECT_GT(open_ways(1, 20'000), open_ways(0.3f, 20'000));
}

/// Points in the doorway just off its edges, and in B just off the leaf: the seal has no crack.
TEST(TwoRooms, ShutDoorIsSealedAtItsEdges) {
  const auto triangles = world_triangles(make_builtin("two-rooms"));
  Pcg32 random(8);
  for (int i = 0; i < 20'000; ++i) {
    // A point of the opening's border, a little inside it.
    const float s = random.uniform() * (2 * 2.1f + 2 * 0.9f), off = 1e-3f * random.uniform() + 1e-5f;
    vec3 a(0.07f, 0, 0);
    if (s < 2.1f)
      a = {0.07f, s, -0.45f + off};
    else if (s < 4.2f)
      a = {0.07f, s - 2.1f, 0.45f - off};
    else if (s < 5.1f)
      a = {0.07f, off, s - 4.65f};
    else
      a = {0.07f, 2.1f - off, s - 5.55f};
    a.y = std::clamp(a.y, off, 2.1f - off);
    a.z = std::clamp(a.z, -0.45f + off, 0.45f - off);
    const vec3 b = point_in_room(random, 1);
    EXPECT_TRUE(
        std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return crosses(a, b, t); }))
        << a.y << " " << a.z;
  }
}

TEST(TwoRooms, DoorTurnsWithoutTouchingTheWalls) {
  const Scene scene = make_builtin("two-rooms");
  for (int step = 0; step <= 20; ++step) {
    const float time = static_cast<float>(step) / 20;
    for (const Triangle& t : world_triangles(scene, time, "door")) {
      // "doorway ..." nodes begin alike: the leaf is what lies in B beyond the wall's face.
      if (std::max({t[0].x, t[1].x, t[2].x}) < 0.0751f) continue;
      for (const vec3& p : t) {
        EXPECT_GE(p.x, 0.075f - 1e-6f) << time;
        EXPECT_GE(p.z, -2) << time;
        EXPECT_LE(p.z, 2) << time;
      }
    }
  }
  // Open, the doorway itself is clear.
  const auto open = world_triangles(scene, 1);
  for (const float z : {-0.43f, 0.0f, 0.43f}) {
    const vec3 a(-1, 1, z), b(1, 1, z);
    EXPECT_TRUE(std::none_of(open.begin(), open.end(), [&](const Triangle& t) { return crosses(a, b, t); }))
        << z;
  }
}

TEST(TwoRooms, OnlyTheDoorIsMovable) {
  const Scene scene = make_builtin("two-rooms");
  std::set<std::string> movable;
  for (const Node& node : scene.nodes) {
    if (node.movable) movable.insert(node.name);
  }
  EXPECT_EQ(movable, std::set<std::string>{"door"});
  EXPECT_EQ(animation_duration(scene), 1);
}

TEST(GlowingBox, IsClosedFacesInwardAndHoldsItsSphls) {
  const Scene scene = make_builtin("box");
  const auto walls = world_triangles(scene);
  EXPECT_EQ(open_edges(walls), 0);
  EXPECT_DOUBLE_EQ(signed_volume(walls), -8);
  for (const ProbePlace& place : sphl_places(scene)) {
    EXPECT_NEAR(winding_number(place.position, walls), -1, 1e-4) << place.name;
  }
  EXPECT_NEAR(winding_number(vec3(camera_pose(scene, "").world[3]), walls), -1, 1e-4);
}

TEST(Furnace, BodyIsConvexWithFlatNormals) {
  const Scene scene = make_builtin("furnace");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  const auto body = world_triangles(scene);
  EXPECT_EQ(open_edges(body), 0);
  float worst = 0;
  for (const Triangle& t : body) {
    const vec3 n = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    for (const vec3& p : scene.meshes[0].positions) worst = std::max(worst, glm::dot(n, p - t[0]));
  }
  EXPECT_LT(worst, 1e-6f);  // float rounding of a body of radius 1
  for (const ProbePlace& place : sphl_places(scene))
    EXPECT_NEAR(winding_number(place.position, body), 0, 1e-4);
}

class Gallery : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, ::testing::Values("gallery1", "gallery2", "gallery3"));

TEST_P(Gallery, HallIsClosed) {
  const Scene scene = make_builtin(GetParam());
  std::vector<Triangle> hall;
  for (const char* part : {"floor", "ceiling", "back wall", "front wall", "left wall", "right wall"}) {
    const auto triangles = world_triangles(scene, 0, part);
    hall.insert(hall.end(), triangles.begin(), triangles.end());
  }
  EXPECT_EQ(open_edges(hall), 0);
  EXPECT_NEAR(signed_volume(hall), -10 * 4 * 8, 1e-3);
}

TEST_P(Gallery, BodiesAreClosedSoThatSphlsAreOutsideOfAll) {
  const Scene scene = make_builtin(GetParam());
  const std::vector<mat4> world = world_matrices(scene);
  int bodies = 0;
  for (const Instance& instance : scene.instances) {
    const auto node = static_cast<std::size_t>(instance.node);
    const auto body = triangles_of(scene.meshes[instance.mesh], world[node]);
    if (body.size() < 3) continue;  // walls and strips are single quads
    ++bodies;
    EXPECT_EQ(open_edges(triangles_of(scene.meshes[instance.mesh])), 0) << scene.nodes[node].name;
    for (const ProbePlace& place : sphl_places(scene)) {
      EXPECT_NEAR(winding_number(place.position, body), 0, 1e-4)
          << place.name << " in " << scene.nodes[node].name;
    }
  }
  EXPECT_GE(bodies, 10);
}

struct Lamp {
  vec3 position, axis;
  float cos_cone;  // shines where the cosine to the axis is larger
  bool visible;    // has a size
};

std::vector<Lamp> lamps_of(const Scene& scene) {
  const std::vector<mat4> world = world_matrices(scene);
  std::vector<Lamp> lamps;
  for (const Light& light : scene.lights) {
    const mat4& m = world[light.node];
    const float cos_cone = light.type == LightType::spot ? std::cos(light.outer_cone) : -1.0f;
    lamps.push_back({vec3(m[3]), -vec3(m[2]), cos_cone, light.type == LightType::sphere});
  }
  for (const Instance& instance : scene.instances) {
    if (instance.light_group.empty()) continue;
    // A quad: five points along its middle line.
    const Mesh& mesh = scene.meshes[instance.mesh];
    const vec3 a = mesh.positions[0], b = mesh.positions[1], d = mesh.positions[3];
    for (int i = 0; i < 5; ++i) {
      const float s = 0.1f + 0.2f * static_cast<float>(i);
      lamps.push_back({0.5f * (a + b) + s * (d - a), mesh.normals[0], 0, true});
    }
  }
  return lamps;
}

/// Nearest hit of the ray within 30 m; its distance and the unit normal toward the viewer.
std::pair<float, vec3> nearest_hit(const vec3& eye, const vec3& direction,
                                   const std::vector<Triangle>& triangles) {
  float nearest = 30;
  vec3 normal(0);
  for (const Triangle& t : triangles) {
    if (!crosses(eye, eye + nearest * direction, t)) continue;
    const vec3 n = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    nearest = glm::dot(t[0] - eye, n) / glm::dot(direction, n);
    normal = glm::dot(n, direction) < 0 ? n : -n;
  }
  return {nearest, normal};
}

/// The paper's galleries need indirect light: from the main camera no lamp is seen, and less than a third of
/// what is seen is lit by any of them directly.
TEST_P(Gallery, MainViewIsMostlyIndirect) {
  const Scene scene = make_builtin(GetParam());
  const CameraPose pose = camera_pose(scene, "main");
  const auto triangles = world_triangles(scene);
  const std::vector<Lamp> lamps = lamps_of(scene);
  ASSERT_FALSE(lamps.empty());
  const auto open = [&](const vec3& a, const vec3& b) {
    return std::none_of(triangles.begin(), triangles.end(),
                        [&](const Triangle& t) { return crosses(a, b, t); });
  };
  const vec3 eye(pose.world[3]);
  for (const Lamp& lamp : lamps) {
    EXPECT_FALSE(lamp.visible && open(eye, lamp.position + 2e-3f * lamp.axis)) << lamp.position.x;
  }
  int seen = 0, lit = 0;
  const float tan_y = std::tan(pose.camera.yfov / 2), tan_x = tan_y * 16 / 9;
  for (int y = 0; y < 14; ++y) {
    for (int x = 0; x < 24; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / 12 - 1, v = 1 - (static_cast<float>(y) + 0.5f) / 7;
      const vec3 direction = glm::normalize(vec3(pose.world * vec4(u * tan_x, v * tan_y, -1, 0)));
      const std::pair<float, vec3> hit = nearest_hit(eye, direction, triangles);
      const vec3 normal = hit.second;
      const vec3 p = eye + hit.first * direction + 1e-3f * normal;
      ++seen;
      lit += std::any_of(lamps.begin(), lamps.end(), [&](const Lamp& lamp) {
        const vec3 l = lamp.position + 2e-3f * lamp.axis, to_p = glm::normalize(p - l);
        return glm::dot(to_p, lamp.axis) > lamp.cos_cone && glm::dot(to_p, normal) < 0 && open(p, l);
      });
    }
  }
  RecordProperty("lit", lit);
  RecordProperty("seen", seen);
  EXPECT_LT(2 * lit, seen);
  EXPECT_GT(lit, 0);
}

TEST_P(Gallery, HasTwoOrMoreLightGroupsAndAtMostSixSphls) {
  const Scene scene = make_builtin(GetParam());
  EXPECT_GE(light_groups(scene).size(), 2u);
  EXPECT_LE(scene.sphls.size(), 6u);
}

TEST(Gallery1, HasExactlySixSphls) {
  EXPECT_EQ(make_builtin("gallery1").sphls.size(), 6u);
}

TEST(Gallery3, IsComplex) {
  const std::uint64_t count = triangle_count(make_builtin("gallery3"));
  EXPECT_GE(count, 30'000u);
  EXPECT_LE(count, 100'000u);
}

}  // namespace
}  // namespace ssphh::scene
