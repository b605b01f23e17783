#include <algorithm>

#include <imgui.h>

#include "app.h"
#include "input.h"
#include "panels.h"

namespace ssphh::viewer {

/// As large as its text, within the window: what is said of a key wraps, and the list scrolls.
void draw_help(App& app) {
  if (!app.help) return;
  const auto width = static_cast<float>(app.window.width()), height = static_cast<float>(app.window.height());
  const ImGuiStyle& style = ImGui::GetStyle();
  int count = 0;
  const Shortcut* list = shortcuts(count);
  float keys = 0, what = 0;
  for (int i = 0; i < count; ++i) {
    keys = std::max(keys, ImGui::CalcTextSize(list[i].keys).x);
    what = std::max(what, ImGui::CalcTextSize(list[i].what).x);
  }
  const float around = 2 * style.WindowPadding.x, gap = 4 * style.CellPadding.x;
  keys = std::min(keys, 0.45f * (width - around));
  what = std::min(what, 0.96f * width - around - gap - keys - style.ScrollbarSize);
  float lines = 0;
  for (int i = 0; i < count; ++i) {
    lines += std::max(ImGui::CalcTextSize(list[i].keys, nullptr, false, keys).y,
                      ImGui::CalcTextSize(list[i].what, nullptr, false, what).y) +
             2 * style.CellPadding.y;
  }
  const float tall = std::min(lines + 2 * style.WindowPadding.y, 0.96f * height);
  const float scrollbar = tall < lines + 2 * style.WindowPadding.y ? style.ScrollbarSize : 0;
  const Rect2& r = app.area;
  const ImVec2 size{keys + what + gap + around + scrollbar, tall};
  // Over the picture where that has room for it.
  const bool beside = size.x <= r.width && size.y <= r.height;
  ImGui::SetNextWindowPos(
      {beside ? r.x + 0.5f * r.width : 0.5f * width, beside ? r.y + 0.5f * r.height : 0.5f * height},
      ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowBgAlpha(0.93f);
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keys);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
    for (int i = 0; i < count; ++i) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.95f, 0.72f, 0.38f, 1));
      ImGui::TextWrapped("%s", list[i].keys);
      ImGui::PopStyleColor();
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", list[i].what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace ssphh::viewer
