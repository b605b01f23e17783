#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

constexpr const char* file_popup = "file";

bool pressed(std::initializer_list<int> keys) {
  return std::ranges::any_of(keys, [](int key) { return ImGui::IsKeyPressed(key, true); });
}

const char* title_of(FileDialog::For what) {
  using enum FileDialog::For;
  if (what == profile) return "Photometric profile of the lamp";
  if (what == sky) return "Picture of the sky, equirectangular";
  if (what == picture) return "Save the picture as .png, or its linear light as .exr";
  return what == open ? "Open" : what == scene ? "Save the scene as" : "Save the probes as";
}

/// ImGui has a copy of its own of what is being typed: what the list or Tab changed goes there.
int edited(ImGuiInputTextCallbackData* data) {
  FileBrowser& browser = *static_cast<FileBrowser*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) browser.complete();
  if (data->EventFlag == ImGuiInputTextFlags_CallbackEdit) browser.type(data->Buf);
  if (browser.typed() != data->Buf) {
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, browser.typed().c_str());
  }
  return 0;
}

/// True once the name that stands there is chosen by Enter.
bool draw_name(FileBrowser& browser) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Name");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::IsAnyItemActive() && !ImGui::IsAnyMouseDown()) ImGui::SetKeyboardFocusHere();
  std::array<char, 1024> text{};
  browser.typed().copy(text.data(), text.size() - 1);
  return ImGui::InputText("##name", text.data(), text.size(),
                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                              ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackEdit |
                              ImGuiInputTextFlags_CallbackAlways,
                          edited, &browser);
}

/// True once an entry is chosen by a double click.
bool draw_list(FileBrowser& browser, float height, bool scroll) {
  bool chosen = false;
  ImGui::BeginChild("list", {0, height}, true);
  const auto& entries = browser.entries();
  if (entries.empty()) note(fmt::format("Nothing here ends with {}.", fmt::join(browser.endings(), " ")));
  for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
    const FileBrowser::Entry& entry = entries[i];
    const std::string label = entry.name + (entry.folder ? "/" : "");
    ImGui::PushID(i);
    if (ImGui::Selectable(label.c_str(), i == browser.selected(), ImGuiSelectableFlags_AllowDoubleClick)) {
      browser.select(i);
      chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    }
    if (scroll && i == browser.selected()) ImGui::SetScrollHereY();
    ImGui::PopID();
    if (chosen) break;
  }
  ImGui::EndChild();
  return chosen;
}

/// Whether an arrow moved the mark.
bool move_by_keys(FileBrowser& browser) {
  const int before = browser.selected();
  if (pressed({GLFW_KEY_DOWN})) browser.move(1);
  if (pressed({GLFW_KEY_UP})) browser.move(-1);
  if (pressed({GLFW_KEY_PAGE_DOWN})) browser.move(10);
  if (pressed({GLFW_KEY_PAGE_UP})) browser.move(-10);
  return browser.selected() != before;
}

}  // namespace

void draw_file_dialog(App& app) {
  if (!app.dialog) return;
  if (!ImGui::IsPopupOpen(file_popup)) ImGui::OpenPopup(file_popup);
  const auto width = static_cast<float>(app.window.width()), height = static_cast<float>(app.window.height());
  const float em = ImGui::GetFontSize();
  const ImVec2 size{std::min(48 * em, 0.94f * width), std::min(36 * em, 0.9f * height)};
  ImGui::SetNextWindowPos({0.5f * width, 0.5f * height}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(size);
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  if (!ImGui::BeginPopupModal(file_popup, nullptr, flags)) return;
  FileDialog& dialog = *app.dialog;
  FileBrowser& browser = dialog.browser;
  heading(title_of(dialog.what));
  if (ImGui::SmallButton("Up")) browser.up();
  ImGui::SameLine();
  ImGui::TextWrapped("%s", browser.folder().c_str());

  // Where nothing is typed there is nothing to take back but the way here; not while the key is held.
  const bool opens = dialog.reads();
  if (opens && browser.typed().empty() && ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE, false)) browser.up();
  const bool moved = move_by_keys(browser);
  const std::string typed = browser.typed();
  const int selected = browser.selected();
  const float below = 3.4f * ImGui::GetFrameHeightWithSpacing();
  bool chosen = draw_list(browser, ImGui::GetContentRegionAvail().y - below, moved);
  chosen |= draw_name(browser);
  if (moved || browser.typed() != typed || browser.selected() != selected)
    dialog.problem.clear(), dialog.replaces.clear();

  std::string line = dialog.problem;
  if (!dialog.replaces.empty())
    line = dialog.replaces.filename().string() + " is there already: choose it again to replace it.";
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 0.5f, 0.45f, 1));
  ImGui::TextWrapped("%s", line.c_str());
  ImGui::PopStyleColor();
  const char* verb = opens ? "Open (Enter)" : dialog.replaces.empty() ? "Save (Enter)" : "Replace (Enter)";
  chosen |= ImGui::Button(verb);
  beside("Cancel (Escape)");
  const bool leaves = ImGui::Button("Cancel (Escape)") || pressed({GLFW_KEY_ESCAPE});
  const char* hint = opens ? "Tab completes, Backspace goes up" : "Tab completes, ../ goes up";
  beside(hint);
  ImGui::TextDisabled("%s", hint);
  if (leaves) {
    app.dialog.reset();
  } else if (chosen) {
    app.choose_file();
  }
  if (!app.dialog) ImGui::CloseCurrentPopup();
  if (leaves || chosen || moved) app.redraw();
  ImGui::EndPopup();
}

}  // namespace ssphh::viewer
