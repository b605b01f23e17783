// What keys and the mouse do in the picture, driven as a script drives them.

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include "app_stage.h"
#include "drawn.h"

namespace ssphh::viewer {
namespace {

class Input : public AppStage {
 protected:
  Input() {
    start(400, 300);
    app().panels = false;
    app().take_document(document("two-rooms"));
    app().view = look_at({-1, 1.5f, 1.9f}, {-2.4f, 1.5f, 0}, 1);
    frames(2);
  }
  /// Pixel of a point of the world.
  vec2 at(const vec3& point) {
    const vec3 p = project(app().view, point, 400 / 300.0f);
    return {400 * p.x, 300 * (1 - p.y)};
  }
  void take_probes() {
    probes::ProbeSet set;
    set.degree = 0;
    set.light_groups.push_back({"all"});
    for (const SphlEdit& sphl : app().document.edits().sphls) {
      probes::Probe& probe = set.probes.emplace_back();
      probe.position =
          sphl_position(*app().document.scene, scene::world_matrices(*app().document.scene, 0), sphl);
      probe.groups.push_back({{}, sh::RadianceSh(0)});
    }
    app().light.take(std::move(set), "x");
  }
  vec3 lamp() {
    return light_position(edited_lighting(*app().document.scene, app().document.edits(), 0).lights[0].world);
  }
};

TEST_F(Input, KeysDoWhatTheHelpSays) {
  press({GLFW_KEY_F1});
  EXPECT_TRUE(app().help);
  press({GLFW_KEY_H});
  EXPECT_FALSE(app().help);
  press({GLFW_KEY_TAB});
  EXPECT_TRUE(app().panels);
  press({GLFW_KEY_TAB});
  EXPECT_FALSE(app().panels);
  press({GLFW_KEY_N});
  EXPECT_TRUE(app().place_mode);
  app().help = true;
  app().selection = {Kind::sphl, 1};
  press({GLFW_KEY_ESCAPE});
  EXPECT_FALSE(app().place_mode || app().help);
  EXPECT_EQ(app().selection, Selection{});
  app().selection = {Kind::sphl, 1};
  press({GLFW_KEY_F});
  scene::Bounds around;
  const vec3 place = *app().selected_position();
  around.add(place - 0.5f), around.add(place + 0.5f);
  EXPECT_EQ(app().view,
            framed_within(look_at({-1, 1.5f, 1.9f}, {-2.4f, 1.5f, 0}, 1), around, 400 / 300.0f, posed()));
  press({GLFW_KEY_DELETE});
  EXPECT_EQ(app().document.edits().sphls.size(), 5u);
  EXPECT_EQ(app().selection, Selection{});
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(app().document.edits().sphls.size(), 6u);
  EXPECT_EQ(app().message, "undone: delete SPHL");
  press({GLFW_KEY_Y}, true);
  EXPECT_EQ(app().document.edits().sphls.size(), 5u);
  EXPECT_EQ(app().message, "done again: delete SPHL");
  press({GLFW_KEY_Z}, true);
  press({GLFW_KEY_Z}, true, true);
  EXPECT_EQ(app().document.edits().sphls.size(), 5u) << "with Shift: again";
  EXPECT_EQ(app().message, "done again: delete SPHL");
  press({GLFW_KEY_HOME});
  EXPECT_EQ(app().view, start_view(app().document, ""));
  app().document.time = 0.5f;
  press({GLFW_KEY_B}), press({GLFW_KEY_B});
  ASSERT_EQ(app().bookmarks.keys.size(), 2u);
  EXPECT_EQ(app().bookmarks.keys[1], (CameraKey{"view 2", 2, 0.5f, app().view}));
  EXPECT_EQ(app().message, "bookmark added");
  press({'P'});
  EXPECT_TRUE(app().settings.balls);
  press({' '});
  EXPECT_TRUE(app().settings.play) << "the door moves";
  press({'T'});
  EXPECT_EQ(app().message, "shown: wipe");
  press({'1'});
  EXPECT_EQ(app().message, "picture: all light");
  press({'8'});
  EXPECT_EQ(app().message, "picture: leak");
  press({']'});
  EXPECT_EQ(app().settings.exposure, 0.5f);
  EXPECT_EQ(app().message, "picture: leak") << "not told";
  press({GLFW_KEY_S}, true);
  press({GLFW_KEY_S}, true);
  EXPECT_THAT(app().report.written, testing::ElementsAre("two-rooms-01.glb", "two-rooms-01.glb"));
  EXPECT_EQ(app().message, "saved two-rooms-01.glb in " + std::filesystem::current_path().string());
  app().selection = {Kind::sphl, 0};
  press({GLFW_KEY_F, GLFW_KEY_B}, true);
  EXPECT_EQ(app().bookmarks.keys.size(), 2u) << "with Ctrl these keys mean nothing";
  app().document.source = app().document.file = "";
  press({GLFW_KEY_S}, true);
  EXPECT_EQ(app().report.written.back(), "view-01.glb");
}

TEST_F(Input, WithoutASceneOnlyTheHelpAndThePanelsAnswer) {
  start(400, 300);
  frames(2);
  press({GLFW_KEY_H}), press({GLFW_KEY_N}), press({'P'}), press({GLFW_KEY_B}), press({GLFW_KEY_S}, true);
  drag(200, 150, 250, 150);
  EXPECT_TRUE(app().help);
  EXPECT_FALSE(app().place_mode || app().settings.balls);
  EXPECT_TRUE(app().bookmarks.empty());
  EXPECT_EQ(app().message, "");
}

TEST_F(Input, KeysFlyAtTheirSpeed) {
  const View before = app().view;
  app().path_plays = true;
  app().fly_speed = 2;
  frame({.mouse = {}, .buttons = {}, .keys = {'W', 'E'}, .ctrl = false, .shift = false}, 0.125f);
  EXPECT_EQ(app().view, moved(before, {0, 0.25f, 0.25f}));
  EXPECT_FALSE(app().path_plays);
  app().view = before;
  frame({.mouse = {}, .buttons = {}, .keys = {'A'}, .ctrl = false, .shift = true}, 0.125f);
  EXPECT_EQ(app().view, moved(before, {-1, 0, 0}));
  app().view = before;
  frame({.mouse = {}, .buttons = {}, .keys = {'D'}, .ctrl = true, .shift = false}, 0.125f);
  frame({}, 0.125f);
  EXPECT_EQ(app().view, before);
}

TEST_F(Input, DragsTurnLookAndMove) {
  const View before = app().view;
  app().path_plays = true;
  drag(100, 250, 130, 240);
  EXPECT_EQ(app().view, orbited_by(before, {100, 250}, {130, 240}));
  EXPECT_FALSE(app().path_plays);
  EXPECT_EQ(app().drag.what, Drag::What::none);
  app().view = before;
  drag(100, 250, 130, 240, 1);
  EXPECT_EQ(app().view, dragged(before, ViewDrag::look, {30, -10}, 300));
  app().view = before;
  drag(100, 250, 130, 240, 2);
  EXPECT_EQ(app().view, dragged(before, ViewDrag::pan, {30, -10}, 300));
  app().view = before;
  window_->wheel = 2;
  mouse(100, 250);
  EXPECT_EQ(app().view, wheeled(before, 2));
  // Shift is held with a key that does nothing.
  app().view = before;
  mouse(100, 250);
  const auto shifted = [&](float x, float y, bool down) {
    frame({.mouse = {{x, y}},
           .buttons = {down, false, false},
           .keys = {GLFW_KEY_LEFT_SHIFT},
           .ctrl = false,
           .shift = true});
  };
  shifted(100, 250, false), shifted(100, 250, true), shifted(130, 240, true), shifted(130, 240, false);
  EXPECT_EQ(app().view, dragged(before, ViewDrag::pan, {30, -10}, 300));
  frames(2);
  app().view = before;
  drag(100, 250, 130, 240);
  EXPECT_EQ(app().view, orbited_by(before, {100, 250}, {130, 240})) << "Shift was let go";
  app().view = before;
  app().path_plays = true;
  click(100, 250);
  EXPECT_EQ(app().view, before);
  EXPECT_TRUE(app().path_plays) << "nothing was dragged";
  window_->wheel = 1;
  mouse(500, 350);
  EXPECT_EQ(app().view, before) << "outside of the picture";
}

TEST_F(Input, ALampIsTakenByItsSignAndPulled) {
  const vec3 place = lamp();
  app().view = look_at({-2.4f, 2.5f, 2.5f}, place, 1);
  const vec2 sign = at(place);
  const float metre = 300 / (2 * 2 * std::tan(0.5f));  // pixels, two metres away
  drag(sign.x + 9, sign.y, sign.x + 9 + 60, sign.y + 30);
  EXPECT_EQ(app().selection, (Selection{Kind::light, 0}));
  EXPECT_LT(glm::distance(lamp(), place + vec3(60, -30, 0) / metre), 1e-3f);
  EXPECT_EQ(app().document.history.undo_name(), "move lamp");
  const vec3 moved_once = lamp();
  // The handle of x ends 0.24 of half the picture's height, 36 pixels, right of it.
  const vec2 now = at(moved_once);
  drag(now.x + 36, now.y, now.x + 36 + 50, now.y);
  EXPECT_NEAR(lamp().x, moved_once.x + 50 / metre, 0.01f);
  EXPECT_EQ(lamp().y, moved_once.y);
  EXPECT_TRUE(app().document.history.undo());
  EXPECT_EQ(lamp(), moved_once) << "each drag is a step";
  EXPECT_TRUE(app().document.history.undo());
  EXPECT_EQ(lamp(), place);
}

TEST_F(Input, SignsAndHandlesAreAsLargeAsTheyLook) {
  const vec3 place = lamp();
  app().view = look_at({-2.4f, 2.5f, 2.5f}, place, 1);
  const vec2 sign = at(place);
  EXPECT_EQ(lamp_under_mouse(app(), sign.x + 10.9f, sign.y), 0);
  EXPECT_EQ(lamp_under_mouse(app(), sign.x, sign.y - 10.9f), 0);
  EXPECT_EQ(lamp_under_mouse(app(), sign.x + 11.1f, sign.y), -1);
  EXPECT_EQ(lamp_under_mouse(app(), sign.x, sign.y - 11.1f), -1);
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 36, sign.y), -1) << "nothing is chosen";
  app().selection = {Kind::light, 0};
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 36, sign.y), 0);
  EXPECT_EQ(axis_under_mouse(app(), sign.x, sign.y - 36), 1);
  EXPECT_EQ(axis_under_mouse(app(), sign.x, sign.y), 2) << "toward the eye";
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 46.9f, sign.y), 0);
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 47.1f, sign.y), -1);
  app().view.orthographic = true;
  app().view.yheight = 4;
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 36, sign.y), 0) << "0.12 of the height, too";
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 25.1f, sign.y), 0);
  EXPECT_EQ(axis_under_mouse(app(), sign.x + 24.5f, sign.y), -1);
  app().view = look_at({-2.4f, 2.5f, -1.5f}, {-2.4f, 2.5f, -3}, 1);
  EXPECT_EQ(lamp_under_mouse(app(), 200, 150), -1) << "it is behind the eye";
}

TEST_F(Input, ABallIsTakenWhereNoSurfaceHidesIt) {
  take_probes();
  app().settings.ball_size = 0.3f;                         // more than one that is so near is shown with
  const vec3 ball = app().light.set().probes[0].position;  // "A west"
  app().view = look_at(ball + vec3(0, 0, 1.5f), ball, 1);
  // Of the picture's middle to where a tenth beyond the ball ends; ImGui's mouse stands at whole pixels.
  const auto reach = [](float radius) {
    const float r = 1.1f * radius;
    return r / std::sqrt(1.5f * 1.5f - r * r) * 150 / std::tan(0.5f);
  };
  const vec2 middle = at(ball);
  click(middle.x, middle.y);
  EXPECT_FALSE(app().selection.is(Kind::sphl)) << "balls are not shown";
  app().settings.balls = true;
  click(middle.x + std::floor(reach(1.5f * widest_ball)), middle.y);
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 0}));
  app().selection = {};
  click(middle.x + std::ceil(reach(1.5f * widest_ball)), middle.y);
  EXPECT_FALSE(app().selection.is(Kind::sphl));
  // Without a size of its own a ball has that by the probes' distance.
  app().settings.ball_size = 0;
  const float radius = default_ball_size(app().light.set());
  click(middle.x + std::floor(reach(radius)), middle.y);
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 0}));
  app().selection = {};
  click(middle.x + std::ceil(reach(radius)), middle.y);
  EXPECT_FALSE(app().selection.is(Kind::sphl));
  drag(middle.x, middle.y, middle.x + 50, middle.y);
  EXPECT_NEAR(app().selected_position()->x, ball.x + 50 * 1.5f * std::tan(0.5f) / 150, 1e-3f);
  EXPECT_EQ(app().document.history.undo_name(), "move A west");
  // Behind the wall between the rooms
  app().selection = {};
  const vec3 hidden = app().light.set().probes[4].position;  // "B middle"
  app().view = look_at(hidden + vec3(-4, 0, 0), hidden, 1);
  click(200, 150);
  EXPECT_FALSE(app().selection.is(Kind::sphl));
}

TEST_F(Input, AnSphlIsPlacedOffTheSurfaceUnderTheMouse) {
  app().place_mode = true;
  app().view = look_at({-2.4f, 1.5f, 0.001f}, {-2.4f, 0, 0}, 1);  // Down on the floor, y = 0
  click(200, 150);
  ASSERT_EQ(app().document.edits().sphls.size(), 7u);
  EXPECT_LT(glm::distance(*app().document.edits().sphls[6].position, vec3(-2.4f, 0.5f, 0)), 2e-3f);
  EXPECT_EQ(app().selection, (Selection{Kind::sphl, 6}));
  EXPECT_FALSE(app().place_mode);
  EXPECT_EQ(app().document.history.undo_name(), "place SPHL");
  const SphlEdit& sphl = app().document.edits().sphls[6];
  EXPECT_EQ(sphl.source, -1);
  EXPECT_EQ(sphl.radius, 0.1f);
  EXPECT_TRUE(sphl.enabled);
  app().place_mode = true;
  app().view = look_at({-2.4f, 50, 10}, {-2.4f, 100, 10}, 1);
  click(200, 150);
  EXPECT_EQ(app().document.edits().sphls.size(), 7u);
  EXPECT_EQ(app().message, "there is no surface under the mouse");
  EXPECT_TRUE(app().place_mode);
}

TEST_F(Input, TheWipesLineIsDragged) {
  app().settings.show = Show::wipe;
  app().settings.wipe = 0.5f;
  app().view = look_at({-1, 1.5f, 1.9f}, {5, 1.5f, 1.9f}, 1);
  drag(207, 250, 100, 250);
  EXPECT_FLOAT_EQ(app().settings.wipe, 0.25f);
  mouse(100, 250), mouse(100, 250, {true}), mouse(150, 250, {true});
  EXPECT_TRUE(app().drag.moved);
  EXPECT_FALSE(app().drag.changes_picture());
  mouse(100, 250, {true}), mouse(100, 250);
  drag(93, 250, 500, 250);
  EXPECT_FLOAT_EQ(app().settings.wipe, 1);
  app().settings.wipe = 0.5f;
  drag(208, 250, 100, 250);
  EXPECT_FLOAT_EQ(app().settings.wipe, 0.5f) << "beside the line: the view turns";
  app().settings.show = Show::realtime;
  drag(200, 250, 100, 250);
  EXPECT_FLOAT_EQ(app().settings.wipe, 0.5f);
}

TEST_F(Input, ProbesAreTheEnabledSphlsInTheirOrder) {
  EXPECT_EQ(probe_of_sphl(app(), 0), -1) << "there is no light";
  take_probes();
  app().document.edit("off", [](Edits& e) { e.sphls[1].enabled = false; });
  EXPECT_EQ(probe_of_sphl(app(), 0), 0);
  EXPECT_EQ(probe_of_sphl(app(), 1), -1);
  EXPECT_EQ(probe_of_sphl(app(), 2), 1);
  EXPECT_EQ(probe_of_sphl(app(), -1), -1);
  EXPECT_EQ(sphl_of_probe(app(), 0), 0);
  EXPECT_EQ(sphl_of_probe(app(), 1), 2);
  EXPECT_EQ(sphl_of_probe(app(), 4), 5);
  EXPECT_EQ(sphl_of_probe(app(), 5), -1);
  EXPECT_EQ(sphl_of_probe(app(), -1), -1);
  app().document.edit("more", [](Edits& e) { e.sphls.push_back({}), e.sphls.push_back({}); });
  EXPECT_EQ(probe_of_sphl(app(), 6), 5);
  EXPECT_EQ(probe_of_sphl(app(), 7), -1) << "not lit yet";
}

TEST_F(Input, ShowsAtMostFourThousandEdgesTheStrongestOnes) {
  probes::ProbeSet set;
  set.degree = 0;
  set.light_groups.push_back({"all"});
  for (int i = 0; i < 100; ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position = {-2, 1, -1};
    probe.groups.push_back({{}, sh::RadianceSh(0)});
    for (int j = 0; j < 41; ++j)
      probe.edges.push_back({j, i == 7 ? 1.0f : 0.5f / static_cast<float>(i + 1), {}, {}});
  }
  app().light.take(std::move(set), "x");
  visible_.assign(100, 1);
  frame();
  const std::size_t without = drawn_things(*ImGui::GetBackgroundDrawList()).size();
  app().settings.graph = true;
  frame();
  EXPECT_EQ(drawn_things(*ImGui::GetBackgroundDrawList()).size() - without, 4000u);
}

TEST(Keys, AreKnownByTheirNames) {
  EXPECT_EQ(key_by_name("Escape"), GLFW_KEY_ESCAPE);
  EXPECT_EQ(key_by_name("space"), GLFW_KEY_SPACE);
  EXPECT_EQ(key_by_name("tab"), GLFW_KEY_TAB);
  EXPECT_EQ(key_by_name("enter"), GLFW_KEY_ENTER);
  EXPECT_EQ(key_by_name("delete"), GLFW_KEY_DELETE);
  EXPECT_EQ(key_by_name("left"), GLFW_KEY_LEFT);
  EXPECT_EQ(key_by_name("right"), GLFW_KEY_RIGHT);
  EXPECT_EQ(key_by_name("up"), GLFW_KEY_UP);
  EXPECT_EQ(key_by_name("down"), GLFW_KEY_DOWN);
  EXPECT_EQ(key_by_name("HOME"), GLFW_KEY_HOME);
  EXPECT_EQ(key_by_name("h"), GLFW_KEY_H);
  EXPECT_EQ(key_by_name("7"), GLFW_KEY_7);
  EXPECT_EQ(key_by_name("["), std::nullopt);
  EXPECT_EQ(key_by_name("f1"), GLFW_KEY_F1);
  EXPECT_EQ(key_by_name("F12"), GLFW_KEY_F12);
  for (const char* unknown : {"", "f", "f0", "f13", "f123", "fx", "g1", "ab"})
    EXPECT_EQ(key_by_name(unknown), unknown == std::string("f") ? std::optional<int>('F') : std::nullopt)
        << unknown;
}

}  // namespace
}  // namespace ssphh::viewer
