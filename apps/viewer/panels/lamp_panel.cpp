// The lamp that is selected: all that it has, as numbers, colours and a direction.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "model/lamp_color.h"
#include "model/lamp_profile.h"
#include "model/lengths.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Of the types of lamps, in their order.
constexpr const char* type_names[] = {"point, W/sr",
                                      "spot, W/sr",
                                      "directional, W/m²",
                                      "sphere, W/(sr m²)",
                                      "SPHL, times its emission",
                                      "rectangle, W/(sr m²)",
                                      "disc, W/(sr m²)"};

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
    const float least = number.step > 0 ? number.step : 0.1f * lengths_of(app.document.bounds).step;
    const float fastest = std::max(0.02f * std::abs(value), least);
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

/// Polar curves of a profile, its aim pointing down: the plane of the lamp's x axis, and thinner that of its
/// y.
void draw_curves(const scene::LampProfile& profile) {
  const float em = ImGui::GetFontSize(), side = std::min(11 * em, ImGui::GetContentRegionAvail().x);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::Dummy({side, side});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle{from.x + 0.5f * side, from.y + 0.5f * side};
  const float radius = 0.48f * side;
  const ImU32 grid = ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.5f);
  for (const float share : {0.5f, 1.0f}) list.AddCircle(middle, share * radius, grid, 48);
  list.AddLine({middle.x - radius, middle.y}, {middle.x + radius, middle.y}, grid);
  list.AddLine({middle.x, middle.y - radius}, {middle.x, middle.y + radius}, grid);
  const auto draw = [&](float turn, ImU32 color, float thickness) {
    std::vector<ImVec2> line;
    for (const vec3& p : profile_curve(profile, turn))
      line.push_back({middle.x + radius * (turn == 0 ? p.x : p.y), middle.y - radius * p.z});
    list.AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, thickness);
  };
  draw(pi / 2, ImGui::GetColorU32(ImGuiCol_Text, 0.5f), 1);
  draw(0, ImGui::GetColorU32(ImGuiCol_PlotLinesHovered), 2);
}

void draw_profile(App& app, std::size_t i) {
  const LightEdit now = app.document.edits().lights[i];
  const scene::LampProfile& profile = now.lamp.profile;
  row("profile");
  const std::string label = (profile.empty()        ? "choose .ies…"
                             : profile.name.empty() ? "(unnamed)"
                                                    : profile.name) +
                            "##profile";
  if (ImGui::Button(label.c_str())) app.ask_for_file(FileDialog::For::profile);
  tip("a photometric file (IES LM-63) of the luminaire, scaled to the lamp's intensity; one that is dropped "
      "on the "
      "window does the same");
  if (profile.empty()) return;
  draw_curves(profile);
  tip("intensity by direction, the aim pointing down: bright in the plane of the lamp's x axis, grey across");
  const float candela = scene::greatest_candela(*profile.table);
  if (ImGui::SmallButton(fmt::format("as measured: {:g} cd", candela).c_str()))
    app.document.edit_at_once("intensity of " + now.lamp.name,
                              [&](Edits& e) { e.lights[i].intensity = candela; });
  tip("the file's own intensity in its brightest direction, a candela read as 1 W/sr");
  beside("without");
  if (ImGui::SmallButton("without")) attempt(app, [&] { app.set_lamp_profile(i, {}); });
  tip("shines alike in all directions again");
}

}  // namespace

void draw_lamp(App& app) {
  const auto i = static_cast<std::size_t>(app.selection.index);
  const scene::Light light = app.document.scene->lights[i];
  const LightEdit now = app.document.edits().lights[i];
  heading(light.name.c_str());
  note(type_names[static_cast<int>(light.type)]);

  draw_name(app, i);
  draw_numbers(app, i);

  if (light.type == scene::LightType::point || light.type == scene::LightType::spot) draw_profile(app, i);

  row("colour");
  vec3 color = now.color;
  if (ImGui::ColorEdit3("##colour", glm::value_ptr(color),
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions))
    app.edit("colour " + light.name, [&](Edits& e) { e.lights[i].color = color; });
  seal_after_edit(app);
  tip("linear Rec.709");
  draw_color_names(app, i);

  draw_lamp_place(app, i);
  if (now.source >= 0 && now.world && ImGui::SmallButton("back to its own place")) {
    app.document.history.seal();
    app.edit("put back " + light.name, [&](Edits& e) { e.lights[i].world.reset(); });
  }
}

}  // namespace ssphh::viewer
