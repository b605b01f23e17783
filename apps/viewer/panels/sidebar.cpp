// The panels beside the picture: their names above, one of them below, and an edge that the mouse moves.

#include <algorithm>
#include <iterator>
#include <span>

#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

constexpr struct {
  const char* name;
  void (*draw)(App&);
} tabs[] = {{"Light", draw_light_panel},   {"Probes", draw_probe_panel},    {"Surfaces", draw_surface_panel},
            {"Camera", draw_camera_panel}, {"Picture", draw_picture_panel}, {"Times", draw_stats_panel},
            {"Scene", draw_scene_panel},   {"Farm", draw_farm_panel}};

/// Of a farm there is nothing to tell where there is none.
std::size_t tab_count(const App& app) {
  return std::size(tabs) - (app.farm ? 0 : 1);
}

/// By the size of the text, so that words have room however dense the screen is; the picture keeps a share.
float panel_width(const App& app, float window) {
  const float em = ImGui::GetFontSize();
  const float usual = std::max(std::min(29 * em, 0.4f * window), std::min(20 * em, 0.6f * window));
  const float wanted = app.side_width > 0 ? app.side_width * em : usual;
  return std::clamp(wanted, std::min(12 * em, 0.6f * window), 0.75f * window);
}

float tab_width(std::size_t i) {
  return ImGui::CalcTextSize(tabs[i].name).x + 2 * ImGui::GetStyle().FramePadding.x;
}

/// As many in each row as lets whole words fit.
std::size_t tabs_in_a_row(std::size_t count, float room, float gap) {
  for (std::size_t rows = 1; rows < count; ++rows) {
    const std::size_t in_a_row = (count + rows - 1) / rows;
    float widest = 0;
    for (std::size_t first = 0; first < count; first += in_a_row) {
      float width = -gap;
      for (std::size_t i = first; i < std::min(first + in_a_row, count); ++i) width += tab_width(i) + gap;
      widest = std::max(widest, width);
    }
    if (widest <= room) return in_a_row;
  }
  return 1;
}

void draw_tabs(App& app) {
  const float gap = 0.5f * ImGui::GetStyle().ItemSpacing.x;
  const std::size_t in_a_row = tabs_in_a_row(tab_count(app), ImGui::GetContentRegionAvail().x, gap);
  for (std::size_t i = 0; i < tab_count(app); ++i) {
    const auto& tab = tabs[i];
    if (i % in_a_row != 0) ImGui::SameLine(0, gap);
    const bool front = app.open_tab == tab.name;
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(front ? ImGuiCol_TabActive : ImGuiCol_Tab));
    if (ImGui::Button(tab.name)) app.open_tab = tab.name;
    ImGui::PopStyleColor();
    if (front)
      ImGui::GetWindowDrawList()->AddRectFilled({ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y - 2},
                                                ImGui::GetItemRectMax(),
                                                ImGui::GetColorU32(ImGuiCol_CheckMark));
  }
  ImGui::Separator();
}

/// The panels' right edge; a double click brings the usual width back.
void draw_edge(App& app, float width, float height) {
  const float grip = 0.6f * ImGui::GetStyle().WindowPadding.x;
  const ImVec2 corner = ImGui::GetWindowPos();
  ImGui::PushClipRect(corner, {corner.x + width, corner.y + height}, false);
  ImGui::SetCursorPos({width - grip, 0});
  ImGui::InvisibleButton("edge", {grip, height});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled({width - 2, ImGui::GetItemRectMin().y}, ImGui::GetItemRectMax(),
                                              ImGui::GetColorU32(ImGuiCol_CheckMark));
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    app.side_width = 0;
  } else if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0) {
    app.side_width = ImGui::GetIO().MousePos.x / ImGui::GetFontSize();
  }
  ImGui::PopClipRect();
}

}  // namespace

float draw_sidebar(App& app, float y, float height) {
  const float width = panel_width(app, static_cast<float>(app.window.width()));
  ImGui::SetNextWindowPos({0, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin("side", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  draw_tabs(app);
  for (const auto& tab : std::span(tabs).first(tab_count(app))) {
    if (app.open_tab != tab.name) continue;
    // Each keeps its place of scrolling.
    ImGui::BeginChild(tab.name);
    app.scene_open() ? tab.draw(app) : note("No scene is open. Drop a file on the window.");
    ImGui::EndChild();
  }
  draw_edge(app, width, height);
  ImGui::End();
  return width;
}

}  // namespace ssphh::viewer
