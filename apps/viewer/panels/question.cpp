#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"

namespace ssphh::viewer {
namespace {

constexpr const char* popup = "question";

/// A button that a key presses, too.
bool choice(const std::string& label, std::initializer_list<int> keys) {
  bool chosen = ImGui::Button(label.c_str());
  for (const int key : keys) chosen |= ImGui::IsKeyPressed(key, false);
  return chosen;
}

}  // namespace

void draw_question(App& app) {
  const std::string lost = app.what_is_lost();
  const bool asks = app.question.then != Question::Then::nothing && !lost.empty();
  if (asks && !ImGui::IsPopupOpen(popup)) ImGui::OpenPopup(popup);
  const Rect2& r = app.viewport;
  ImGui::SetNextWindowPos({r.x + 0.5f * r.width, r.y + 0.5f * r.height}, ImGuiCond_Always, {0.5f, 0.5f});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
  if (!ImGui::BeginPopupModal(popup, nullptr, flags)) return;
  if (!asks) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    // What was asked about may be done meanwhile: a bake ends.
    if (app.question.then != Question::Then::nothing) app.answer(Answer::discard);
    return;
  }
  const char* then = app.question.then == Question::Then::close ? "close" : "open";
  ImGui::PushTextWrapPos(30 * ImGui::GetFontSize());
  ImGui::TextUnformatted(lost.c_str());
  if (app.question.then == Question::Then::open) ImGui::Text("To be opened: %s", app.question.source.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::optional<Answer> answer;
  if (app.document.dirty()) {
    ImGui::TextDisabled("%s", app.document.file.empty() ? "Saving makes a new GLB file in the current folder."
                                                        : ("Saving replaces " + app.document.file).c_str());
    if (choice(fmt::format("Save and {} (S)", then), {GLFW_KEY_S, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER}))
      answer = Answer::save;
    ImGui::SameLine();
  }
  if (choice(fmt::format("Discard and {} (D)", then), {GLFW_KEY_D})) answer = Answer::discard;
  ImGui::SameLine();
  if (choice("Stay (Escape)", {GLFW_KEY_ESCAPE})) answer = Answer::stay;
  if (answer) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (answer) app.answer(*answer);
}

}  // namespace ssphh::viewer
