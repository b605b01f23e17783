#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

/// Of an emitter that is turned off [W/(sr m²)]: without any it would leave its light group.
constexpr float least_emission = 1e-6f;

template <class Change>
void edit(App& app, std::size_t i, const Change& change) {
  app.document.edit("material " + app.document.edits().materials[i].name,
                    [&](Edits& e) { change(e.materials[i]); });
  app.redraw();
}

void slider(App& app, std::size_t i, const char* label, float scene::Material::*member, float low, float high,
            const char* help) {
  float value = app.document.edits().materials[i].*member;
  row(label);
  ImGui::PushID(label);
  if (ImGui::SliderFloat("##value", &value, low, high, "%.2f"))
    edit(app, i, [&](scene::Material& m) { m.*member = value; });
  seal_after_edit(app);
  tip(help);
  ImGui::PopID();
}

void draw_material(App& app, std::size_t i) {
  const scene::Material& material = app.document.edits().materials[i];
  heading(material.name.empty() ? "(no name)" : material.name.c_str());
  row("base colour");
  vec3 color = material.base_color;
  if (ImGui::ColorEdit3("##base", glm::value_ptr(color),
                        ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions))
    edit(app, i, [&](scene::Material& m) { m.base_color = color; });
  seal_after_edit(app);
  slider(app, i, "metallic", &scene::Material::metallic, 0, 1, "0: dielectric, 1: metal");
  slider(app, i, "specular", &scene::Material::specular, 0, 1, "weight of a dielectric's specular lobe");
  slider(app, i, "specular rough.", &scene::Material::specular_roughness, -1, 1,
         "bipolar: below 0 Blinn-Phong of its magnitude, above 0 GGX");
  slider(app, i, "diffuse rough.", &scene::Material::diffuse_roughness, -1, 1,
         "bipolar: below 0 Oren-Nayar of its magnitude, 0 Lambert, above 0 Disney diffuse");
  if (!material.emissive()) return;
  row("emission");
  vec3 emission = material.emission;
  if (ImGui::DragFloat3("##emission", glm::value_ptr(emission),
                        std::max(0.02f * max_component(emission), 0.01f), 0, 1e6f, "%.4g"))
    edit(app, i, [&](scene::Material& m) {
      m.emission = max_component(emission) > 0 ? glm::max(emission, vec3(0)) : vec3(least_emission);
    });
  seal_after_edit(app);
  tip("radiance, W/(sr m²); an emitter stays one: at least a little of it is kept, too little to be seen");
}

}  // namespace

void draw_surface_panel(App& app) {
  heading("Materials");
  const std::vector<scene::Material>& materials = app.document.edits().materials;
  ImGui::BeginChild("list", {0, 12 * ImGui::GetTextLineHeightWithSpacing()}, true);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const vec3 c = glm::clamp(glm::pow(materials[i].base_color, vec3(1 / 2.2f)), vec3(0), vec3(1));
    ImGui::ColorButton("##chip", {c.x, c.y, c.z, 1}, ImGuiColorEditFlags_NoTooltip, {14, 14});
    ImGui::SameLine();
    const Selection self{Kind::material, static_cast<int>(i)};
    const std::string label = materials[i].name.empty() ? fmt::format("material {}", i) : materials[i].name;
    if (ImGui::Selectable(label.c_str(), app.selection.material() == self.index)) app.select(self);
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (app.selection.material() >= 0) {
    draw_material(app, static_cast<std::size_t>(app.selection.material()));
    note("Live probes find their light anew once a change is done; textures multiply these values.");
  } else {
    note("Choose a material to change it, here or by a click on a surface.");
  }
}

}  // namespace ssphh::viewer
