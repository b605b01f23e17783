// Sliders of light that takes long to follow, on a software renderer whose pictures do.

#include <gmock/gmock.h>

#include "drawn.h"
#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class HeldSlider : public GlStage {
 protected:
  void prepare() override {
    size_ = {900, 500};
    options_.panels = true;
    options_.records = 0;
    options_.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 8};
    options_.settings = {{"exposure", "0"}, {"antialias", "off"}};
  }
  void ready() override {
    load_ = [](const std::string&) {
      scene::Scene scene = scene::make_builtin("cornell");  // open before the camera
      image::Image half_bright(8, 4, 3);
      for (std::size_t i = 0; i < half_bright.pixels.size(); ++i) half_bright.pixels[i] = i % 24 < 12 ? 3 : 0;
      scene.environment.emplace().equirect = std::move(half_bright);
      return scene;
    };
    app().open_lit("rooms");
    settle();
  }
  void settle() {
    EXPECT_TRUE(turn_until([&] { return app().settled() && !app().light.empty(); }, [&] { turn(); }));
  }
  DrawnThing text(const std::string& wanted) const {
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) {
      for (const DrawnThing& thing : drawn_things(*data.CmdLists[i]))
        if (thing.text == wanted) return thing;
    }
    ADD_FAILURE() << "there is no " << wanted;
    return {};
  }
  void mouse_at(float x, float y, bool held) {
    app().last_stats.cpu_ms = 100;
    InjectedInput input;
    input.mouse = {x, y}, input.buttons = {held};
    turn(input);
  }
};

TEST_F(HeldSlider, LightThatTakesLongFollowsPieceByPiece) {
  app().open_tab = "Light";
  for (int i = 0; i < 3; ++i) turn();
  const DrawnThing label = text("environment turned");
  float x = label.from.x + 220;
  const float y = 0.5f * (label.from.y + label.to.y);
  const int whole = app().picture.width();
  for (const double budget : {0.0, transport::unlimited_ms}) {
    app().light.budget_ms = budget;
    const probes::ProbeSet before = app().light.set();
    const float turned = app().document.edits().environment_rotation;
    mouse_at(x, y, false);
    for (int i = 0; i < 4; ++i) mouse_at(x += 10, y, true);
    EXPECT_NE(app().document.edits().environment_rotation, turned);
    EXPECT_EQ(app().light.set() == before, budget == 0) << "follows at once where it can";
    EXPECT_EQ(app().light.under_way(), budget == 0);
    EXPECT_LT(app().picture.width(), whole / 2) << "a small picture while it is held";
    const auto followed = [&] { return app().light.set() != before; };
    EXPECT_TRUE(turn_until(followed, [&] { mouse_at(x, y, true); })) << "also while it is held";
    mouse_at(x += 10, y, true);
    mouse_at(x, y, false);
    settle();
    EXPECT_FALSE(app().light.under_way()) << "nothing rests before it is there";
    EXPECT_EQ(app().picture.width(), whole);
    const LiveLight& live = *app().light.live_light();
    EXPECT_EQ(live.session().shown(), app().document.lighting());
    EXPECT_EQ(app().light.set().probes[0].reflected, live.session().reflected()[0]);
  }
}

}  // namespace
}  // namespace ssphh::viewer
