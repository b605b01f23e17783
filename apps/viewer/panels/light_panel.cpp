#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

void draw_lamp_buttons(App& app) {
  if (ImGui::Button("Add…")) ImGui::OpenPopup("kinds");
  tip("a lamp off the surface in the middle of the picture");
  if (ImGui::BeginPopup("kinds")) {
    draw_lamp_kinds(app);
    ImGui::EndPopup();
  }
  if (!app.selection.is(Kind::light)) return;
  beside("Duplicate");
  if (ImGui::Button("Duplicate")) app.duplicate_lamp();
  tip("Ctrl+D");
  beside("Delete");
  if (ImGui::Button("Delete")) app.delete_selection();
  tip("Delete; undo brings the lamp back");
}

void draw_lamp_list(App& app) {
  const std::vector<scene::Light>& lights = app.document.scene->lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    bool on = app.document.edits().lights[i].on;
    if (ImGui::Checkbox("##on", &on)) {
      app.document.history.seal();
      app.edit(fmt::format("switch {}", lights[i].name), [&](Edits& e) { e.lights[i].on = on; });
    }
    tip("on, off");
    ImGui::SameLine();
    const Selection self{Kind::light, static_cast<int>(i)};
    if (ImGui::Selectable(lights[i].name.c_str(), app.selection == self)) app.selection = self;
    ImGui::PopID();
  }
  if (lights.empty())
    note("The scene has no lamps; emissive surfaces and the environment are below, as groups.");
  draw_lamp_buttons(app);
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
      app.edit("scale " + group, [&](Edits& e) { e.groups[group] = vec3(factor); });
    seal_after_edit(app);
    ImGui::PopID();
  }
  note("Factors on lamps, emissive surfaces and the environment: probes of a bake follow them as well.");
}

/// What surrounds the scene: turned, or another picture.
void draw_surroundings(App& app) {
  const std::optional<Surroundings> around = app.document.edits().surroundings;
  heading("Surroundings");
  if (around) note(std::filesystem::path(around->file).filename().string());
  if (app.document.scene->environment) {
    row("environment turned");
    float turn = app.document.edits().environment_rotation;
    if (ImGui::SliderAngle("##turn", &turn, -180, 180, "%.0f°"))
      app.edit("turn the environment", [&](Edits& e) { e.environment_rotation = turn; });
    seal_after_edit(app);
    tip("about the vertical, beyond the scene's own rotation");
  }
  if (ImGui::Button("Sky from a picture…")) app.ask_for_file(FileDialog::For::sky);
  tip("An equirectangular .hdr or .exr; one that is dropped on the window does the same.");
  if (!around) return;
  beside("The scene's own");
  if (ImGui::Button("The scene's own")) attempt(app, [&] { app.take_surroundings({}); });
}

}  // namespace

void draw_lamp_kinds(App& app) {
  constexpr std::pair<const char*, scene::LightType> kinds[] = {
      {"Point", scene::LightType::point},           {"Spot, with a cone", scene::LightType::spot},
      {"Sun", scene::LightType::directional},       {"Sphere", scene::LightType::sphere},
      {"Rectangle", scene::LightType::rectangle},   {"Disc", scene::LightType::disc},
      {"SPHL, a soft beam", scene::LightType::sphl}};
  for (const auto& [name, type] : kinds) {
    if (ImGui::MenuItem(name)) attempt(app, [&app, type = type] { app.add_lamp(type); });
  }
}

void draw_light_panel(App& app) {
  heading("Lamps");
  draw_lamp_list(app);
  if (app.selection.is(Kind::light)) draw_lamp(app);
  draw_sky(app);
  draw_surroundings(app);
  draw_groups(app);
}

}  // namespace ssphh::viewer
