#pragma once
/// Things to be done at a time, in order of time and then of setting.

#include <functional>
#include <limits>
#include <map>
#include <utility>

#include <ssphh/core/require.h>
#include <ssphh/majordomo/frames.h>

namespace ssphh::majordomo {

/// A time after which something is done again must lie in 1..most_millis.
inline void require_pause(Millis time, const char* where, const char* problem) {
  require(time >= 1 && time <= most_millis, where, problem);
}

class Timers {
 public:
  static constexpr Millis never = std::numeric_limits<Millis>::max();
  using Task = std::function<void(Millis)>;
  /// Names a set timer; a default one names none, and cancelling it does nothing.
  struct Handle {
    Millis when = never;
    std::uint64_t serial = 0;
  };

  Handle set(Millis when, Task task) {
    const Handle handle{when, ++serial_};
    tasks_.emplace(std::pair(when, serial_), std::move(task));
    return handle;
  }
  void cancel(Handle& handle) {
    if (handle.serial) tasks_.erase({handle.when, handle.serial});
    handle = {};
  }
  Millis next() const { return tasks_.empty() ? never : tasks_.begin()->first.first; }
  void run(Millis now) {
    // What a task sets for `now` or earlier waits for the next call, so that this ends.
    const std::uint64_t last = serial_;
    for (auto it = tasks_.begin(); it != tasks_.end() && it->first.first <= now;) {
      if (it->first.second > last) {
        ++it;
        continue;
      }
      const Task task = std::move(it->second);
      tasks_.erase(it);
      task(now);
      it = tasks_.begin();
    }
  }

 private:
  std::uint64_t serial_ = 0;
  std::map<std::pair<Millis, std::uint64_t>, Task> tasks_;
};

}  // namespace ssphh::majordomo
