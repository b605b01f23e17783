#include <algorithm>
#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app.h"
#include "panels.h"
#include "widgets.h"

namespace ssphh::viewer {
namespace {

constexpr const char* popup = "question";

/// A button that a key presses, too.
bool choice(const std::string& label, std::initializer_list<int> keys) {
  bool chosen = ImGui::Button(label.c_str());
  for (const int key : keys) chosen |= ImGui::IsKeyPressed(key, false);
  return chosen;
}

float text_width(const App& app) {
  return std::min(30 * ImGui::GetFontSize(), 0.9f * static_cast<float>(app.window.width()));
}

/// What an earlier session left.
std::optional<Answer> ask_to_recover(const App& app, const Kept& kept) {
  const char* what = kept.scene && kept.probes ? "changes and a bake" : kept.scene ? "changes" : "a bake";
  ImGui::PushTextWrapPos(text_width(app));
  ImGui::TextUnformatted(kept.source.c_str());
  ImGui::Text("An earlier session ended with %s that no file has, kept at %s.", what, kept.when.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::optional<Answer> answer;
  if (choice("Recover (R)", {GLFW_KEY_R, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER})) answer = Answer::recover;
  beside("Discard (D)", text_width(app));
  if (choice("Discard (D)", {GLFW_KEY_D})) answer = Answer::discard;
  beside("Ask again later (Escape)", text_width(app));
  if (choice("Ask again later (Escape)", {GLFW_KEY_ESCAPE})) answer = Answer::stay;
  return answer;
}

std::optional<Answer> ask_to_reload(const App& app) {
  ImGui::PushTextWrapPos(text_width(app));
  ImGui::Text("%s has changed on the disk.", app.question.source.c_str());
  if (app.unsaved())
    ImGui::TextUnformatted("What was changed here is not saved, and goes when it is loaded anew.");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::optional<Answer> answer;
  if (choice("Load anew (R)", {GLFW_KEY_R, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER})) answer = Answer::discard;
  beside("Keep what is open (Escape)", text_width(app));
  if (choice("Keep what is open (Escape)", {GLFW_KEY_ESCAPE})) answer = Answer::stay;
  return answer;
}

std::optional<Answer> ask_to_take(const App& app) {
  ImGui::PushTextWrapPos(text_width(app));
  ImGui::Text("%s %s. Its light may not suit what is open.", app.question.source.c_str(),
              app.question.problem.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::optional<Answer> answer;
  if (choice("Take it anyway (T)", {GLFW_KEY_T, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER})) answer = Answer::discard;
  beside("Leave it (Escape)", text_width(app));
  if (choice("Leave it (Escape)", {GLFW_KEY_ESCAPE})) answer = Answer::stay;
  return answer;
}

std::optional<Answer> ask_to_lose(const App& app, const std::string& lost) {
  const char* then = app.question.then == Question::Then::close ? "close" : "open";
  ImGui::PushTextWrapPos(text_width(app));
  ImGui::TextUnformatted(lost.c_str());
  if (app.question.then == Question::Then::open) ImGui::Text("To be opened: %s", app.question.source.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::optional<Answer> answer;
  if (app.unsaved()) {
    const std::string how = !app.document.dirty()       ? "Saving makes a probe file in the current folder."
                            : app.document.file.empty() ? "Saving makes a new GLB file in the current folder."
                                                        : "Saving replaces " + app.document.file;
    note(how, text_width(app));
    if (choice(fmt::format("Save and {} (S)", then), {GLFW_KEY_S, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER}))
      answer = Answer::save;
  }
  const std::string discard = fmt::format("Discard and {} (D)", then);
  if (app.unsaved()) beside(discard.c_str(), text_width(app));
  if (choice(discard, {GLFW_KEY_D})) answer = Answer::discard;
  beside("Stay (Escape)", text_width(app));
  if (choice("Stay (Escape)", {GLFW_KEY_ESCAPE})) answer = Answer::stay;
  return answer;
}

}  // namespace

void draw_question(App& app) {
  const std::string lost = app.what_is_lost();
  const bool recovers = app.question.then == Question::Then::recover;
  const bool reloads = app.question.then == Question::Then::reload;
  const bool takes = app.question.then == Question::Then::take_probes;
  const bool asks =
      recovers || reloads || takes || (app.question.then != Question::Then::nothing && !lost.empty());
  if (asks && !ImGui::IsPopupOpen(popup)) ImGui::OpenPopup(popup);
  const Rect2& r = app.area;
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
  const std::optional<Answer> answer = recovers  ? ask_to_recover(app, app.question.kept)
                                       : reloads ? ask_to_reload(app)
                                       : takes   ? ask_to_take(app)
                                                 : ask_to_lose(app, lost);
  if (answer) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (answer) app.answer(*answer);
}

}  // namespace ssphh::viewer
