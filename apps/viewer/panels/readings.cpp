// How bright the picture is: its histogram, its waveform and the legend of false colours.

#include <algorithm>
#include <cmath>

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

constexpr const char* histogram_caption = "luminance, stops from middle grey";
constexpr const char* traced_caption = "white line: traced";
constexpr const char* waveform_caption = "red, green, blue over columns";

std::string beyond(const StopHistogram& h) {
  return fmt::format("darker: {:.1f} %, brighter: {:.1f} %", 100 * h.darker, 100 * h.brighter);
}

void draw_histogram(const App& app, const ImVec2& size) {
  const StopHistogram& h = *app.histogram;
  float most = 1e-6f;
  for (const StopHistogram* one : {&h, app.truth_histogram ? &*app.truth_histogram : nullptr})
    if (one) most = std::max(most, *std::ranges::max_element(one->bins));
  ImGui::TextUnformatted(histogram_caption);
  if (app.truth_histogram) ImGui::TextUnformatted(traced_caption);
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
  ImGui::TextUnformatted(beyond(h).c_str());
}

/// Red, green and blue beside each other over the picture's columns, bright is up.
void draw_waveform(const Waveform& shown, const ImVec2& size) {
  // A list of things to draw has room for as many corners as 16 bits count.
  static_assert(4 * 3 * waveform_columns * stop_bins < 60'000);
  ImGui::TextUnformatted(waveform_caption);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(30, 30, 32, 255));
  const float left = from.x + ImGui::CalcTextSize("+8").x + 6, gap = 4;
  const float wide = (from.x + size.x - left - 2 * gap) / 3;
  const float column = wide / waveform_columns, bin = size.y / static_cast<float>(stop_bins);
  const auto y_of = [&](float stop) {
    return from.y + size.y * (1 - (stop + farthest_stop + 0.5f) / stop_bands);
  };
  const float line = ImGui::GetTextLineHeight();
  for (int stop = -farthest_stop; stop <= farthest_stop; stop += 4) {
    const float y = y_of(static_cast<float>(stop));
    list.AddLine({left, y}, {from.x + size.x, y}, IM_COL32(255, 255, 255, 40));
    if (size.y < 5 * line && stop % 8 != 0) continue;
    list.AddText({from.x + 2, std::clamp(y - 0.5f * line, from.y, from.y + size.y - line)},
                 IM_COL32(200, 200, 205, 255), stop_text(stop).c_str());
  }
  const float white = y_of(stops_of(1, 0));
  list.AddLine({left, white}, {from.x + size.x, white}, IM_COL32(255, 255, 255, 150));
  const ImVec4 colors[] = {{1, 0.35f, 0.3f, 1}, {0.3f, 0.9f, 0.35f, 1}, {0.4f, 0.6f, 1, 1}};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < waveform_columns; ++i) {
      const float x = left + (wide + gap) * static_cast<float>(c) + column * static_cast<float>(i);
      for (std::size_t b = 0; b < stop_bins; ++b) {
        const float share = shown.channels[c][i][b];
        if (!(share > 0)) continue;
        ImVec4 color = colors[c];
        // A single pixel is seen, too.
        color.w = std::min(0.2f + std::sqrt(share), 1.0f);
        const float y = from.y + size.y - bin * static_cast<float>(b);
        list.AddRectFilled({x, y - bin}, {x + column, y}, ImGui::ColorConvertFloat4ToU32(color));
      }
    }
  }
}

constexpr float margin = 14;

/// Which plots there are, and the height of all that they say.
struct Plots {
  bool histogram = false, waveform = false;

  float text_height(const App& app, float width) const {
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto high = [&](const char* text) {
      return ImGui::CalcTextSize(text, nullptr, false, width).y + style.ItemSpacing.y;
    };
    float sum = 2 * style.WindowPadding.y;
    if (waveform) sum += high(waveform_caption) + style.ItemSpacing.y;
    if (histogram) sum += high(histogram_caption) + 2 * style.ItemSpacing.y + ImGui::GetTextLineHeight();
    if (histogram) sum += high(beyond(*app.histogram).c_str());
    if (histogram && app.truth_histogram) sum += high(traced_caption);
    return sum;
  }
};

/// Above each other, in the lower left corner; what there is no room for is left out, the waveform first.
/// Returns where they are.
Rect2 draw_plots(const App& app, const Rect2& room) {
  const float em = ImGui::GetFontSize(), lower = room.y + room.height - margin;
  const ImGuiStyle& style = ImGui::GetStyle();
  Plots plots{app.settings.histogram && app.histogram, app.settings.waveform && app.waveform};
  const float width = std::min(22 * em, room.width - 2 * (margin + style.WindowPadding.x));
  const auto height_of_one = [&] {
    const float free = room.height - 2 * margin - plots.text_height(app, width);
    return std::min(6 * em, free / static_cast<float>(plots.histogram + plots.waveform));
  };
  if (plots.histogram && plots.waveform && height_of_one() < 2 * em) plots.waveform = false;
  if (!(plots.histogram || plots.waveform) || height_of_one() < em) return {room.x, lower, 0, 0};
  const ImVec2 size{width, height_of_one()};
  ImGui::SetNextWindowPos({room.x + margin, lower}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("plots", nullptr, over_picture);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x);
  if (plots.waveform) draw_waveform(*app.waveform, size);
  if (plots.histogram) draw_histogram(app, size);
  ImGui::PopTextWrapPos();
  ImGui::End();
  const float all =
      plots.text_height(app, width) + size.y * static_cast<float>(plots.histogram + plots.waveform);
  return {room.x + margin, lower - all, width + 2 * style.WindowPadding.x, all};
}

/// In the upper right corner, above the plots where there is no room beside them, if it is enough.
void draw_legend(const App& app, const Rect2& r, const Rect2& plots) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float line = ImGui::GetTextLineHeight(), em = ImGui::GetFontSize();
  const float exposure = shown_tone(app.settings).exposure;
  const bool beside =
      plots.x + plots.width + 2 * margin + 9 * em + 2 * style.WindowPadding.x <= r.x + r.width;
  const float lower = beside ? r.y + r.height : plots.y;
  const float room = lower - r.y - 2 * margin - 2 * style.WindowPadding.y - line - 2 * style.ItemSpacing.y;
  if (room < 4 * stop_bands) return;
  ImGui::SetNextWindowPos({r.x + r.width - margin, r.y + margin}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("legend", nullptr, over_picture);
  ImGui::TextUnformatted("stops   W/(sr m²)");
  // Every other number where there is no room for all
  const float tall = std::min(room / stop_bands, line);
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

void draw_readings(App& app, const Rect2& room) {
  if (!app.scene_open()) return;
  const Rect2 plots = draw_plots(app, room);
  if (app.settings.false_color) draw_legend(app, room, plots);
}

}  // namespace ssphh::viewer
