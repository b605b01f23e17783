// Lamps turned by their rings, and drags in round steps, by the mouse.

#include <cmath>

#include <gmock/gmock.h>

#include "on_screen.h"
#include "panel_stage.h"
#include "rings.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

constexpr int spot = 1, sun = 2;

class RingInput : public PanelStage {
 protected:
  RingInput() {
    app().view = look_at({0.8f, 1.8f, 5}, {-0.5f, 1, 0}, 1);
    choose(spot);
  }
  void choose(int lamp) {
    app().selection = {Kind::light, lamp};
    rest();
  }
  mat4 world() {
    return app().document.lighting().lights[static_cast<std::size_t>(app().selection.index)].world;
  }
  vec3 direction() { return light_direction(world()); }
  vec2 pixel(const vec3& point) {
    const auto at = on_screen(app(), point);
    return at ? vec2(at->x, at->y) : vec2(-1);
  }
  /// Where this ring is under the mouse and no other, and how it stands there.
  std::pair<vec2, RingUnderMouse> find(int index) {
    const Rect2& r = app().viewport;
    const vec2 middle = pixel(*app().aim_origin());
    for (float y = -180; y < 180; y += 3) {
      for (float x = -180; x < 180; x += 3) {
        const vec2 at = glm::floor(middle + vec2(x, y));  // as ImGui has the mouse
        if (!r.contains(at.x, at.y) || axis_under_mouse(app(), at.x, at.y) >= 0) continue;
        if (aim_under_mouse(app(), at.x, at.y)) continue;
        const auto ring = ring_under_mouse(app(), at.x, at.y);
        // Where a mouse goes far for an angle: not at the ends of a ring that is seen from its side
        const vec3 arm = ring ? ring->at - ring->ring.center : vec3(0);
        const vec2 way =
            ring ? pixel(ring->ring.center + glm::angleAxis(0.1f, ring->ring.axis) * arm) - pixel(ring->at)
                 : vec2(0);
        if (ring && ring->index == index && glm::length(way) > 0.08f * glm::distance(pixel(ring->at), middle))
          return {at, *ring};
      }
    }
    ADD_FAILURE() << "there is no ring " << index;
    return {};
  }
  /// Drags a ring by an angle, with Ctrl or without; the button stays down with `hold`.
  void turn(int index, float angle, bool ctrl = false, bool hold = false) {
    const auto [from, hit] = find(index);
    const vec3 arm = hit.at - hit.ring.center;
    const vec2 to =
        from + pixel(hit.ring.center + glm::angleAxis(angle, hit.ring.axis) * arm) - pixel(hit.at);
    step(from, false, ctrl), step(from, false, ctrl), step(from, true, ctrl), step(to, true, ctrl);
    if (!hold) step(to, false, ctrl), rest();
  }
  void step(const vec2& at, bool down, bool ctrl) {
    InjectedInput input;
    input.mouse = {at.x, at.y}, input.buttons = {down, false, false}, input.ctrl = ctrl;
    if (ctrl) input.keys = {GLFW_KEY_LEFT_CONTROL};
    frame(input);
  }
  void pull_axis(int axis, float metres, bool ctrl) {
    const vec3 place = *app().selected_position();
    vec3 along(0);
    along[axis] = 1;
    const vec2 from = pixel(place + axis_length(app(), place) * along);
    const vec2 to = pixel(place + (axis_length(app(), place) + metres) * along);
    step(from, false, ctrl), step(from, false, ctrl), step(from, true, ctrl), step(to, true, ctrl);
    step(to, false, ctrl), rest();
  }
};

TEST_F(RingInput, ASpotIsTurnedAboutTheWorldsAxesInOneStepOfUndo) {
  app().turn_selected({0.5f, -0.5f, -1});
  app().document.history.seal();
  for (int axis = 0; axis < 3; ++axis) {
    const mat4 before = world();
    turn(axis, 0.35f);
    vec3 about(0);
    about[axis] = 1;
    EXPECT_LT(glm::distance(direction(), light_direction(turned_about(before, about, 0.35f))), 0.25f) << axis;
    EXPECT_GT(glm::distance(direction(), light_direction(before)), 0.1f) << axis;
    EXPECT_EQ(light_position(world()), light_position(before));
    EXPECT_EQ(app().document.history.undo_name(), "turn spot");
    press({GLFW_KEY_Z}, true);
    EXPECT_EQ(world(), before);
  }
}

TEST_F(RingInput, TheSunIsTurnedWhereTheViewLooks) {
  choose(sun);
  app().turn_selected({0.6f, -1, -0.3f});
  const float height = direction().y;
  const vec3 before = direction();
  turn(1, 0.5f);
  EXPECT_NEAR(direction().y, height, 1e-5f) << "about the vertical";
  EXPECT_GT(glm::distance(direction(), before), 0.1f);
}

TEST_F(RingInput, ARectangleIsTurnedAboutItsAimToo) {
  app().add_lamp(scene::LightType::rectangle);
  app().turn_selected({-0.3f, -0.3f, -1});
  rest();
  const mat4 before = world();
  turn(3, 0.4f);
  EXPECT_LT(glm::distance(direction(), light_direction(before)), 1e-5f);
  EXPECT_GT(glm::distance(vec3(world()[0]), vec3(before[0])), 0.1f);
}

TEST_F(RingInput, WhatShinesAlikeInAllDirectionsHasNoRings) {
  choose(0);
  const vec2 middle = pixel(*app().selected_position());
  for (float r = 5; r < 300; ++r) EXPECT_FALSE(ring_under_mouse(app(), middle.x + r, middle.y));
}

TEST_F(RingInput, CtrlTurnsAndMovesInSteps) {
  app().turn_selected({0.5f, -0.5f, -1});
  app().document.history.seal();
  const mat4 before = world();
  turn(1, 0.35f, true);  // 20°
  EXPECT_LT(glm::distance(direction(), light_direction(turned_about(before, {0, 1, 0}, glm::radians(15.0f)))),
            1e-5f);
  pull_axis(0, 0.234f, true);
  const float x = app().selected_position()->x;
  EXPECT_NEAR(10 * x, std::round(10 * x), 1e-4f);
  EXPECT_GT(x, light_position(before).x + 0.1f);
}

TEST_F(RingInput, SnappingThatIsSwitchedOnIsFreeWithCtrl) {
  app().settings.snap = true;
  app().settings.snap_step = 0.25f;
  pull_axis(1, 0.4f, false);
  EXPECT_FLOAT_EQ(app().selected_position()->y, 1.5f);
  pull_axis(1, 0.1f, true);
  EXPECT_NEAR(app().selected_position()->y, 1.6f, 0.02f);
}

TEST_F(RingInput, TheAmberHandleAimsInSteps) {
  app().view = look_at({0.5f, 1.5f, 6}, {0, 1, 0}, 1);
  app().turn_selected({0.6f, -1, -0.2f});
  rest();
  const vec2 from = pixel(*app().aim_origin() + aim_length(app()) * direction());
  const vec2 to = from + vec2(60, 10);
  step(from, false, true), step(from, false, true), step(from, true, true), step(to, true, true);
  step(to, false, true), rest();
  const PanTilt angles = pan_tilt_of(direction());
  EXPECT_NEAR(angles.pan / 15, std::round(angles.pan / 15), 1e-3f);
  EXPECT_NEAR(angles.tilt / 15, std::round(angles.tilt / 15), 1e-3f);
}

TEST_F(RingInput, TheAngleAndThePlaceAreShownBesideTheMouse) {
  app().turn_selected({0.5f, -0.5f, -1});
  turn(1, 0.35f, true, true);
  EXPECT_TRUE(shows("+15.0<b0>"));
  rest();
  EXPECT_FALSE(shows("+15.0<b0>"));
}

TEST_F(RingInput, PanTiltAndStepsAreNumbersOfThePanel) {
  open("Light");
  app().turn_selected({0, 0, -1});
  pull("pan, tilt", 40);
  EXPECT_GT(pan_tilt_of(direction()).pan, 5);
  EXPECT_NEAR(pan_tilt_of(direction()).tilt, 0, 1e-3f);
  pull("pan, tilt", -40, 1);
  EXPECT_LT(pan_tilt_of(direction()).tilt, -5);
  click_widget("snap");
  EXPECT_TRUE(app().settings.snap);
  pull("steps [m], [<b0>]", 20, 1);
  EXPECT_GT(app().settings.snap_angle, 15);
}

TEST_F(RingInput, PlacesAreDraggedAsLargeAsTheSceneIs) {
  for (const char* name : {"random?seed=74", "two-rooms"}) {
    app().take_document(document(name));
    app().add_lamp(scene::LightType::sphere);
    open("Light");
    const float radius = app().document.bounds.radius();
    const vec3 before = *app().selected_position();
    pull("position", 10);
    const float moved = std::abs(app().selected_position()->x - before.x);
    EXPECT_GT(moved, 0.002f * radius) << name;
    EXPECT_LT(moved, 0.2f * radius) << name;
    const float size = app().document.edits().lights.back().lamp.radius;
    EXPECT_LT(size, radius) << name;
    pull("radius", -60);
    EXPECT_LT(app().document.edits().lights.back().lamp.radius, 0.7f * size) << name;
    EXPECT_TRUE(on_screen(app(), *app().selected_position())) << name;
  }
}

}  // namespace
}  // namespace ssphh::viewer
