// How bright the picture is: its histogram and the legend of false colours.

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

constexpr ImGuiWindowFlags over_picture =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
    ImGuiWindowFlags_NoFocusOnAppearing;

ImU32 packed(const std::array<std::uint8_t, 3>& c) {
  return IM_COL32(c[0], c[1], c[2], 255);
}

/// One line of bins, each as wide as a stop's part of the width; as a line, or filled in the bands' colours.
void draw_bins(const StopHistogram& h, const ImVec2& from, const ImVec2& size, float most, bool filled) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto count = static_cast<int>(h.bins.size());
  const float step = size.x / static_cast<float>(count);
  float before = 0;
  for (int i = 0; i < count; ++i) {
    const float tall = size.y * std::min(h.bins[i] / most, 1.0f);
    const float x = from.x + step * static_cast<float>(i), y = from.y + size.y;
    if (filled && tall > 0)
      list.AddRectFilled({x, y - tall}, {x + step, y},
                         packed(color_of_stop(i / bins_per_stop - farthest_stop)));
    if (!filled) {
      list.AddLine({x, y - before}, {x, y - tall}, IM_COL32_WHITE);
      list.AddLine({x, y - tall}, {x + step, y - tall}, IM_COL32_WHITE);
    }
    before = tall;
  }
}

void draw_histogram(const App& app) {
  const float em = ImGui::GetFontSize();
  const Rect2& r = app.viewport;
  const ImVec2 size{std::min(22 * em, 0.8f * r.width), 6 * em};
  ImGui::SetNextWindowPos({r.x + 14, r.y + r.height - 14}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("histogram", nullptr, over_picture);
  const StopHistogram& h = *app.histogram;
  float most = 1e-6f;
  for (const StopHistogram* one : {&h, app.truth_histogram ? &*app.truth_histogram : nullptr})
    if (one) most = std::max(most, *std::ranges::max_element(one->bins));
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x);
  ImGui::TextUnformatted("luminance, stops from middle grey");
  if (app.truth_histogram) ImGui::TextUnformatted("white line: traced");
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(30, 30, 32, 255));
  draw_bins(h, from, size, most, true);
  if (app.truth_histogram) draw_bins(*app.truth_histogram, from, size, most, false);
  // The scale below, and the picture's white
  const auto x_of = [&](float stop) { return from.x + size.x * (stop + farthest_stop + 0.5f) / stop_bands; };
  const float white = x_of(stops_of(1, 0));
  list.AddLine({white, from.y}, {white, from.y + size.y}, IM_COL32(255, 255, 255, 150));
  list.AddText({white - 3 - ImGui::CalcTextSize("white").x, from.y + 1}, IM_COL32(255, 255, 255, 150),
               "white");
  const float y = ImGui::GetCursorScreenPos().y;
  for (int stop = -farthest_stop; stop <= farthest_stop; stop += 4) {
    const std::string text = stop_text(stop);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const float middle = x_of(static_cast<float>(stop)) - 0.5f * width;
    list.AddText({std::clamp(middle, from.x, from.x + size.x - width), y}, IM_COL32(200, 200, 205, 255),
                 text.c_str());
  }
  ImGui::Dummy({size.x, ImGui::GetTextLineHeight()});
  ImGui::TextUnformatted(
      fmt::format("darker: {:.1f} %, brighter: {:.1f} %", 100 * h.darker, 100 * h.brighter).c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void draw_legend(const App& app) {
  const Rect2& r = app.viewport;
  const float line = ImGui::GetTextLineHeight(), em = ImGui::GetFontSize();
  const float exposure = shown_tone(app.settings).exposure;
  ImGui::SetNextWindowPos({r.x + r.width - 14, r.y + 14}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("legend", nullptr, over_picture);
  ImGui::TextUnformatted("stops   W/(sr m²)");
  // Every other number where there is no room for all
  const float room = r.height - 28 - 2 * ImGui::GetStyle().WindowPadding.y - 2 * line;
  const float tall = std::clamp(room / stop_bands, 4.0f, line);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const int every = tall >= line ? 1 : tall * 2 >= line ? 2 : 4;
  for (int stop = farthest_stop; stop >= -farthest_stop; --stop) {
    const float y = from.y + tall * static_cast<float>(farthest_stop - stop);
    list.AddRectFilled({from.x, y}, {from.x + 1.5f * em, y + tall}, packed(color_of_stop(stop)));
    if (stop % every != 0) continue;
    const float text_y = y + 0.5f * (tall - line);
    list.AddText({from.x + 2 * em, text_y}, IM_COL32_WHITE, stop_text(stop).c_str());
    list.AddText({from.x + 4.2f * em, text_y}, IM_COL32(200, 200, 205, 255),
                 fmt::format("{:.3g}", luminance_at(static_cast<float>(stop), exposure)).c_str());
  }
  ImGui::Dummy({9 * em, tall * stop_bands});
  ImGui::End();
}

}  // namespace

void draw_readings(App& app) {
  if (!app.scene_open()) return;
  if (app.settings.histogram && app.histogram) draw_histogram(app);
  if (app.settings.false_color) draw_legend(app);
}

}  // namespace ssphh::viewer
