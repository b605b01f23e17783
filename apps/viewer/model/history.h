#pragma once
/// Undo and redo of plain values: whole states are kept, so that no edit needs an inverse.

#include <cstdint>
#include <deque>
#include <string>

namespace ssphh::viewer {

template <class State>
class History {
 public:
  explicit History(State initial = {}) : now_(std::move(initial)) {}

  const State& now() const { return now_; }
  /// Of the state: the first has 0, each other one a number of its own, which undo and redo bring back.
  std::uint64_t serial() const { return serial_; }

  /// One more state, called `what` ("move lamp"). Following changes of the same name count as one with it
  /// until seal(): what a mouse drags becomes one step. A state that `counts` for nothing has the serial of
  /// the one before it.
  void change(State next, const std::string& what, bool counts = true) {
    if (!open_ || undo_.empty() || undo_.back().what != what) {
      undo_.push_back({std::move(now_), what, serial_});
      if (undo_.size() > most_steps) undo_.pop_front();
    }
    now_ = std::move(next);
    if (counts) serial_ = ++last_serial_;
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
    std::uint64_t serial;
  };

  bool step(std::deque<Step>& from, std::deque<Step>& to) {
    open_ = false;
    if (from.empty()) return false;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({std::move(now_), step.what, serial_});
    now_ = std::move(step.state);
    serial_ = step.serial;
    return true;
  }

  State now_;
  std::deque<Step> undo_, redo_;
  bool open_ = false;
  std::uint64_t serial_ = 0, last_serial_ = 0;
};

}  // namespace ssphh::viewer
