#include "model/gestures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "expect_near.h"

namespace ssphh::viewer {
namespace {

using test::expect_near;

vec3 flies(const std::string& keys) {
  return fly_direction([&](char key) { return keys.find(key) != std::string::npos; });
}

TEST(Gestures, KeysFlyTheWayTheHelpSays) {
  EXPECT_EQ(flies("W"), vec3(0, 0, 1));
  EXPECT_EQ(flies("S"), vec3(0, 0, -1));
  EXPECT_EQ(flies("A"), vec3(-1, 0, 0));
  EXPECT_EQ(flies("D"), vec3(1, 0, 0));
  EXPECT_EQ(flies("Q"), vec3(0, -1, 0));
  EXPECT_EQ(flies("E"), vec3(0, 1, 0));
  EXPECT_EQ(flies("WEA"), vec3(-1, 1, 1));
  EXPECT_EQ(flies("WSADQE"), vec3(0));
  EXPECT_EQ(flies("wasdqeFX1 "), vec3(0));
}

TEST(Gestures, DragsTurnTheWayTheMouseGoes) {
  const View ahead = look_at({0, 0, 0}, {0, 0, -2}, 1);
  const View right = dragged(ahead, ViewDrag::look, {100, 0}, 400);
  expect_near(right.forward(), {std::sin(0.5f), 0, -std::cos(0.5f)});
  EXPECT_EQ(right.eye, ahead.eye);
  const View down = dragged(ahead, ViewDrag::look, {0, 100}, 400);
  expect_near(down.forward(), {0, -std::sin(0.5f), -std::cos(0.5f)});
  // The same turn about the focus
  const View around = dragged(ahead, ViewDrag::orbit, {100, 0}, 400);
  expect_near(around.forward(), right.forward());
  expect_near(around.center(), ahead.center());
  const View over = dragged(ahead, ViewDrag::orbit, {0, 100}, 400);
  expect_near(over.eye, {0, 2 * std::sin(0.5f), -2 + 2 * std::cos(0.5f)});
  expect_near(over.center(), ahead.center());
}

TEST(Gestures, PanKeepsWhatStandsAtTheFocusUnderTheMouse) {
  const vec2 size(600, 400), pixels(37, -52);
  for (const bool orthographic : {false, true}) {
    View view = look_at({4, 2, 1}, {1, 1.5f, 1}, 0.8f);
    view.orthographic = orthographic, view.yheight = 1.3f;
    const View after = dragged(view, ViewDrag::pan, pixels, size.y);
    const vec3 seen = project(after, view.center(), size.x / size.y);
    EXPECT_NEAR((seen.x - 0.5f) * size.x, pixels.x, 1e-3f) << orthographic;
    EXPECT_NEAR((0.5f - seen.y) * size.y, pixels.y, 1e-3f) << orthographic;
    EXPECT_EQ(after.orientation, view.orientation);
    EXPECT_NEAR(seen.z, view.focus, 1e-5f);
  }
}

TEST(Gestures, TheWheelForwardGoesNearer) {
  const View view = look_at({0, 0, 4}, {0, 0, 0}, 1);
  EXPECT_NEAR(wheeled(view, 1).focus, 3.6f, 1e-5f);
  EXPECT_NEAR(wheeled(view, -1).focus, 4 / 0.9f, 1e-5f);
  EXPECT_NEAR(wheeled(view, 2).focus, 4 * 0.81f, 1e-5f);
  expect_near(wheeled(view, 1).center(), vec3(0));
}

/// Settings that differ from the defaults as told, and in nothing else.
template <class Change>
void expect_key(char key, const Settings& before, const Change& change) {
  Settings expected = before;
  change(expected);
  EXPECT_EQ(after_key(before, key, true), expected) << key;
}

TEST(Gestures, KeysChangeWhatTheyName) {
  const Settings s;
  expect_key('P', s, [](Settings& e) { e.balls = true; });
  expect_key('G', s, [](Settings& e) { e.graph = true; });
  expect_key('L', s, [](Settings& e) { e.lobes = e.balls = true; });
  expect_key(' ', s, [](Settings& e) { e.play = true; });
  expect_key('M', s, [](Settings& e) { e.views = 2; });
  expect_key('[', s, [](Settings& e) { e.exposure = -0.5f, e.auto_exposure = false; });
  expect_key(']', s, [](Settings& e) { e.exposure = 0.5f, e.auto_exposure = false; });
  expect_key('\\', s, [](Settings& e) { e.auto_exposure = false; });
  Settings on;
  on.balls = on.graph = on.lobes = on.play = true;
  expect_key('P', on, [](Settings& e) { e.balls = false; });
  expect_key('G', on, [](Settings& e) { e.graph = false; });
  expect_key('L', on, [](Settings& e) { e.lobes = false; });
  expect_key(' ', on, [](Settings& e) { e.play = false; });
  EXPECT_EQ(after_key(s, ' ', false), s) << "nothing moves";
  Settings leak;
  leak.debug = DebugView::leak;
  for (const char key : setting_keys)
    EXPECT_EQ(after_key(leak, key, true) == leak, key == '8') << key << ": every key changes something";
}

TEST(Gestures, DigitsChooseDebugViewsInTheHelpsOrder) {
  const DebugView views[] = {DebugView::none,   DebugView::direct, DebugView::indirect, DebugView::albedo,
                             DebugView::normal, DebugView::shadow, DebugView::sphl,     DebugView::leak};
  for (int i = 0; i < 8; ++i) {
    Settings other;
    other.debug = i == 3 ? DebugView::normal : DebugView::albedo;
    EXPECT_EQ(after_key(other, static_cast<char>('1' + i), false).debug, views[i]) << i;
  }
}

TEST(Gestures, TruthIsShownBesideAloneAsDifferenceAndNotAgain) {
  Settings s;
  for (const Show expected : {Show::wipe, Show::truth, Show::pixelated, Show::realtime}) {
    s = after_key(s, 'T', false);
    EXPECT_EQ(s.show, expected);
  }
  for (const Show difference : {Show::absolute, Show::signed_}) {
    s.show = difference;
    EXPECT_EQ(after_key(s, 'T', false).show, Show::realtime);
  }
}

TEST(Gestures, WhatIsPulledStaysUnderTheMouseFromWhereItWasTaken) {
  const View view = look_at({1, 2, 6}, {0, 1, 0}, 0.9f);
  const auto ray = [&](float x, float y) { return pixel_ray(view, {x, y}, 1.5f); };
  const vec3 place(0.3f, 0.8f, -0.5f);
  const Grip grip = taken(ray(0.55f, 0.45f), place, -1, view.forward());
  expect_near(*pulled(grip, ray(0.55f, 0.45f), view.forward()), place);
  const vec3 moved = *pulled(grip, ray(0.7f, 0.3f), view.forward());
  // As far in the picture as the mouse, and no nearer
  const vec3 before = project(view, place, 1.5f), after = project(view, moved, 1.5f);
  EXPECT_NEAR(after.x - before.x, 0.15f, 1e-5f);
  EXPECT_NEAR(after.y - before.y, -0.15f, 1e-5f);
  EXPECT_NEAR(after.z, before.z, 1e-5f);
  EXPECT_FALSE(pulled(grip, {view.eye, -view.forward()}, view.forward()).has_value());
}

TEST(Gestures, WhatIsPulledAlongAnAxisStaysOnIt) {
  const View view = look_at({1, 2, 6}, {0, 1, 0}, 0.9f);
  const vec3 place(0.3f, 0.8f, -0.5f);
  for (int axis = 0; axis < 3; ++axis) {
    // The mouse goes from one point of the axis to another
    vec3 from = place, to = place;
    from[axis] += 0.2f, to[axis] -= 0.5f;
    const auto toward = [&](const vec3& p) { return rays::RayQuery{view.eye, glm::normalize(p - view.eye)}; };
    const Grip grip = taken(toward(from), place, axis, view.forward());
    vec3 expected = place;
    expected[axis] -= 0.7f;
    expect_near(*pulled(grip, toward(to), view.forward()), expected, 1e-4f);
    vec3 along(0);
    along[axis] = 1;
    EXPECT_FALSE(pulled(grip, {view.eye, along}, view.forward()).has_value());
  }
}

}  // namespace
}  // namespace ssphh::viewer
