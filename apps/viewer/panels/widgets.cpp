#include "widgets.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app.h"

namespace ssphh::viewer {
namespace {

const SettingName& setting(const char* name) {
  const std::vector<SettingName>& names = setting_names();
  const auto found = std::ranges::find_if(names, [&](const auto& s) { return s.name == name; });
  SSPHH_CHECK(found != names.end());
  return *found;
}

void set(App& app, const SettingName& setting, const std::string& value) {
  attempt(app, [&] { setting.set(app.settings, value); });
  app.redraw();
}

/// A label with what comes next beside it, or below.
void begin_row(const char* label, bool beside) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  if (beside)
    ImGui::SameLine(
        std::max(0.36f * ImGui::GetWindowContentRegionMax().x, ImGui::CalcTextSize(label).x + gap));
}

}  // namespace

void row(const char* label) {
  begin_row(label, ImGui::GetWindowContentRegionMax().x > 20 * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
}

bool tick_row(const char* label, bool* on) {
  begin_row(label, true);
  ImGui::PushID(label);
  const bool changed = ImGui::Checkbox("##on", on);
  ImGui::PopID();
  return changed;
}

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.95f, 0.72f, 0.38f, 1));
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
  ImGui::Separator();
}

void note(const std::string& text, float width) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

bool wide_button(const char* label) {
  return ImGui::Button(label, {-1, 0});
}

void beside(const char* label, float room) {
  const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (room == 0) room = ImGui::GetWindowContentRegionMax().x;
  if (end <= ImGui::GetWindowPos().x + room) ImGui::SameLine();
}

void tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(22 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void seal_after_edit(App& app) {
  if (ImGui::IsItemDeactivatedAfterEdit()) app.document.history.seal();
}

void file_row(const char* label, char (&file)[256]) {
  row(label);
  ImGui::PushID(label);
  ImGui::InputText("##file", file, sizeof file);
  ImGui::PopID();
}

bool save_button(App& app, const char* label, const char* replace, const std::filesystem::path& file,
                 float width) {
  const bool asked = app.replaces == file;
  const char* shown = asked ? replace : label;
  if (!ImGui::Button(shown, {width, 0})) return false;
  std::error_code ignored;
  app.replaces.clear();
  if (asked || !std::filesystem::exists(file, ignored)) return true;
  app.replaces = file;
  app.say(fmt::format("{} is there already: press \"{}\" to replace it", file.string(), replace));
  return false;
}

void complain(App& app, const char* what) {
  app.complain(what);
}

void setting_widget(App& app, const char* label, const char* name) {
  const SettingName& s = setting(name);
  const std::string value = s.get(app.settings);
  ImGui::PushID(name);
  if (s.choices.size() == 2 && s.choices[0] == "off") {
    bool on = value == "on";
    if (tick_row(label, &on)) set(app, s, on ? "on" : "off");
    tip(s.help.c_str());
  } else if (!s.choices.empty()) {
    row(label);
    const bool open = ImGui::BeginCombo("##value", value.c_str());
    if (!open) tip(s.help.c_str());
    if (open) {
      for (const std::string& choice : s.choices) {
        if (ImGui::Selectable(choice.c_str(), choice == value)) set(app, s, choice);
      }
      ImGui::EndCombo();
    }
  } else {
    row(label);
    int number = std::atoi(value.c_str());
    if (ImGui::InputInt("##value", &number)) set(app, s, fmt::format("{}", number));
    tip(s.help.c_str());
  }
  ImGui::PopID();
}

void setting_slider(App& app, const char* label, const char* name, float low, float high,
                    const char* format) {
  const SettingName& s = setting(name);
  const std::string text = s.get(app.settings);
  auto value = text == "auto" ? app.settings.exposure : static_cast<float>(std::atof(text.c_str()));
  ImGui::PushID(name);
  row(label);
  if (ImGui::SliderFloat("##value", &value, low, high, format)) set(app, s, fmt::format("{}", value));
  tip(s.help.c_str());
  ImGui::PopID();
}

}  // namespace ssphh::viewer
