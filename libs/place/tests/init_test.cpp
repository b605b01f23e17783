#include <gmock/gmock.h>

#include <ssphh/place/init.h>

#include "error_message.h"

namespace ssphh::place {
namespace {

using testing::HasSubstr;

TEST(Init, TakesTheEnabledSphlsOfASceneInOrder) {
  scene::Scene scene;
  scene.name = "room";
  for (int i = 0; i < 3; ++i) {
    scene::Node node;
    node.local.translation = vec3(static_cast<float>(i), 1, 2);
    scene.nodes.push_back(node);
    scene.sphls.push_back({"SPHL" + std::to_string(i), i, 0.2f, i != 1});
  }
  const probes::ProbeSet set = init_from_scene(scene, 5);
  ASSERT_EQ(set.probes.size(), 2u);
  EXPECT_EQ(set.probes[1].name, "SPHL2");
  EXPECT_EQ(set.probes[1].position, vec3(2, 1, 2));
  EXPECT_EQ(set.probes[1].radius, 0.2f);
  EXPECT_EQ(set.degree, 5);
  EXPECT_EQ(set.generator.scene, "room");
  EXPECT_EQ(set.generator.time, 0);
  EXPECT_EQ(set.generator.scene_hash, scene::light_hash(scene));
}

TEST(Init, ASceneWithoutSphlsSaysHowToAddSome) {
  try {
    init_from_scene(scene::Scene(), 9);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("extras"));
  }
  EXPECT_THROW(init_from_scene(scene::Scene(), 11), Error);
  EXPECT_THROW(init_from_scene(scene::Scene(), -1), Error);
}

TEST(Init, TakesAsManySphlsAsASetMayHave) {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.sphls.assign(65536, {"SPHL", 0, 0.2f, true});
  EXPECT_EQ(init_from_scene(scene, 0).probes.size(), 65536u);
  scene.sphls.push_back(scene.sphls[0]);
  EXPECT_EQ(test::message_of([&] { init_from_scene(scene, 0); }),
            "scene without a name: has 65537 SPHLs; at most 65536 are supported");
}

}  // namespace
}  // namespace ssphh::place
