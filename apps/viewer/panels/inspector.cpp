#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"

namespace ssphh::viewer {
namespace {

constexpr std::size_t shown_shares = 6;

void line(const char* what, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

std::string rgb(const vec3& v) {
  return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z);
}

void draw_values(const Inspection& i) {
  if (i.radiance) line("radiance [W/(sr m²)]", rgb(*i.radiance));
  if (i.truth) line("traced beside it", rgb(*i.truth));
  if (!i.surface) return line("surface", "none");
  const InspectedSurface& s = *i.surface;
  if (!i.light.shares.empty()) line("indirect irradiance [W/m²]", rgb(i.light.irradiance));
  line("diffuse albedo", rgb(s.albedo));
  line("normal", fmt::format("{:.3f}  {:.3f}  {:.3f}", s.normal.x, s.normal.y, s.normal.z));
  line("position [m]", fmt::format("{:.3f}  {:.3f}  {:.3f}", s.position.x, s.position.y, s.position.z));
  line("distance [m]", fmt::format("{:.3f}", s.distance));
  line("object", s.object);
  line("material", s.material);
  for (std::size_t k = 0; k < std::min(i.light.shares.size(), shown_shares); ++k) {
    const LightShare& share = i.light.shares[k];
    line(k > 0                ? ""
         : i.light.by_records ? "lit by records"
                              : "lit by probes",
         fmt::format("{:.1f} %  {}", 100 * share.weight, share.name));
  }
  if (i.light.shares.size() > shown_shares)
    line("", fmt::format("and {} more", i.light.shares.size() - shown_shares));
}

}  // namespace

void draw_inspector(App& app) {
  if (!app.inspecting || !app.scene_open()) return;
  const Rect2& r = app.viewport;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool over = !ImGui::GetIO().WantCaptureMouse && r.contains(mouse.x, mouse.y);
  if (app.pinned) {
    app.inspect(*app.pinned);
  } else if (over) {
    app.inspect({(mouse.x - r.x) / r.width, 1 - (mouse.y - r.y) / r.height});
  }
  if (!app.inspection) return;
  const vec2 p = app.inspection->point;
  const ImVec2 at{r.x + p.x * r.width, r.y + (1 - p.y) * r.height};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircle(at, 6, IM_COL32(0, 0, 0, 200), 0, 3);
  list.AddCircle(at, 6, app.pinned ? IM_COL32(255, 190, 80, 255) : IM_COL32(255, 255, 255, 220), 0, 1.5f);
  // On the side where the point is not.
  const bool left = at.x > r.x + 0.5f * r.width;
  ImGui::SetNextWindowPos({left ? r.x + 10 : r.x + r.width - 10, r.y + 10}, ImGuiCond_Always,
                          {left ? 0.0f : 1.0f, 0});
  ImGui::SetNextWindowBgAlpha(0.88f);
  ImGui::Begin("inspector", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  if (ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit)) {
    draw_values(*app.inspection);
    ImGui::EndTable();
  }
  ImGui::TextDisabled(app.pinned ? "pinned; I ends" : "a click pins the point; I ends");
  ImGui::End();
}

}  // namespace ssphh::viewer
