// What clicks and drags in the window's panels change.

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using Panels = PanelStage;

TEST_F(Panels, SlidersReachFromEndToEndOfTheirRange) {
  Settings& s = app().settings;
  take_probes();
  open("Picture");
  expect_ends(
      "exposure", [&] { return s.exposure; }, -12, 8);
  EXPECT_FALSE(s.auto_exposure) << "the slider turns it off";
  expect_ends(
      "pixels", [&] { return s.scale; }, 0.25f, 2);
  expect_ends(
      "probe light at", [&] { return s.indirect_scale; }, 1, 8);
  expect_ends(
      "bounces", [&] { return s.truth_depth; }, 1, 32);
  expect_ends(
      "samples", [&] { return s.truth_passes; }, 1, 4096);
  s.show = Show::wipe;
  expect_ends(
      "line", [&] { return s.wipe; }, 0, 1);
  s.show = Show::pixelated;
  expect_ends(
      "block [pixels]", [&] { return s.block; }, 1, 64);
  open("Probes");
  expect_ends(
      "bands", [&] { return s.degree; }, 0, 4);
  expect_ends(
      "threshold P", [&] { return s.hier_params.threshold; }, 0, 0.1f);
  expect_ends(
      "radius [m]", [&] { return s.ball_size; }, 0, 0.5f);
  expect_ends(
      "samples", [&] { return app().bake_params.path.spp; }, 1, 256);
  expect_ends(
      "bounces", [&] { return app().bake_params.path.max_depth; }, 1, 32);
  expect_ends(
      "cube face", [&] { return app().bake_params.face_size; }, 8, 128);
  open("Light");
  expect_ends(
      "sphere", [&] { return app().document.edits().groups.at("sphere").y; }, 0, 4, 1);
  open("Camera");
  expect_ends(
      "field of view", [&] { return glm::degrees(app().view.yfov); }, 10, 120);
  app().selection = {Kind::material, 2};
  open("Surfaces");
  const auto material = [&] { return app().document.edits().materials[2]; };
  expect_ends(
      "metallic", [&] { return material().metallic; }, 0, 1);
  expect_ends(
      "specular", [&] { return material().specular; }, 0, 1);
  expect_ends(
      "specular rough.", [&] { return material().specular_roughness; }, -1, 1);
  expect_ends(
      "diffuse rough.", [&] { return material().diffuse_roughness; }, -1, 1);
  rest();
  const DrawnThing button = text("Play");
  drag(500, button.from.y + 6, 990, button.from.y + 6);
  EXPECT_EQ(app().document.time, app().document.duration);
  app().settings.play = true;
  drag(500, button.from.y + 6, 380, button.from.y + 6);
  EXPECT_EQ(app().document.time, 0);
  EXPECT_FALSE(app().settings.play) << "who moves the time stops the animation";
}

/// A field of a number changes by `speed` a pixel, and stops at its limits.
TEST_F(Panels, FieldsFollowTheMouseAtTheirSpeed) {
  const auto expect_pulled = [&](const char* label, const auto& value, float speed, float low, float high) {
    const auto before = static_cast<float>(value());
    pull(label, 100);
    EXPECT_NEAR(static_cast<float>(value()), before + 100 * speed, 0.005f)
        << label << ": shown with two digits";
    if (low == high) return;
    pull(label, -2e5f);
    EXPECT_FLOAT_EQ(static_cast<float>(value()), low) << label;
    pull(label, 1e9f);
    EXPECT_FLOAT_EQ(static_cast<float>(value()), high) << label;
  };
  const auto edits = [&]() -> const Edits& { return app().document.edits(); };
  app().selection = {Kind::light, 0};
  open("Light");
  expect_pulled(
      "intensity", [&] { return edits().lights[0].intensity; }, 0.08f, 0, 1e6f);
  EXPECT_EQ(app().document.history.undo_name(), "intensity of lamp");
  expect_pulled(
      "position",
      [&] {
        return light_position(edits().lights[0].world.value_or(
                                  edited_lighting(*app().document.scene, edits(), 0).lights[0].world))
            .x;
      },
      0.01f, 0, 0);
  EXPECT_EQ(app().document.history.undo_name(), "move lamp");
  app().selection = {Kind::light, 1};
  rest();
  pull("direction", 100);
  EXPECT_NEAR(light_direction(*edits().lights[1].world).x, std::sqrt(0.5f), 1e-5f) << "(1, 0, −1)";
  pull("direction", 1000);
  EXPECT_EQ(app().document.history.undo_name(), "turn spot");
  EXPECT_NEAR(light_direction(*edits().lights[1].world).x, 1 / std::hypot(1.0f, std::sqrt(0.5f)), 0.01f);
  app().selection = {Kind::sphl, 3};
  open("Probes");
  expect_pulled(
      "position", [&] { return app().selected_position()->x; }, 0.01f, 0, 0);
  expect_pulled(
      "VIZ radius", [&] { return edits().sphls[3].radius; }, 0.005f, 0.001f, 10);
  EXPECT_EQ(app().document.history.undo_name(), "radius of B west");
  app().selection = {Kind::material, 2};
  open("Surfaces");
  expect_pulled(
      "emission", [&] { return edits().materials[2].emission.x; }, 0.06f, 0, 1e6f);
  app().edit("red", [](Edits& e) { e.materials[2].emission = vec3(0.5f, 0, 0); });
  const std::vector<std::string> groups = scene::light_groups(app().document.edited());
  pull("emission", -9999);
  EXPECT_EQ(scene::light_groups(app().document.edited()), groups) << "it can be turned on again";
  EXPECT_LT(max_component(edits().materials[2].emission), 1e-5f);
  pull("emission", 100);
  EXPECT_GT(edits().materials[2].emission.x, 0.1f);
  open("Camera");
  expect_pulled(
      "eye", [&] { return app().view.eye.x; }, 0.02f, 0, 0);
  expect_pulled(
      "fly [m/s]", [&] { return app().fly_speed; }, 0.05f, 0.05f, 500);
  app().view.orthographic = true;
  rest();
  expect_pulled(
      "height [m]", [&] { return app().view.yheight; }, 0.02f, 0.01f, 1e4f);
  open("Probes");
  app().selection = {};
  pull("spacing [m]", 1e9f);
  rest();
  EXPECT_TRUE(shows("100.00"));
  pull("spacing [m]", -9999);
  rest();
  EXPECT_TRUE(shows("0.01") || shows("automatic"));
  pull("spacing [m]", -2e5f);
}

TEST_F(Panels, ADragIsOneStepOfUndo) {
  struct Case {
    const char *tab, *label;
    Selection selection;
  };
  for (const Case& c : {Case{"Light", "intensity", {Kind::light, 0}},
                        {"Light", "colour", {Kind::light, 0}},
                        {"Light", "position", {Kind::light, 0}},
                        {"Light", "direction", {Kind::light, 1}},
                        {"Light", "lamp", {}},
                        {"Surfaces", "base colour", {Kind::material, 2}},
                        {"Surfaces", "metallic", {Kind::material, 2}},
                        {"Surfaces", "emission", {Kind::material, 2}},
                        {"Probes", "position", {Kind::sphl, 1}},
                        {"Probes", "VIZ radius", {Kind::sphl, 1}}}) {
    app().document.history = History<Edits>(edits_of(*app().document.scene));
    app().selection = c.selection;
    open(c.tab);
    const bool twice = std::string(c.label) == "lamp";  // a lamp's name in the list, then its group's
    const auto pull_field = [&](float pixels) {
      if (!twice) return pull(c.label, pixels);
      const DrawnThing at = text("lamp", 1);
      drag(230, at.from.y + 6, 230 + pixels, at.from.y + 6);
      rest();
    };
    pull_field(-20), pull_field(30);
    EXPECT_TRUE(app().document.history.undo()) << c.label;
    EXPECT_TRUE(app().document.history.undo()) << c.label << ": the second drag is a step of its own";
    EXPECT_FALSE(app().document.history.undo()) << c.label;
  }
}

TEST_F(Panels, LampsAreChosenSwitchedAndPutBack) {
  open("Light");
  click_left_of("spot");
  EXPECT_FALSE(app().document.edits().lights[1].on);
  EXPECT_EQ(app().document.history.undo_name(), "switch spot");
  click_left_of("spot");
  EXPECT_TRUE(app().document.edits().lights[1].on);
  EXPECT_TRUE(app().document.history.undo() && !app().document.edits().lights[1].on) << "a step each";
  click_text("spot");
  EXPECT_EQ(app().selection, (Selection{Kind::light, 1}));
  EXPECT_FALSE(shows("back to its own place"));
  pull("position", 50);
  EXPECT_EQ(app().document.edits().lights[1].world.has_value(), true);
  click_text("back to its own place");
  EXPECT_FALSE(app().document.edits().lights[1].world);
  EXPECT_EQ(app().document.history.undo_name(), "put back spot");
  pull("colour", -51);
  EXPECT_LT(app().document.edits().lights[1].color.x, 1);
  EXPECT_EQ(app().document.edits().lights[1].color.y, 1);
  EXPECT_EQ(app().document.history.undo_name(), "colour spot");
}

TEST_F(Panels, ProbesAreChosenSwitchedAndDeleted) {
  take_probes();
  open("Probes");
  click_left_of("A east");
  EXPECT_FALSE(app().document.edits().sphls[1].enabled);
  EXPECT_EQ(app().document.history.undo_name(), "switch SPHL");
  click_left_of("A west");
  EXPECT_TRUE(app().document.history.undo() && app().document.edits().sphls[0].enabled) << "a step each";
  EXPECT_FALSE(app().document.edits().sphls[1].enabled);
  EXPECT_TRUE(app().document.history.undo());
  click_text("A east");
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 1}));
  EXPECT_TRUE(app().settings.balls) << "who chooses a probe sees it";
  click_text("Place one (N)");
  EXPECT_TRUE(app().place_mode);
  click_text("click a surface ?");
  EXPECT_FALSE(app().place_mode);
  click_text("Delete");
  EXPECT_EQ(app().document.edits().sphls.size(), 5u);
  EXPECT_EQ(app().document.edits().sphls[1].name, "doorway");
  EXPECT_EQ(app().selection, Selection{});
}

TEST_F(Panels, NeighboursOfAProbeStandByTheirStrength) {
  take_probes();
  app().selection = {Kind::sphl, 3};
  open("Probes");
  const std::vector<SphlEdit>& sphls = app().document.edits().sphls;
  const auto y = [&](std::size_t probe) {
    const float p = std::pow(0.2f, 4.0f) * static_cast<float>(probe + 1);
    for (const DrawnThing& thing : all_things())
      if (thing.text.starts_with(fmt::format("{:.5f}", p))) return thing.from.y;
    ADD_FAILURE() << "no neighbour " << probe;
    return 0.0f;
  };
  EXPECT_LT(y(2), y(1));
  EXPECT_LT(y(1), y(0));
  click(40, y(1) + 5);
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 1})) << sphls[1].name;
}

TEST_F(Panels, SettingsAreTickedChosenAndCounted) {
  take_probes();
  Settings& s = app().settings;
  open("Probes");
  click_widget("balls (P)"), click_widget("lobes (L)"), click_widget("graph (G)"), click_widget("names");
  click_widget("hierarchy");
  EXPECT_TRUE(s.balls && s.lobes && s.graph && s.names && s.hier);
  click_widget("hierarchy");
  EXPECT_FALSE(s.hier);
  click_widget("coloured by");
  click_text("neighbor");
  EXPECT_EQ(s.ball, Ball::neighbor);
  click_widget("lookup");
  click_text("light");
  EXPECT_EQ(s.lookup, probes::LookupMethod::light);
  EXPECT_EQ(s.hier_params.neighbors, -1);
  click_text("+");
  EXPECT_EQ(s.hier_params.neighbors, 0);
  click_text("+");
  EXPECT_EQ(s.hier_params.neighbors, 1);
  click_text("-");
  EXPECT_EQ(s.hier_params.neighbors, 0);
  click_text("-"), click_text("-");
  EXPECT_EQ(s.hier_params.neighbors, -1);
  EXPECT_TRUE(app().message_is_error) << "-2 is refused";
  EXPECT_THAT(app().message, testing::HasSubstr("not within"));
  app().settings.hier = true;
  rest();
  click_widget("operator");
  click_text("matrix");
  EXPECT_EQ(s.hier_params.op, probes::HierOperator::matrix);
  app().light.clear();
  rest();
  const bool before = s.hier;
  const DrawnThing at = text("hierarchy");
  click(150, at.from.y + 6);
  EXPECT_EQ(s.hier, before) << "nothing to choose without edges";
}

TEST_F(Panels, MaterialsAreChosenAndColoured) {
  open("Surfaces");
  click_text("material 1");
  EXPECT_EQ(app().selection, (Selection{Kind::material, 1}));
  const vec3 before = app().document.edits().materials[1].base_color;
  pull("base colour", -20);
  EXPECT_NEAR(app().document.edits().materials[1].base_color.x, before.x - 20 / 255.0f, 1e-3f);
  EXPECT_EQ(app().document.edits().materials[1].base_color.y, before.y);
  EXPECT_EQ(app().document.history.undo_name(), "material ");
}

TEST_F(Panels, BookmarksAreMadeSeenPlayedAndDeleted) {
  open("Camera");
  app().document.time = 0.25f;
  const View first = app().view;
  click_text("Add this view (B)");
  app().view = moved(app().view, {1, 0, 0});
  app().document.time = 0.75f;
  click_text("Add this view (B)");
  ASSERT_EQ(app().bookmarks.keys.size(), 2u);
  EXPECT_EQ(app().bookmarks.keys[0], (CameraKey{"view 1", 0, 0.25f, first}));
  EXPECT_EQ(app().bookmarks.keys[1].name, "view 2");
  EXPECT_EQ(app().bookmarks.keys[1].time, 2);
  app().path_time = 2;
  click_text("Play", 0);
  EXPECT_TRUE(app().path_plays);
  EXPECT_EQ(app().path_time, 0) << "at its end it begins anew";
  click_text("Stop", 0);
  EXPECT_FALSE(app().path_plays);
  app().path_time = 1;
  rest();
  click_text("Play", 0);
  EXPECT_EQ(app().path_time, 1) << "on the way it goes on";
  app().path_plays = false;
  rest();
  click_text("0.0 s", 0);
  EXPECT_EQ(app().view, first);
  EXPECT_EQ(app().document.time, 0.25f);
  EXPECT_EQ(app().path_time, 0);
  const DrawnThing play = text("Play", 0);
  drag(200, play.from.y + 6, 400, play.from.y + 6);
  EXPECT_EQ(app().path_time, 2);
  EXPECT_EQ(app().view, app().bookmarks.keys[1].view);
  EXPECT_EQ(app().document.time, 0.75f);
  rest();
  click_text("Save");
  EXPECT_EQ(read_camera_path("path.json"), app().bookmarks);
  const DrawnThing second = text("2.0 s");
  click(352, second.from.y + 6);
  ASSERT_EQ(app().bookmarks.keys.size(), 1u);
  EXPECT_EQ(app().bookmarks.keys[0].name, "view 1");
  rest();
  click_text("Open");
  EXPECT_EQ(app().bookmarks.keys.size(), 2u);
  click_text("room-b");
  EXPECT_EQ(app().view, start_view(app().document, "room-b"));
  app().selection = {Kind::light, 0};
  click_text("Frame everything (F)");
  EXPECT_EQ(app().selection, Selection{});
  EXPECT_EQ(app().view, framed_within(start_view(app().document, "room-b"), app().document.bounds,
                                      app().viewport.aspect(), posed()));
}

}  // namespace
}  // namespace ssphh::viewer
