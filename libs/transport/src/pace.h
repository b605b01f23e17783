#pragma once
/// Work that stops when its time is over and goes on later.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include <ssphh/core/control.h>

namespace ssphh::transport {

class Pace {
 public:
  /// Never over.
  explicit Pace(const Control& control = {}) : Pace(control, INFINITY) {}
  /// Over so many milliseconds from now.
  Pace(const Control& control, double budget_ms)
      : control_(control), budget_(budget_ms), begin_(Clock::now()) {}

  bool over() const { return !std::isinf(budget_) && left() <= 0; }

  /// Calls work(begin, end) for pieces of [done, count), one of them at least, and counts `done` up; true:
  /// all are done. An unlimited pace takes all at once, others `least` at first and then what fits into half
  /// of the time that is left. Throws Cancelled between two pieces.
  template <class Work>
  bool go_on(std::size_t& done, std::size_t count, std::size_t least, const Work& work) const {
    std::size_t piece = std::isinf(budget_) ? count : least;
    while (done < count) {
      control_.check();
      const Clock::time_point before = Clock::now();
      const std::size_t end = done + std::min(piece, count - done);
      work(done, end);
      const double each = milliseconds(Clock::now() - before) / static_cast<double>(end - done);
      done = end;
      if (done == count) break;
      if (over()) return false;
      const double fits = each > 0 ? 0.5 * left() / each : 2 * static_cast<double>(piece);
      piece = std::max(least, static_cast<std::size_t>(std::min(fits, static_cast<double>(count))));
    }
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
  }
  double left() const { return budget_ - milliseconds(Clock::now() - begin_); }

  Control control_;
  double budget_;
  Clock::time_point begin_;
};

}  // namespace ssphh::transport
