#pragma once
/// What a broker tells on its thread, to be waited for on another.

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include <ssphh/majordomo/event.h>

namespace ssphh::majordomo::test {

class Told {
 public:
  void operator()(const BrokerEvent& event) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(event.text());
    changed_.notify_all();
  }
  /// Whether a line that begins so is told, within ten seconds.
  bool wait_for(const std::string& begin) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [&] {
      for (const std::string& line : lines_)
        if (line.starts_with(begin)) return true;
      return false;
    });
  }
  std::string last() {
    const std::lock_guard lock(mutex_);
    return lines_.empty() ? "" : lines_.back();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

}  // namespace ssphh::majordomo::test
