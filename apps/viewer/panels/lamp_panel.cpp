// The lamp that is selected: all that it has, as numbers, colours and a direction.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "model/lamp_color.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Of the types of lamps, in their order.
constexpr const char* type_names[] = {"point, W/sr", "spot, W/sr", "directional, W/m²", "sphere, W/(sr m²)",
                                      "SPHL, times its emission"};

/// The same colour by its digits, and by its temperature.
void draw_color_names(App& app, std::size_t i) {
  const std::string what = "colour " + app.document.scene->lights[i].name;
  const vec3 now = app.document.edits().lights[i].color;
  row("sRGB");
  char text[16] = "";
  hex_of(now).copy(text, sizeof text - 1);
  if (ImGui::InputText("##hex", text, sizeof text,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll)) {
    const auto color = color_of_hex(text);
    if (!color) app.complain(fmt::format("\"{}\" is no colour like #ffe0b0", text));
    app.document.history.seal();
    if (color) app.edit(what, [&](Edits& e) { e.lights[i].color = *color; });
    app.document.history.seal();
  }
  tip("in hexadecimal digits, as #ffe0b0; Enter takes it");
  row("temperature");
  // What was chosen last is kept exactly, so that a drag goes on from it.
  static float chosen = 6500;
  const float was = now == color_of_kelvin(chosen) ? chosen : kelvin_of(now).value_or(6500);
  float kelvin = was;
  ImGui::DragFloat("##kelvin", &kelvin, 20, least_kelvin, most_kelvin, "%.0f K",
                   ImGuiSliderFlags_AlwaysClamp);
  if (kelvin != was) {
    chosen = kelvin;
    app.edit(what, [&](Edits& e) { e.lights[i].color = color_of_kelvin(kelvin); });
  }
  seal_after_edit(app);
  tip("of the black body whose colour is nearest; changing it takes that colour, its largest channel 1");
}

void draw_name(App& app, std::size_t i) {
  row("name");
  const std::string now = app.document.edits().lights[i].lamp.name;
  char text[128] = "";
  now.copy(text, sizeof text - 1);
  if (!ImGui::InputText("##name", text, sizeof text,
                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
    return;
  attempt(app,
          [&] { app.document.edit_at_once("rename " + now, [&](Edits& e) { rename_lamp(e, i, text); }); });
}

/// Numbers that are typed beyond their bounds are refused; drags end there.
void draw_numbers(App& app, std::size_t i) {
  const LightEdit now = app.document.edits().lights[i];
  for (const LampNumber& number : lamp_numbers(now)) {
    const std::string name = number.name;
    row(number.name);
    float value = number.value;
    const bool endless = name == "range" && value == 0;
    const std::string format = endless                           ? "no limit"
                               : number.unit == std::string("°") ? "%.1f°"
                                                                 : fmt::format("%.4g {}", number.unit);
    const float fastest = std::max(0.02f * std::abs(value), number.step);
    ImGui::PushID(number.name);
    if (ImGui::DragFloat("##value", &value, fastest, number.low, number.high, format.c_str())) {
      attempt(app, [&] {
        LightEdit next = now;
        set_lamp_number(next, name, value);
        app.edit(fmt::format("{} of {}", name, now.lamp.name), [&](Edits& e) { e.lights[i] = next; });
      });
    }
    seal_after_edit(app);
    tip(number.help);
    ImGui::PopID();
  }
}

}  // namespace

void draw_lamp(App& app) {
  const auto i = static_cast<std::size_t>(app.selection.index);
  const scene::Light light = app.document.scene->lights[i];
  const LightEdit now = app.document.edits().lights[i];
  const mat4 world = app.document.lighting().lights[i].world;
  heading(light.name.c_str());
  note(type_names[static_cast<int>(light.type)]);

  draw_name(app, i);
  draw_numbers(app, i);

  row("colour");
  vec3 color = now.color;
  if (ImGui::ColorEdit3("##colour", glm::value_ptr(color),
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions))
    app.edit("colour " + light.name, [&](Edits& e) { e.lights[i].color = color; });
  seal_after_edit(app);
  tip("linear Rec.709");
  draw_color_names(app, i);

  if (has_place(light.type)) {
    row("position");
    vec3 position = light_position(world);
    if (ImGui::DragFloat3("##position", glm::value_ptr(position), 0.01f, 0, 0, "%.2f"))
      app.edit("move " + light.name, [&](Edits& e) { e.lights[i].world = with_position(world, position); });
    seal_after_edit(app);
  }
  if (has_direction(light.type)) {
    row("direction");
    vec3 direction = light_direction(world);
    if (ImGui::DragFloat3("##direction", glm::value_ptr(direction), 0.01f, -1, 1, "%.2f") &&
        glm::length(direction) > 1e-3f)
      app.edit("turn " + light.name, [&](Edits& e) { e.lights[i].world = with_direction(world, direction); });
    seal_after_edit(app);
    if (ImGui::Button(app.aim_mode ? "click a surface …" : "Aim (X)")) app.aim_mode = !app.aim_mode;
    tip(has_place(light.type) ? "at what you click next; the amber handle in the picture aims, too"
                              : "at the place of the sky that you click next, or straight on a surface");
  }
  if (now.source >= 0 && now.world && ImGui::SmallButton("back to its own place")) {
    app.document.history.seal();
    app.edit("put back " + light.name, [&](Edits& e) { e.lights[i].world.reset(); });
  }
}

}  // namespace ssphh::viewer
