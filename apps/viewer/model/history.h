#pragma once
/// Undo and redo of plain values: whole states are kept, so that no edit needs an inverse.

#include <deque>
#include <string>

namespace ssphh::viewer {

template <class State>
class History {
 public:
  explicit History(State initial = {}) : now_(std::move(initial)) {}

  const State& now() const { return now_; }

  /// One more state, called `what` ("move lamp"). Following changes of the same name count as one with it
  /// until seal(): what a mouse drags becomes one step.
  void change(State next, const std::string& what) {
    if (!open_ || undo_.empty() || undo_.back().what != what) {
      undo_.push_back({std::move(now_), what});
      if (undo_.size() > most_steps) undo_.pop_front();
    }
    now_ = std::move(next);
    redo_.clear();
    open_ = true;
  }
  /// Ends a gesture: the next change is a step of its own.
  void seal() { open_ = false; }

  /// False: there is nothing to undo (redo).
  bool undo() { return step(undo_, redo_); }
  bool redo() { return step(redo_, undo_); }

  /// What undo() (redo()) would take back (do again); empty: nothing.
  std::string undo_name() const { return undo_.empty() ? "" : undo_.back().what; }
  std::string redo_name() const { return redo_.empty() ? "" : redo_.back().what; }

  static constexpr std::size_t most_steps = 200;

 private:
  struct Step {
    State state;
    std::string what;
  };

  bool step(std::deque<Step>& from, std::deque<Step>& to) {
    open_ = false;
    if (from.empty()) return false;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({std::move(now_), step.what});
    now_ = std::move(step.state);
    return true;
  }

  State now_;
  std::deque<Step> undo_, redo_;
  bool open_ = false;
};

}  // namespace ssphh::viewer
