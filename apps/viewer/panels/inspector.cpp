#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "model/lengths.h"
#include "panels.h"

namespace ssphh::viewer {
namespace {

constexpr std::size_t most_shares = 6;

using Lines = std::vector<std::pair<std::string, std::string>>;  ///< what, and its value

std::string rgb(const vec3& v) {
  return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z);
}

std::string lengths(const vec3& v, float scale) {
  return fmt::format("{}  {}  {}", length_text(v.x, scale), length_text(v.y, scale), length_text(v.z, scale));
}

/// As many of the shares as there is room for in so many lines.
Lines lines_of(const Inspection& i, std::size_t most) {
  Lines lines;
  const auto line = [&](const char* what, std::string value) { lines.emplace_back(what, std::move(value)); };
  if (i.radiance) line("radiance [W/(sr m²)]", rgb(*i.radiance));
  if (i.truth) line("traced beside it", rgb(*i.truth));
  if (!i.surface) return line("surface", "none"), lines;
  const InspectedSurface& s = *i.surface;
  if (!i.light.shares.empty()) line("indirect irradiance [W/m²]", rgb(i.light.irradiance));
  line("diffuse albedo", rgb(s.albedo));
  line("normal", lengths(s.normal, 1));
  line("position [m]", lengths(s.position, s.distance));
  line("distance [m]", length_text(s.distance, s.distance));
  line("object", s.object);
  line("material", s.material);
  const std::size_t count = i.light.shares.size();
  const std::size_t left = std::max<std::size_t>(most, lines.size() + 2) - lines.size() - 1;
  const std::size_t shown = std::min({count, most_shares, left});
  for (std::size_t k = 0; k < shown; ++k) {
    const LightShare& share = i.light.shares[k];
    line(k > 0                ? ""
         : i.light.by_records ? "lit by records"
                              : "lit by probes",
         fmt::format("{:.1f} %  {}", 100 * share.weight, share.name));
  }
  if (count > shown) line("", fmt::format("and {} more", count - shown));
  return lines;
}

void draw_lines(const Lines& lines) {
  for (const auto& [what, value] : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", what.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
  }
}

/// Pixels of the window that holds them.
float width_of(const Lines& lines) {
  float what = 0, value = 0;
  for (const auto& [left, right] : lines) {
    what = std::max(what, ImGui::CalcTextSize(left.c_str()).x);
    value = std::max(value, ImGui::CalcTextSize(right.c_str()).x);
  }
  const ImGuiStyle& style = ImGui::GetStyle();
  return what + value + 2 * style.WindowPadding.x + 4 * style.CellPadding.x;
}

}  // namespace

void draw_inspector(App& app, const Rect2& room) {
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
  // On the side where the point is not; over the panels where the picture has no room for it.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float line = ImGui::GetTextLineHeight() + 2 * style.CellPadding.y;
  const float high = static_cast<float>(app.window.height()) - room.y - 20 - 2 * style.WindowPadding.y -
                     style.ItemSpacing.y - ImGui::GetTextLineHeight();
  const Lines lines = lines_of(*app.inspection, static_cast<std::size_t>(std::max(high / line, 1.0f)));
  const bool left = at.x > r.x + 0.5f * r.width && width_of(lines) + 20 < r.width;
  ImGui::SetNextWindowPos({left ? r.x + 10 : r.x + r.width - 10, room.y + 10}, ImGuiCond_Always,
                          {left ? 0.0f : 1.0f, 0});
  ImGui::SetNextWindowBgAlpha(1);
  ImGui::Begin("inspector", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  if (ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit)) {
    draw_lines(lines);
    ImGui::EndTable();
  }
  ImGui::TextDisabled(app.pinned ? "pinned; I ends" : "a click pins the point; I ends");
  ImGui::End();
}

}  // namespace ssphh::viewer
