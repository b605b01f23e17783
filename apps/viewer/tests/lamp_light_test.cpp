// Lamps that come and go light the picture, its shadows, its probes and the path-traced preview.

#include <gmock/gmock.h>

#include <ssphh/scene/area_lamp.h>

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class LampLight : public GlStage {
 protected:
  void prepare() override {
    options_.records = 128;
    options_.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 16};
    options_.settings = {{"exposure", "0"}, {"tonemap", "clip"}, {"antialias", "off"}};
  }
  void ready() override { window_->tick = 1.0 / 1024; }

  void play(const std::string& text) {
    GlStage::play(text);
    EXPECT_FALSE(app().message_is_error) << app().message;
  }
  double brightness() {
    const std::vector<std::uint8_t> rgba = app().picture.pixels().rgba;
    double sum = 0;
    for (std::size_t i = 0; i < rgba.size(); ++i) sum += i % 4 == 3 ? 0 : rgba[i];
    return sum / static_cast<double>(rgba.size());
  }
  /// Light of the probe in the middle of room B, which is dark behind its door.
  float probe() { return app().light.set().probes[4].self[0].x; }
};

TEST_F(LampLight, OfAddedOnesIsThatOfPathTracing) {
  app().open("builtin:two-rooms");
  app().light_scene_probes();
  play("camera room-b");
  const double dark = brightness();
  EXPECT_LT(dark, 1);
  EXPECT_NEAR(probe(), 0, 1e-4f);
  const auto opened = app().document.scene;

  play(
      "add-light spot desk 2 2.3 0.5\nlight desk aim 2.5 0 0.5\nlight desk outer-cone 50\n"
      "light desk intensity 3\nlight desk color 1 0.8 0.6");
  EXPECT_GT(brightness(), dark + 5);
  EXPECT_GT(probe(), 0.01f) << "relit";
  EXPECT_EQ(app().light.origin(), "live");
  // Path tracing has the lamp, too, with its cone and its shadows.
  play("set truth-spp 16\nset show absolute");
  const metrics::ImageError error = app().picture.shown_difference()->error;
  for (const double ratio : error.mean_ratio) EXPECT_NEAR(ratio, 1, 0.12);
  play("set show realtime");

  const double wide = brightness();
  play("light desk outer-cone 15");
  EXPECT_LT(brightness(), 0.7 * wide) << "another cone at once";
  play("undo");
  EXPECT_NEAR(brightness(), wide, 1);
  const float one = probe();
  play("light desk duplicate");
  EXPECT_GT(probe(), 1.6f * one);
  play("light \"desk 1\" delete\nlight desk delete");
  EXPECT_LT(brightness(), 1);
  EXPECT_NEAR(probe(), 0, 1e-4f);
  EXPECT_EQ(app().document.scene->lights.size(), 1u);
  play("undo\nundo\nundo\nundo\nundo\nundo\nundo\nundo");
  EXPECT_EQ(app().document.scene, opened);
}

TEST_F(LampLight, EveryKindIsDrawnAsItIsTraced) {
  app().open("builtin:two-rooms");
  play("light lamp off\ncamera room-b\nset truth-spp 12\nset truth-depth 1");
  for (const scene::LightType type :
       {scene::LightType::point, scene::LightType::spot, scene::LightType::sphere, scene::LightType::sphl,
        scene::LightType::rectangle, scene::LightType::disc}) {
    const std::string name(name_of(type));
    // Flat ones above the view: of a bright sliver at a pixel's edge one picture has all, the other a share.
    const double height = scene::is_area_lamp(type) ? 2.8 : 1.8;
    play(fmt::format("set show realtime\nadd-light {0} {0} 2.5 {1} 0.3", name, height));
    EXPECT_GT(brightness(), 2) << name;
    play("set show absolute");
    const metrics::ImageError error = app().picture.shown_difference()->error;
    EXPECT_NEAR(error.mean_ratio[1], 1, 0.08) << name;
    play(fmt::format("set show realtime\nlight {} delete", name));
    EXPECT_LT(brightness(), 0.1) << name;
  }
}

TEST_F(LampLight, ALampThatComesWhileTheLightIsBuiltIsInIt) {
  app().open("builtin:two-rooms");
  app().light_scene_probes();
  play("add-light point key 2 1 0.5");
  ASSERT_TRUE(app().light.live());
  EXPECT_EQ(app().light.live_light()->scene().lights.size(), 2u);
  EXPECT_GT(probe(), 0.01f);
  play("undo");
  EXPECT_NEAR(probe(), 0, 1e-4f) << "the scene that was opened is another one again";
}

/// While a button is held counts may change by keys; shapes wait until it is let go.
TEST_F(LampLight, InputGoesOnWhileTheLightIsBuiltAnew) {
  app().open("builtin:two-rooms");
  app().light_scene_probes();
  play("camera room-b\nadd-light spot desk 2 2.3 0.5");
  app().document.edit("cone", [](Edits& e) { set_lamp_number(e.lights[1], "outer cone", 20); });
  InjectedInput held;
  held.mouse = {32, 40}, held.buttons = {true, false, false};
  turn(held);
  window_->clock += 1;
  turn(held);
  EXPECT_FALSE(app().job.running()) << "not while a button is held";
  app().add_lamp(new_lamp(scene::LightType::point, "key", {2, 1, 0.5f}, 1, 0));
  turn(held);
  EXPECT_FALSE(app().message_is_error) << app().message;
  held.buttons = {};
  turn(held);
  for (int i = 0; i < 100 && !app().job.running(); ++i) window_->clock += 0.05, turn(held);
  EXPECT_TRUE(app().job.running());
  EXPECT_EQ(app().job.status().name, "lighting probes") << "and the window says so";
  app().view.eye.x += 0.1f;
  turn();
  EXPECT_FALSE(app().light.empty()) << "the light of before is shown meanwhile";
  play("settle");
  EXPECT_EQ(app().light.live_light()->scene().lights.size(), 3u);
}

}  // namespace
}  // namespace ssphh::viewer
