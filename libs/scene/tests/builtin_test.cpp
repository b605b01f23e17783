#include <algorithm>
#include <ostream>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>

#include "geometry.h"

namespace ssphh::scene {

void PrintTo(const BuiltinScene& scene, std::ostream* out) {
  *out << scene.name;
}

namespace {

class Builtin : public ::testing::TestWithParam<BuiltinScene> {
 protected:
  const Scene scene_ = GetParam().make();
};

INSTANTIATE_TEST_SUITE_P(Scenes, Builtin, ::testing::ValuesIn(builtin_scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  std::erase(name, '-');
  return name;
});

TEST_P(Builtin, NeedsNoRepairAndBearsItsName) {
  Scene copy = scene_;
  EXPECT_TRUE(validate(copy).empty());
  EXPECT_EQ(scene_.name, GetParam().name);
  EXPECT_FALSE(GetParam().description.empty());
}

TEST_P(Builtin, HasFourToSixSphlsWithNamesOfTheirOwnOrLeavesThemToPlacement) {
  if (scene_.sphls.empty()) return;
  EXPECT_GE(scene_.sphls.size(), 4u);
  EXPECT_LE(scene_.sphls.size(), 6u);
  std::set<std::string> names;
  for (const Sphl& sphl : scene_.sphls) names.insert(sphl.name);
  EXPECT_EQ(names.size(), scene_.sphls.size());
}

TEST_P(Builtin, SphlSpheresTouchNoSurface) {
  for (const float time : {0.0f, 0.5f, 1.0f}) {
    const std::vector<Triangle> triangles = world_triangles(scene_, time);
    for (const ProbePlace& place : sphl_places(scene_, time)) {
      float nearest = std::numeric_limits<float>::infinity();
      for (const Triangle& t : triangles) nearest = std::min(nearest, distance(place.position, t));
      EXPECT_GT(nearest, std::max(0.05f, place.radius)) << place.name << " at time " << time;
    }
  }
}

TEST_P(Builtin, CamerasStandClearOfSurfaces) {
  const std::vector<Triangle> triangles = world_triangles(scene_);
  ASSERT_FALSE(scene_.cameras.empty());
  for (const Camera& camera : scene_.cameras) {
    const vec3 eye(camera_pose(scene_, camera.name).world[3]);
    float nearest = std::numeric_limits<float>::infinity();
    for (const Triangle& t : triangles) nearest = std::min(nearest, distance(eye, t));
    EXPECT_GT(nearest, 0.1f) << camera.name;
  }
}

TEST_P(Builtin, IsMadeTheSameEveryTime) {
  EXPECT_EQ(scene_hash(scene_), scene_hash(GetParam().make()));
}

TEST(BuiltinTable, UnknownNameIsAnErrorThatListsTheKnownOnes) {
  try {
    make_builtin("galery1");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(e.hint().find("gallery1"), std::string::npos);
  }
}

}  // namespace
}  // namespace ssphh::scene
