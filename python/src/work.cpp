#include "work.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <ssphh/core/log.h>

namespace ssphh::python {
namespace {

/// Messages on their way to Python. Whoever logs need not hold the GIL, and must not wait for it: whoever has
/// it may be waiting to log.
class LogLines {
 public:
  void add(LogLevel level, const std::string& text) {
    const std::scoped_lock lock(mutex_);
    lines_.emplace_back(level, text);
  }
  /// Needs the GIL.
  void deliver() {
    std::vector<std::pair<LogLevel, std::string>> lines;
    {
      const std::scoped_lock lock(mutex_);
      lines.swap(lines_);
    }
    if (lines.empty()) return;
    const py::object logger = py::module_::import("logging").attr("getLogger")("ssphh");
    for (const auto& [level, text] : lines)
      logger.attr(std::string(name_of(level)).c_str())("%s", with_keywords(text));
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<LogLevel, std::string>> lines_;
};

LogLines& log_lines() {
  static LogLines lines;
  return lines;
}

/// Progress between the threads that work and the one that waits.
class Relay final : public Progress {
 public:
  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override {
    const std::scoped_lock lock(mutex_);
    stages_.push_back({stage, unit, 0, total, true});
  }
  void advance(std::uint64_t count) override {
    const std::scoped_lock lock(mutex_);
    if (stages_.empty()) return;
    stages_.back().done += count;
    stages_.back().news = true;
  }
  void end() override {}

  /// That the work is over.
  void finish() {
    const std::scoped_lock lock(mutex_);
    finished_ = true;
    changed_.notify_one();
  }
  /// Waits a twentieth of a second at most. Returns whether the work is over.
  bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::milliseconds(50), [this] { return finished_; });
  }
  /// Needs the GIL.
  void deliver(const py::object& progress) {
    std::vector<Stage> news;
    {
      const std::scoped_lock lock(mutex_);
      for (Stage& stage : stages_) {
        if (stage.news) news.push_back(stage);
        stage.news = false;
      }
      while (stages_.size() > 1) stages_.pop_front();
    }
    for (const Stage& stage : news) progress(stage.name, stage.done, stage.total, stage.unit);
  }

 private:
  struct Stage {
    std::string name, unit;
    std::uint64_t done, total;
    bool news;
  };
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Stage> stages_;  ///< those to tell of; the last one is under way
  bool finished_ = false;
};

}  // namespace

void do_work(const py::object& progress, const std::function<void(const Control&)>& work) {
  if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
    throw Error("progress", "cannot be called", "give a function of (stage, done, total, unit), or None");
  Relay relay;
  CancelToken token;
  const Control control{progress.is_none() ? nullptr : &relay, &token};
  std::exception_ptr failure, raised;
  std::thread worker([&] {
    try {
      work(control);
    } catch (...) {
      failure = std::current_exception();
    }
    relay.finish();
  });
  for (bool finished = false; !finished;) {
    {
      const py::gil_scoped_release others;
      finished = relay.wait();
      if (finished) worker.join();
    }
    if (raised) continue;
    try {
      log_lines().deliver();
      if (!progress.is_none()) relay.deliver(progress);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (...) {
      raised = std::current_exception();
      token.request();
    }
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

void take_log() {
  set_log_sink([](LogLevel level, const std::string& text) { log_lines().add(level, text); });
}

}  // namespace ssphh::python
