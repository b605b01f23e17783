// Modes of a file's light groups, while the scene is another one than it was baked in.

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class LightModes : public GlStage {
 protected:
  void prepare() override { options_.probes = "off", options_.settings = {{"antialias", "off"}}; }
  void ready() override { app().open("builtin:two-rooms"); }
  scene::LightMode mode_at(float time) {
    app().document.time = time;
    play("settle");
    return app().light.set().light_groups[0].mode;
  }
};

TEST_F(LightModes, ADiffuseGroupIsDrawnInRealTimeUntilThePoseIsAsBakedAgain) {
  probes::ProbeSet set;
  set.degree = 0;
  set.generator.time = 0.25f;
  set.light_groups = {{"lamp", vec3(1), scene::LightMode::diffuse}};
  for (const scene::ProbePlace& place : scene::sphl_places(*app().document.scene, 0)) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position = place.position;
    probe.groups.push_back({sh::RadianceSh(0), sh::RadianceSh(0)});
  }
  app().light.take(std::move(set), "file.sphl");
  EXPECT_EQ(mode_at(0), scene::LightMode::realtime);
  EXPECT_EQ(mode_at(0.25f), scene::LightMode::diffuse);
  EXPECT_EQ(mode_at(1), scene::LightMode::realtime);
}

}  // namespace
}  // namespace ssphh::viewer
