#include "input.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "model/framing.h"
#include "model/gestures.h"
#include "model/lengths.h"
#include "model/pick.h"
#include "overlay.h"
#include "rings.h"

namespace ssphh::viewer {
namespace {

constexpr Shortcut all_shortcuts[] = {
    {"click", "select an object, a lamp or a probe's ball"},
    {"left drag", "turn the view; move a lamp or probe, turn a ring (Ctrl: in steps)"},
    {"right drag", "look around"},
    {"middle or Shift drag", "move sideways"},
    {"wheel", "nearer, farther"},
    {"W A S D, Q E; V", "fly, with Shift faster; walk on the ground"},
    {"F", "frame the selection, or all, from within the room"},
    {"Home", "the scene's first camera"},
    {"numpad 1 3 7, 5", "from the front, right, above (Ctrl: opposite), orthographic"},
    {"Alt+Left, Alt+Right", "the view before, after"},
    {"M", "one view, two or four side by side; a press in one makes it the one at work"},
    {"B", "add a bookmark"},
    {"I", "values under the mouse; a click pins the point"},
    {"Space", "play or stop the animation"},
    {"P", "probes: off, as balls"},
    {"L", "lobes: balls bulge where light comes from"},
    {"G", "graph of the hierarchy"},
    {"N", "place an SPHL with the next click"},
    {"X", "aim the selected lamp at the next click"},
    {"Ctrl+D, Delete", "duplicate the selected lamp, delete a lamp or an SPHL"},
    {"T", "ground truth: off, beside the picture, alone, difference"},
    {"J, U, K", "histogram, waveform, false colours, all in stops"},
    {"1 … 8", "all, direct, indirect, albedo, normal, shadow, SPHL, leak"},
    {"[ ] \\", "darker, brighter, as suits the picture"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo (also Ctrl+Shift+Z)"},
    {"Ctrl+O", "open a file"},
    {"Ctrl+S, Ctrl+Shift+S", "save the scene over its own GLB file, under a name"},
    {"F12, Ctrl+F12", "screenshot; under a name, also linear (Shift: in the program tev)"},
    {"Tab", "panels on, off"},
    {"F1 or H", "this help"},
    {"Escape", "leave a mode; no selection"},
};

/// GLFW names letters, digits and signs by their ASCII capitals.
static_assert(GLFW_KEY_W == 'W' && GLFW_KEY_1 == '1' && GLFW_KEY_SPACE == ' ' &&
              GLFW_KEY_LEFT_BRACKET == '[');

bool pressed(int key) {
  return ImGui::IsKeyPressed(key, false);
}

/// As pressed(), again and again while the key is held.
bool repeated(int key) {
  return ImGui::IsKeyPressed(key, true);
}

void toggle(App& app, bool& value) {
  value = !value;
  app.redraw();
}

void press_setting_key(App& app, char key) {
  const Show shown = app.settings.show;
  app.settings = after_key(app.settings, key, app.document.duration > 0);
  if (app.settings.show != shown) app.say(fmt::format("shown: {}", name_of(app.settings.show)));
  if (key >= '1' && key <= '8')
    app.say(fmt::format("picture: {}", key == '1' ? "all light" : name_of(app.settings.debug)));
  app.redraw();
}

void handle_control_keys(App& app) {
  if (repeated(GLFW_KEY_Z)) ImGui::GetIO().KeyShift ? app.redo() : app.undo();
  if (repeated(GLFW_KEY_Y)) app.redo();
  if (pressed(GLFW_KEY_D)) app.duplicate_lamp();
  if (pressed(GLFW_KEY_F12)) app.ask_for_file(FileDialog::For::picture);
  if (pressed(GLFW_KEY_S)) ImGui::GetIO().KeyShift ? app.ask_for_file(FileDialog::For::scene) : app.save();
}

void handle_view_keys(App& app) {
  constexpr std::pair<int, vec3> sides[] = {
      {GLFW_KEY_KP_1, {0, 0, -1}}, {GLFW_KEY_KP_3, {-1, 0, 0}}, {GLFW_KEY_KP_7, {0, -1, 0}}};
  for (const auto& [key, direction] : sides) {
    if (pressed(key)) app.view_along(ImGui::GetIO().KeyCtrl ? -direction : direction);
  }
  if (pressed(GLFW_KEY_KP_5)) app.toggle_orthographic();
  if (ImGui::GetIO().KeyAlt && repeated(GLFW_KEY_LEFT)) app.view_back();
  if (ImGui::GetIO().KeyAlt && repeated(GLFW_KEY_RIGHT)) app.view_forward();
}

void handle_keys(App& app) {
  if (pressed(GLFW_KEY_F1) || pressed(GLFW_KEY_H)) toggle(app, app.help);
  if (pressed(GLFW_KEY_TAB)) toggle(app, app.panels);
  if (pressed(GLFW_KEY_ESCAPE) && app.job.status().name.starts_with("loading")) app.job.cancel();
  if (pressed(GLFW_KEY_ESCAPE)) stop_frames(app);
  if (pressed(GLFW_KEY_ESCAPE))
    app.help = app.place_mode = app.aim_mode = app.inspecting = app.walking = false, app.selection = {};
  if (ImGui::GetIO().KeyCtrl && pressed(GLFW_KEY_O)) return app.ask_for_file(FileDialog::For::open);
  if (!app.scene_open()) return;
  handle_view_keys(app);
  if (ImGui::GetIO().KeyCtrl) return handle_control_keys(app);
  if (pressed(GLFW_KEY_F)) app.frame_selection();
  if (pressed(GLFW_KEY_HOME)) app.go_to_camera("");
  if (pressed(GLFW_KEY_B)) {
    app.add_bookmark();
    app.say("bookmark added");
  }
  if (pressed(GLFW_KEY_N)) toggle(app, app.place_mode);
  if (pressed('X') && app.can_aim()) {
    toggle(app, app.aim_mode);
    if (app.aim_mode) app.say("click what the lamp is to shine at");
  }
  if (pressed('I')) app.toggle_inspector();
  if (pressed('V')) app.toggle_walk();
  if (pressed(GLFW_KEY_DELETE)) app.delete_selection();
  for (const char key : setting_keys) {
    const bool steps = key == '[' || key == ']';
    if (steps ? repeated(key) : pressed(key)) press_setting_key(app, key);
  }
  if (pressed(GLFW_KEY_F12))
    ImGui::GetIO().KeyShift ? app.show_elsewhere() : app.screenshot(app.free_file(".png"), false);
}

void fly(App& app, float seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) return;
  const vec3 way = fly_direction([](char key) { return ImGui::IsKeyDown(key); });
  if (app.walking) return app.walk((io.KeyShift ? 2.5f : 1.0f) * vec2(way.x, way.z), seconds);
  if (way == vec3(0)) return;
  app.view = moved(app.view, way * (app.fly_speed * seconds * (io.KeyShift ? 4.0f : 1.0f)));
  app.path_plays = false;
  app.redraw();
}

vec2 picture_point(const App& app, const ImVec2& mouse) {
  return {(mouse.x - app.viewport.x) / app.viewport.width,
          1 - (mouse.y - app.viewport.y) / app.viewport.height};
}

rays::RayQuery mouse_ray(const App& app) {
  return pixel_ray(app.view, picture_point(app, ImGui::GetIO().MousePos), app.viewport.aspect());
}

/// `axis` −1: in the plane that faces the view.
void grab(App& app, Drag::What what, int axis) {
  app.document.history.seal();
  app.drag = {};
  app.drag.what = what;
  app.drag.grip = taken(mouse_ray(app), *app.selected_position(), axis, app.view.forward());
}

/// The SPHL whose ball is under the mouse; −1: none.
int ball_under_mouse(const App& app) {
  if (!app.settings.balls || app.light.empty()) return -1;
  const rays::RayQuery ray = mouse_ray(app);
  float limit = 1e30f;
  if (app.picking()) {
    if (const auto surface = pick_surface(*app.picking(), app.document.time, ray))
      limit = glm::distance(surface->position, ray.origin);
  }
  const float radius =
      app.settings.ball_size > 0 ? app.settings.ball_size : default_ball_size(app.light.set());
  std::vector<vec4> balls;
  for (const probes::Probe& probe : app.light.set().probes)
    balls.emplace_back(probe.position, 1.1f * seen_ball_size(radius, app.view, probe.position));
  return sphl_of_probe(app, pick_sphere(ray, balls, limit));
}

/// A click in place mode: an SPHL off the surface under the mouse, half a metre in a room, or nearer in
/// narrow places.
void place_sphl(App& app) {
  if (!app.picking()) return;
  const auto surface = pick_surface(*app.picking(), app.document.time, mouse_ray(app));
  if (!surface) return app.say("there is no surface under the mouse");
  const float least = lengths_of(app.document.bounds).least, gap = 0.01f * least;
  const rays::RayQuery off{surface->position + gap * surface->normal, surface->normal, 1e3f * least};
  const auto ceiling = pick_surface(*app.picking(), app.document.time, off);
  const float room = ceiling ? glm::distance(ceiling->position, off.origin) : 10 * least;
  app.add_sphl(surface->position + std::min(5 * least, 0.5f * room) * surface->normal);
  app.place_mode = ImGui::GetIO().KeyShift;
}

/// A click in aim mode.
void aim(App& app) {
  app.document.history.seal();
  if (!app.aim_on_ray(mouse_ray(app))) app.say("there is no surface under the mouse");
  app.document.history.seal();
  app.aim_mode = false;
}

/// A drag of the selected lamp's direction: at the surface under the mouse; of a sun toward the point of a
/// ball about its handle.
void drag_aim(App& app) {
  const rays::RayQuery ray = mouse_ray(app);
  if (app.selected_position()) {
    app.aim_on_ray(ray);
  } else if (const auto origin = app.aim_origin()) {
    app.turn_selected(on_ball(ray, *origin, aim_length(app)) - *origin);
  }
  const float step = glm::degrees(angle_step(app));
  if (step == 0) return;
  const auto i = static_cast<std::size_t>(app.selection.index);
  PanTilt angles = pan_tilt_of(light_direction(app.document.lighting().lights[i].world));
  angles.pan = in_steps(angles.pan, step), angles.tilt = in_steps(angles.tilt, step);
  app.turn_selected(direction_of(angles));
}

void drag_ring(App& app) {
  const auto angle = turned_by(app.drag.ring, mouse_ray(app));
  if (!angle) return;
  app.drag.turned = in_steps(*angle, angle_step(app));
  app.pose_selected(turned_about(app.drag.ring.start, app.drag.ring.ring.axis, app.drag.turned));
}

void begin_left(App& app) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (app.place_mode) return place_sphl(app);
  if (app.aim_mode) return aim(app);
  if (ImGui::GetIO().KeyShift) {
    app.drag.what = Drag::What::pan;
    return;
  }
  if (const int axis = axis_under_mouse(app, mouse.x, mouse.y); axis >= 0)
    return grab(app, Drag::What::axis, axis);
  if (aim_under_mouse(app, mouse.x, mouse.y)) {
    app.document.history.seal();
    app.drag.what = Drag::What::aim;
    return;
  }
  if (const auto ring = ring_under_mouse(app, mouse.x, mouse.y)) {
    app.document.history.seal();
    app.drag.what = Drag::What::ring;
    const auto i = static_cast<std::size_t>(app.selection.index);
    app.drag.ring = taken(ring->ring, mouse_ray(app), app.document.lighting().lights[i].world);
    return;
  }
  if (app.settings.show == Show::wipe &&
      std::abs(mouse.x - (app.viewport.x + app.settings.wipe * app.viewport.width)) < 8) {
    app.drag.what = Drag::What::wipe;
    return;
  }
  Selection hit;
  if (const int light = lamp_under_mouse(app, mouse.x, mouse.y); light >= 0) {
    hit = {Kind::light, light};
  } else if (const int sphl = ball_under_mouse(app); sphl >= 0) {
    hit = {Kind::sphl, sphl};
  }
  if (hit.kind == Kind::none) {
    app.drag.what = Drag::What::view;
    if (app.picking() && !app.walking) {
      if (const auto surface = pick_surface(*app.picking(), app.document.time, mouse_ray(app)))
        app.drag.pivot = surface->position;
    }
    return;
  }
  app.select(hit);
  if (app.selected_position()) grab(app, Drag::What::object, -1);
}

void continue_drag(App& app) {
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  if (delta.x == 0 && delta.y == 0) return;
  app.drag.moved = true;
  app.drag.way += std::hypot(delta.x, delta.y);
  const auto drag_view = [&](ViewDrag drag) {
    app.view = dragged(app.view, drag, {delta.x, delta.y}, app.viewport.height);
  };
  using What = Drag::What;
  const What what = app.drag.what;
  if (what == What::view && app.drag.pivot && app.picking())
    app.view = orbited_within(app.view, *app.drag.pivot, -0.005f * delta.x, -0.005f * delta.y,
                              {*app.picking(), app.document.time});
  else if (what == What::view)
    drag_view(app.walking ? ViewDrag::look : ViewDrag::orbit);
  if (what == What::look) drag_view(ViewDrag::look);
  if (what == What::pan) drag_view(app.walking ? ViewDrag::look : ViewDrag::pan);
  if (what == What::object || what == What::axis) {
    const auto place = pulled(app.drag.grip, mouse_ray(app), app.view.forward());
    if (place) app.move_selected(in_steps(*place, app.drag.grip.axis, place_step(app)));
  }
  if (what == What::aim) drag_aim(app);
  if (what == What::ring) drag_ring(app);
  if (what == What::wipe)
    app.settings.wipe = std::clamp(picture_point(app, ImGui::GetIO().MousePos).x, 0.0f, 1.0f);
  app.path_plays = false;
  app.redraw();
}

void handle_mouse(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  if (app.drag.what != Drag::What::none && !ImGui::IsAnyMouseDown()) {
    // A hand is not quite still while it clicks.
    const bool click = app.drag.what == Drag::What::view && app.drag.way < 4;
    app.drag = {};
    if (click && app.inspecting) {
      app.pinned = picture_point(app, io.MousePos);
    } else if (click) {
      app.select_on_ray(mouse_ray(app));
    }
    app.document.history.seal();
    app.redraw();
  }
  // A press or the wheel in another view goes on there.
  const bool free = !io.WantCaptureMouse && app.drag.what == Drag::What::none;
  if (free &&
      (ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::IsMouseClicked(ImGuiMouseButton_Right) ||
       ImGui::IsMouseClicked(ImGuiMouseButton_Middle) || io.MouseWheel != 0))
    app.take_view_at(io.MousePos.x, io.MousePos.y);
  const bool inside = !io.WantCaptureMouse && app.viewport.contains(io.MousePos.x, io.MousePos.y);
  if (inside && app.drag.what == Drag::What::none) {
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) begin_left(app);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) app.drag.what = Drag::What::look;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) app.drag.what = Drag::What::pan;
  }
  if (app.drag.what != Drag::What::none) continue_drag(app);
  if (inside && io.MouseWheel != 0 && !app.walking) {
    app.view = wheeled(app.view, io.MouseWheel);
    app.redraw();
  }
}

}  // namespace

const Shortcut* shortcuts(int& count) {
  count = static_cast<int>(std::size(all_shortcuts));
  return all_shortcuts;
}

void handle_input(App& app, float seconds) {
  if (app.question.then != Question::Then::nothing || app.dialog) return;
  try {
    if (!ImGui::GetIO().WantTextInput) handle_keys(app);
    if (!app.scene_open()) return;
    if (!ImGui::GetIO().WantTextInput) fly(app, seconds);
    handle_mouse(app);
  } catch (const std::exception& e) {
    app.complain(e.what());
  }
}

}  // namespace ssphh::viewer
