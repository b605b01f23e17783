#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

Scene lamp_under_sky() {
  Scene scene;
  scene.lights.emplace_back().name = "lamp";
  scene.environment.emplace().group = "sky";
  return scene;
}

TEST(LightModes, AreRealtimeUnlessAskedFor) {
  Scene scene = lamp_under_sky();
  using enum LightMode;
  EXPECT_EQ(light_modes(scene), (std::vector<LightMode>{realtime, realtime}));
  EXPECT_FALSE(asked_light_mode(scene, "sky").has_value());
  set_light_mode(scene, "sky", baked);
  set_light_mode(scene, "lamp", mixed);
  EXPECT_EQ(light_modes(scene), (std::vector<LightMode>{mixed, baked}));
  set_light_mode(scene, "sky", realtime);
  EXPECT_EQ(asked_light_mode(scene, "sky"), realtime) << "asking for the default says more than nothing";
  EXPECT_EQ(scene.light_modes.size(), 2u) << "the last word of each group counts";
}

TEST(LightModes, OfGroupsThatThereAreNotAreRefusedWithThoseThatThereAre) {
  Scene scene = lamp_under_sky();
  try {
    set_light_mode(scene, "sun", LightMode::baked);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "light mode of \"sun\": the scene has no light group of that name (its groups: lamp, sky)");
  }
  EXPECT_TRUE(scene.light_modes.empty());
}

TEST(LightModes, OfReplacedLightsAreForgotten) {
  Scene scene = lamp_under_sky();
  set_light_mode(scene, "sky", LightMode::baked);
  set_light_mode(scene, "lamp", LightMode::mixed);
  EXPECT_TRUE(drop_unused_light_modes(scene).empty());
  scene.environment.reset();
  EXPECT_EQ(drop_unused_light_modes(scene), std::vector<std::string>{"sky"});
  EXPECT_EQ(scene.light_modes, (std::vector<GroupMode>{{"lamp", LightMode::mixed}}));
}

TEST(LightModes, DoNotTellScenesApart) {
  // Probes of a scene fit it whatever it asks for; their own modes say what they hold.
  const Scene plain = lamp_under_sky();
  Scene asking = plain;
  set_light_mode(asking, "sky", LightMode::baked);
  EXPECT_EQ(light_hash(asking), light_hash(plain));
  EXPECT_EQ(scene_hash(asking), scene_hash(plain));
}

}  // namespace
}  // namespace ssphh::scene
