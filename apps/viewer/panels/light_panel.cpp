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

/// One undo step per drag of a widget.
template <class Change>
void edit(App& app, const std::string& what, const Change& change) {
  app.document.edit(what, change);
  app.redraw();
}

void draw_lamp_list(App& app) {
  const std::vector<scene::Light>& lights = app.document.scene->lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    bool on = app.document.edits().lights[i].on;
    if (ImGui::Checkbox("##on", &on)) {
      app.document.history.seal();
      edit(app, fmt::format("switch {}", lights[i].name), [&](Edits& e) { e.lights[i].on = on; });
    }
    tip("on, off");
    ImGui::SameLine();
    const Selection self{Kind::light, static_cast<int>(i)};
    if (ImGui::Selectable(lights[i].name.c_str(), app.selection == self)) app.selection = self;
    ImGui::PopID();
  }
  if (lights.empty())
    note("The scene has no lamps; emissive surfaces and the environment are below, as groups.");
}

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
    if (color) edit(app, what, [&](Edits& e) { e.lights[i].color = *color; });
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
    edit(app, what, [&](Edits& e) { e.lights[i].color = color_of_kelvin(kelvin); });
  }
  seal_after_edit(app);
  tip("of the black body whose colour is nearest; changing it takes that colour, its largest channel 1");
}

void draw_lamp(App& app, std::size_t i) {
  const scene::Light& light = app.document.scene->lights[i];
  const LightEdit& now = app.document.edits().lights[i];
  const mat4 world = app.document.lighting().lights[i].world;
  heading(light.name.c_str());
  note(type_names[static_cast<std::size_t>(light.type)]);

  row("intensity");
  float intensity = now.intensity;
  const float fastest = std::max(0.02f * std::abs(intensity), 1e-3f);
  if (ImGui::DragFloat("##intensity", &intensity, fastest, 0, 1e6f, "%.3g"))
    edit(app, "dim " + light.name, [&](Edits& e) { e.lights[i].intensity = intensity; });
  seal_after_edit(app);

  row("colour");
  vec3 color = now.color;
  if (ImGui::ColorEdit3("##colour", glm::value_ptr(color),
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions))
    edit(app, "colour " + light.name, [&](Edits& e) { e.lights[i].color = color; });
  seal_after_edit(app);
  tip("linear Rec.709");
  draw_color_names(app, i);

  if (light.type != scene::LightType::directional) {
    row("position");
    vec3 position = light_position(world);
    if (ImGui::DragFloat3("##position", glm::value_ptr(position), 0.01f, 0, 0, "%.2f"))
      edit(app, "move " + light.name, [&](Edits& e) { e.lights[i].world = with_position(world, position); });
    seal_after_edit(app);
  }
  if (light.type == scene::LightType::spot || light.type == scene::LightType::directional ||
      light.type == scene::LightType::sphl) {
    row("direction");
    vec3 direction = light_direction(world);
    if (ImGui::DragFloat3("##direction", glm::value_ptr(direction), 0.01f, -1, 1, "%.2f") &&
        glm::length(direction) > 1e-3f)
      edit(app, "turn " + light.name,
           [&](Edits& e) { e.lights[i].world = with_direction(world, direction); });
    seal_after_edit(app);
  }
  if (now.world && ImGui::SmallButton("back to its own place")) {
    app.document.history.seal();
    edit(app, "put back " + light.name, [&](Edits& e) { e.lights[i].world.reset(); });
  }
}

void draw_groups(App& app) {
  heading("Light groups");
  for (const std::string& group : scene::light_groups(*app.document.scene)) {
    ImGui::PushID(group.c_str());
    const auto found = app.document.edits().groups.find(group);
    const vec3 scale = found == app.document.edits().groups.end() ? vec3(1) : found->second;
    float factor = max_component(scale);
    row(group.c_str());
    if (ImGui::SliderFloat("##factor", &factor, 0, 4, "× %.2f"))
      edit(app, "scale " + group, [&](Edits& e) { e.groups[group] = vec3(factor); });
    seal_after_edit(app);
    ImGui::PopID();
  }
  if (app.document.scene->environment) {
    row("environment turned");
    float turn = app.document.edits().environment_rotation;
    if (ImGui::SliderAngle("##turn", &turn, -180, 180, "%.0f°"))
      edit(app, "turn the environment", [&](Edits& e) { e.environment_rotation = turn; });
    seal_after_edit(app);
    tip("about the vertical, beyond the scene's own rotation");
  }
  note("Factors on lamps, emissive surfaces and the environment: probes of a bake follow them as well.");
}

}  // namespace

void draw_light_panel(App& app) {
  heading("Lamps");
  draw_lamp_list(app);
  if (app.selection.is(Kind::light)) draw_lamp(app, static_cast<std::size_t>(app.selection.index));
  draw_sky(app);
  draw_groups(app);
}

}  // namespace ssphh::viewer
