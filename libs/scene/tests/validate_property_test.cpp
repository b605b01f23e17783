/// What validate() lets pass, and what of a scene its hashes see: every number of random scenes.

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

#include "not_finite.h"
#include "property.h"
#include "random_scene.h"

namespace ssphh::scene {
namespace {

using namespace ssphh::test;
using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

using test::infinity;

TEST(ValidateProperty, ARandomSceneNeedsNoRepair) {
  EXPECT_TRUE(for_all(seeds()).cases(20).holds([](std::uint64_t seed) -> AssertionResult {
    Scene scene = random_scene(seed);
    const std::vector<std::string> repairs = validate(scene);
    // Its one animated node has no matrix.
    if (repairs.empty()) return AssertionSuccess();
    return AssertionFailure() << repairs.front();
  }));
}

TEST(ValidateProperty, WhateverANumberIsTheSceneIsRefusedOrFiniteAndThenFlawless) {
  const auto bad = one_of<float>({std::nanf(""), infinity, -infinity, std::numeric_limits<float>::max(),
                                  -std::numeric_limits<float>::max(), 1e30f, -1e30f, 1e-40f, 0, -1});
  EXPECT_TRUE(for_all(seeds(), bad, integers(0, 1))
                  .cases(40)
                  .holds([](std::uint64_t seed, float value, int animated) -> AssertionResult {
                    Scene good = random_scene(seed);
                    // Perhaps the node with a matrix is the one that moves, which decomposes it.
                    if (animated) {
                      for (AnimationChannel& c : good.animations[0].channels) c.node = 1;
                    }
                    // A different fifth of the numbers in each case.
                    for (std::size_t i = seed % 5, count = floats_of(good).size(); i < count; i += 5) {
                      Scene scene = good;
                      const NamedFloat changed = floats_of(scene)[i];
                      *changed.value = value;
                      try {
                        validate(scene);
                      } catch (const Error&) {
                        continue;
                      }
                      for (const NamedFloat& number : floats_of(scene)) {
                        if (!std::isfinite(*number.value))
                          return AssertionFailure()
                                 << changed.name << " leaves " << number.name << " at " << *number.value;
                      }
                      const std::vector<std::string> again = validate(scene);
                      if (!again.empty())
                        return AssertionFailure() << changed.name << ", a second time: " << again.front();
                    }
                    return AssertionSuccess();
                  }));
}

TEST(ValidateProperty, AMatrixWhoseScaleIsNoFloatIsRefusedWhereItMustBeTakenApart) {
  Scene scene = random_scene(3);
  for (AnimationChannel& c : scene.animations[0].channels) c.node = 1;
  (*scene.nodes[1].matrix)[2] = vec4(3e38f, 3e38f, 0, 0);
  try {
    validate(scene);
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.where(), "node 1 \"body 1\"");
  }
}

/// Whether the number is one that its object does not use.
bool unused(const std::string& name) {
  const auto is = [&](const char* text) { return name == text; };
  // A camera has one of two sizes, a light the parameters of its type; of a body's thickness counts that it
  // is none.
  return name.ends_with(" thickness") || is("camera 0 yheight") || is("camera 1 yfov") ||
         is("light 0 radius") || is("light 0 angular_radius") || is("light 0 inner_cone") ||
         is("light 0 outer_cone") || is("light 1 radius") || is("light 1 angular_radius") ||
         is("light 2 radius") || is("light 2 inner_cone") || is("light 2 outer_cone") ||
         is("light 2 range") || is("light 3 angular_radius") || is("light 3 inner_cone") ||
         is("light 3 outer_cone") || is("light 4 angular_radius") || is("light 4 inner_cone") ||
         is("light 4 outer_cone") || is("light 5 radius") || is("light 5 angular_radius") ||
         is("light 5 inner_cone") || is("light 5 outer_cone") || is("light 6 angular_radius") ||
         is("light 6 inner_cone") || is("light 6 outer_cone") ||
         (name.find(" size[") != std::string::npos && !name.starts_with("light 5"));
}

TEST(SceneHashProperty, SeesEveryNumberThatCanChangeAPicture) {
  EXPECT_TRUE(for_all(seeds()).cases(20).holds([](std::uint64_t seed) -> AssertionResult {
    Scene scene = random_scene(seed);
    // Every mesh and material is in use.
    scene.instances[0].mesh = 0, scene.instances[1].mesh = scene.instances[2].mesh = 1;
    scene.instances[0].material = 0, scene.instances[1].material = scene.instances[2].material = 1;
    const Hash128 before = scene_hash(scene), light_before = light_hash(scene);
    const std::vector<NamedFloat> all = floats_of(scene);
    // A different quarter of the numbers in each case.
    for (std::size_t i = seed % 4; i < all.size(); i += 4) {
      const auto& [name, value] = all[i];
      const float kept = *value;
      *value = kept * 1.25f + 0.0625f;
      const bool seen = scene_hash(scene) != before, light_seen = light_hash(scene) != light_before;
      *value = kept;
      if (seen == unused(name)) return AssertionFailure() << name << (seen ? " counts" : " is lost");
      const bool viewer = name.starts_with("camera") || name.starts_with("SPHL");
      // Where cameras and SPHLs stand is a node, and may carry lights.
      if (name.starts_with("node")) continue;
      if (light_seen == (viewer || unused(name)))
        return AssertionFailure() << name << (light_seen ? " counts" : " is lost") << " for light";
    }
    return AssertionSuccess();
  }));
}

}  // namespace
}  // namespace ssphh::scene
