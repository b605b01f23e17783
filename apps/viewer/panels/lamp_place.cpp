// Where the selected lamp stands and shines, as numbers, and in which steps it is dragged.

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "model/lamp_aim.h"
#include "model/lengths.h"
#include "model/ring.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_position(App& app, std::size_t i, const mat4& world) {
  row("position");
  const Lengths lengths = lengths_of(app.document.bounds);
  vec3 position = light_position(world);
  if (ImGui::DragFloat3("##position", glm::value_ptr(position), lengths.step, 0, 0,
                        length_format(lengths.decimals)))
    app.edit("move " + app.document.scene->lights[i].name,
             [&](Edits& e) { e.lights[i].world = with_position(world, position); });
  seal_after_edit(app);
}

void draw_direction(App& app, std::size_t i, const mat4& world) {
  const Lamp& lamp = app.document.edits().lights[i].lamp;
  const std::string what = "turn " + lamp.name;
  const auto aim = [&](const vec3& direction) {
    app.edit(what, [&](Edits& e) { e.lights[i].world = aimed(e.lights[i].lamp, world, direction); });
  };
  row("direction");
  vec3 direction = light_direction(world);
  if (ImGui::DragFloat3("##direction", glm::value_ptr(direction), 0.01f, -1, 1, "%.2f") &&
      glm::length(direction) > 1e-3f)
    aim(direction);
  seal_after_edit(app);
  row("pan, tilt");
  PanTilt angles = pan_tilt_of(light_direction(world));
  if (ImGui::DragFloat2("##angles", &angles.pan, 0.5f, 0, 0, "%.1f°")) {
    angles.tilt = std::clamp(angles.tilt, -90.0f, 90.0f);
    aim(direction_of(angles));
  }
  seal_after_edit(app);
  tip("Degrees to the left of −z, seen from above, and above the horizon: −90 is straight down.");
  if (!has_turn(lamp)) return;
  row("turn");
  const float before = glm::degrees(turn_of(world));
  float turn = before;
  ImGui::DragFloat("##turn", &turn, 0.5f, -180, 180, "%.1f°", ImGuiSliderFlags_AlwaysClamp);
  if (turn != before)
    app.edit(what, [&](Edits& e) { e.lights[i].world = with_turn(world, glm::radians(turn)); });
  seal_after_edit(app);
  tip("about its aim, counter-clockwise seen from behind the lamp");
}

void draw_snapping(App& app) {
  Settings& s = app.settings;
  const Lengths lengths = lengths_of(app.document.bounds);
  if (tick_row("snap", &s.snap)) app.redraw();
  tip("Handles and rings go in steps, and freely with Ctrl; without the tick Ctrl makes them go in steps.");
  row("steps [m], [°]");
  float steps[2] = {s.snap_step > 0 ? s.snap_step : snap_step(lengths), s.snap_angle};
  ImGui::PushItemWidth(0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemInnerSpacing.x));
  if (ImGui::DragFloat("##step", &steps[0], std::max(0.02f * steps[0], 1e-6f), 1e-6f, 1e6f, "%.4g",
                       ImGuiSliderFlags_AlwaysClamp))
    s.snap_step = steps[0];
  tip("Places are whole multiples of this step along each axis of the world.");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::DragFloat("##angle", &steps[1], 0.5f, 0.1f, 180, "%.4g°", ImGuiSliderFlags_AlwaysClamp))
    s.snap_angle = steps[1];
  tip("Rings turn by whole multiples of this angle, and the amber handle aims at whole multiples of pan and "
      "tilt.");
  ImGui::PopItemWidth();
}

}  // namespace

void draw_lamp_place(App& app, std::size_t i) {
  const Lamp lamp = app.document.edits().lights[i].lamp;
  const mat4 world = app.document.lighting().lights[i].world;
  const bool placed = has_place(lamp.type), directed = has_direction(lamp.type, lamp.profile);
  if (placed) draw_position(app, i, world);
  if (directed) {
    draw_direction(app, i, world);
    if (ImGui::Button(app.aim_mode ? "click a surface …" : "Aim (X)")) app.aim_mode = !app.aim_mode;
    tip(placed ? "at what you click next; the amber handle in the picture aims, too"
               : "at the place of the sky that you click next, or straight on a surface");
  }
  draw_snapping(app);
}

}  // namespace ssphh::viewer
