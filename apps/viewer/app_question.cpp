// What is not saved, and the question before it is lost.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app.h"

namespace ssphh::viewer {
/// Without hands nobody is there to answer.
bool App::by_hand() const {
  return options.script.empty() && options.screenshot.empty() && options.export_dir.empty() &&
         options.frames == 0;
}

std::string App::what_is_lost() const {
  if (!by_hand() || !scene_open()) return {};
  std::string text;
  if (document.dirty()) text = fmt::format("{} has changes that are not saved.", document.source);
  if (!light.unsaved().empty())
    text += fmt::format("{}What {} has found is not saved.", text.empty() ? "" : "\n", light.unsaved());
  if (baking()) text += fmt::format("{}{} is not done yet.", text.empty() ? "" : "\n", job.status().name);
  return text;
}

bool App::may_close() {
  if (closes_ || what_is_lost().empty()) return true;
  window.keep_open();
  question = {Question::Then::close, {}, {}};
  redraw();
  return false;
}

void App::answer(Answer answer) {
  const Question asked = std::exchange(question, {});
  redraw();
  if (answer == Answer::stay) return;
  try {
    if (answer == Answer::recover) return recover(asked.kept);
    if (asked.then == Question::Then::recover) return autosave_.remove(asked.kept);
    if (asked.then == Question::Then::take_probes) return take_probe_file(asked.source, true);
    if (answer == Answer::save && unsaved()) save();
    if (asked.then == Question::Then::open || asked.then == Question::Then::reload) open_lit(asked.source);
    if (asked.then == Question::Then::close) {
      closes_ = true;
      window.close();
    }
  } catch (const std::exception& e) {
    complain(e.what());
  }
}

void App::update_title() {
  const std::string title = (unsaved() ? "*" : "") + document.source + " – ssphh";
  if (title != title_) window.set_title(title);
  title_ = title;
}

}  // namespace ssphh::viewer
