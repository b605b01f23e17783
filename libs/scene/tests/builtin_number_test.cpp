// Built-in scenes that come in many.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "error_message.h"
#include "geometry.h"

namespace ssphh::scene {
namespace {

using ssphh::test::message_of;

std::string numbered(const std::string& name, int number) {
  return name + "=" + std::to_string(number);
}

std::size_t count(const Scene& scene, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::count_if(
      scene.instances, [&](const Instance& instance) { return scene.nodes[instance.node].name == name; }));
}

float extent(const Scene& scene) {
  return 2 * world_bounds(scene, world_matrices(scene)).radius();
}

float clearance(const Scene& scene, const std::string& camera, const std::vector<Triangle>& triangles) {
  const vec3 eye(camera_pose(scene, camera).world[3]);
  float nearest = std::numeric_limits<float>::infinity();
  for (const Triangle& t : triangles) nearest = std::min(nearest, distance(eye, t));
  return nearest;
}

TEST(BuiltinNumber, WithoutOneIsTheUsual) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (!scene.number) continue;
    EXPECT_EQ(scene_hash(scene.make()), scene_hash(scene.number->make(scene.number->usual))) << scene.name;
  }
}

TEST(BuiltinNumber, ATownHasSoManyOfTheHouseEachWithTheSameShape) {
  const Scene house = make_builtin("house");
  for (const int houses : {1, 2, 5, 16}) {
    const Scene town = make_builtin(numbered("town?houses", houses));
    const auto many = static_cast<std::size_t>(houses);
    EXPECT_EQ(count(town, "roof"), many);
    EXPECT_EQ(town.instances.size(), many * (house.instances.size() - 1) + 1);
    EXPECT_EQ(town.materials.size(), house.materials.size());
    std::set<std::pair<int, int>> places;
    const std::vector<mat4> world = world_matrices(town);
    for (const Instance& instance : town.instances) {
      if (town.nodes[instance.node].name != "roof") continue;
      Bounds bounds;
      for (const vec3& p : town.meshes[instance.mesh].positions)
        bounds.add(vec3(world[instance.node] * vec4(p, 1)));
      const vec3 middle = bounds.center(), size = bounds.max - bounds.min;
      places.insert({static_cast<int>(std::lround(middle.x)), static_cast<int>(std::lround(middle.z))});
      EXPECT_NEAR(std::max(size.x, size.z), 12.8f, 1e-3f);
      EXPECT_NEAR(std::min(size.x, size.z), 8.8f, 1e-3f);
      EXPECT_LT(std::abs(middle.x), extent(town));
    }
    EXPECT_EQ(places.size(), many) << "houses stand in each other";
    const std::vector<Triangle> triangles = world_triangles(town);
    for (const Camera& camera : town.cameras) EXPECT_GT(clearance(town, camera.name, triangles), 0.1f);
  }
}

TEST(BuiltinNumber, RandomScenesAreSoundLitAndOfAnySize) {
  float smallest = std::numeric_limits<float>::infinity(), largest = 0;
  std::set<std::string> hashes;
  std::size_t lamps = 0, skies = 0, textures = 0, doors = 0, stairs = 0, panes = 0, bodies = 0;
  constexpr int seeds = 150;
  for (int seed = 0; seed < seeds; ++seed) {
    const std::string name = numbered("random?seed", seed);
    Scene scene = make_builtin(name);
    EXPECT_TRUE(validate(scene).empty()) << name;
    EXPECT_FALSE(scene.cameras.empty()) << name;
    const bool emits = std::ranges::any_of(scene.materials, &Material::emissive);
    EXPECT_TRUE(emits || !scene.lights.empty() || scene.environment) << name;
    const std::vector<Triangle> triangles = world_triangles(scene);
    const float size = extent(scene);
    for (const Camera& camera : scene.cameras)
      EXPECT_GT(clearance(scene, camera.name, triangles), 0) << name << " " << camera.name;
    EXPECT_GT(size, 0.99e-3f) << name;
    EXPECT_LT(size, 1.01e4f) << name;
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
    hashes.insert(scene_hash(scene).hex());
    lamps += !scene.lights.empty();
    skies += scene.environment.has_value();
    textures += !scene.textures.empty();
    doors += count(scene, "door") > 0;
    stairs += count(scene, "stair") > 0;
    panes += count(scene, "pane") > 0;
    bodies += std::ranges::any_of(scene.materials,
                                  [](const Material& m) { return m.is_glass() && m.thickness > 0; });
  }
  EXPECT_EQ(hashes.size(), seeds);
  EXPECT_LT(smallest, 0.01f);
  EXPECT_GT(largest, 2000.0f);
  for (const std::size_t kind : {lamps, skies, textures, doors, stairs, panes, bodies}) {
    EXPECT_GT(kind, 3u);
    EXPECT_LT(kind, seeds);
  }
  EXPECT_EQ(scene_hash(make_builtin("random?seed=77")), scene_hash(make_builtin("random?seed=77")));
}

TEST(BuiltinNumber, SaysWhatIsWrongWithANumber) {
  const auto message = [](const std::string& name) { return message_of([&] { make_builtin(name); }); };
  const std::string houses = " is not understood (write builtin:town?houses=N with N from 1 to 4096)";
  for (const char* setting : {"houses=0", "houses=4097", "houses=", "houses", "", "house=3", "houses=3x",
                              "houses=-1", "houses=99999999999", "houses=1=2"})
    EXPECT_EQ(message(std::string("town?") + setting), std::string("builtin:town?") + setting + ":" + houses);
  EXPECT_EQ(message("cornell?seed=1"),
            "builtin:cornell?seed=1: this scene takes no number (write builtin:cornell)");
}

}  // namespace
}  // namespace ssphh::scene
