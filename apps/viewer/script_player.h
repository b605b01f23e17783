#pragma once
/// Does what a script says, one command a turn.

#include <deque>

#include "app.h"
#include "model/script.h"

namespace ssphh::viewer {

class ScriptPlayer {
 public:
  explicit ScriptPlayer(std::vector<ScriptLine> lines) : lines_(std::move(lines)) {}

  /// Input for the next turn; runs the next command when the one before is done. Throws Error naming the
  /// line.
  InjectedInput next(App& app);
  bool done() const { return at_ == lines_.size() && input_.empty() && wait_frames_ == 0 && !settling_; }

 private:
  void run(App& app, const ScriptLine& line);
  void press(const ScriptLine& line);
  void move_mouse(const ScriptLine& line);

  std::vector<ScriptLine> lines_;
  std::size_t at_ = 0;
  std::deque<InjectedInput> input_;
  int wait_frames_ = 0;
  bool settling_ = false;
};

/// The commands, for `ssphh view --help` and docs/viewer.md.
extern const char* const script_help;

}  // namespace ssphh::viewer
