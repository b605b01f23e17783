#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/studio.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

Scene lamp_under_sky() {
  Scene scene;
  scene.lights.emplace_back().name = "lamp";
  scene.environment.emplace().group = "sky";
  return scene;
}

TEST(LightModes, AreTheUsualOnesUnlessAskedFor) {
  Scene scene = lamp_under_sky();
  using enum LightMode;
  EXPECT_EQ(light_modes(scene), (std::vector<LightMode>{realtime, diffuse}));
  EXPECT_FALSE(asked_light_mode(scene, "sky").has_value());
  set_light_mode(scene, "sky", baked);
  set_light_mode(scene, "lamp", mixed);
  EXPECT_EQ(light_modes(scene), (std::vector<LightMode>{mixed, baked}));
  set_light_mode(scene, "sky", realtime);
  EXPECT_EQ(asked_light_mode(scene, "sky"), realtime) << "asking for the default says more than nothing";
  EXPECT_EQ(scene.light_modes.size(), 2u) << "the last word of each group counts";
}

TEST(LightModes, OfASkyWithLampsInItsGroupAreRealtime) {
  using enum LightMode;
  Scene scene = lamp_under_sky();
  scene.lights[0].group = "sky";
  EXPECT_EQ(light_modes(scene), std::vector<LightMode>{realtime});
  scene = lamp_under_sky();
  scene.materials.emplace_back().emission = vec3(1);
  scene.meshes.push_back(make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  Instance& panel = scene.instances.emplace_back();
  panel.mesh = panel.material = 0;
  EXPECT_EQ(usual_light_mode(scene, "sky"), diffuse) << "the panel is of a group of its own";
  scene.environment->group = light_group(scene, panel);
  EXPECT_EQ(usual_light_mode(scene, scene.environment->group), realtime);
}

/// A sky of radiance 1 with a spot around the zenith of so many rows of a degree and so much more radiance.
Environment spotted(int rows, float more) {
  Environment sky;
  sky.equirect = image::Image(360, 180);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 360; ++x) sky.equirect.set_rgb(x, y, vec3(y < rows ? 1 + more : 1));
  }
  return sky;
}

TEST(LightModes, TellASharpSunByItsShareOfTheLight) {
  EXPECT_FALSE(casts_sharp_shadows({})) << "an even sky";
  EXPECT_FALSE(casts_sharp_shadows(spotted(0, 0)));
  // A cap of 2° is 2π (1 − cos 2°) = 0.003828 sr: a share s of all light needs (1 + m) 0.003828 = s (4π + m
  // 0.003828); the rest of 0.02 sr has 0.001287 (1 − s') of it.
  const double cap = 2 * pi_d * (1 - std::cos(2 * pi_d / 180)), sphere = 4 * pi_d;
  const auto more = [&](double share) {
    // ((1 + m) cap + (0.02 − cap)) = share · (sphere + m cap)
    return static_cast<float>((share * sphere - 0.02) / (cap * (1 - share)));
  };
  EXPECT_FALSE(casts_sharp_shadows(spotted(2, more(0.095))));
  EXPECT_TRUE(casts_sharp_shadows(spotted(2, more(0.105))));
  // As much light from a cap of 20° makes soft shadows
  EXPECT_FALSE(casts_sharp_shadows(spotted(20, more(0.3) / 100)));
}

TEST(LightModes, OfTheAnalyticSkyAndTheStudioAreDiffuse) {
  for (const float elevation : {0.05f, 0.3f, 0.8f, 1.5f}) {
    for (const float turbidity : {2.0f, 3.0f, 6.0f, 10.0f}) {
      Scene scene;
      add_sun_sky(scene, {.elevation = elevation, .turbidity = turbidity});
      EXPECT_EQ(usual_light_mode(scene, "sky"), LightMode::diffuse) << elevation << " " << turbidity;
      EXPECT_EQ(usual_light_mode(scene, "sun"), LightMode::realtime);
    }
  }
  Scene scene;
  add_studio(scene);
  EXPECT_FALSE(casts_sharp_shadows(*scene.environment));
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
