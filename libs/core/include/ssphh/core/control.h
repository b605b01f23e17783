#pragma once
/// Progress and cancellation of long work.

#include <atomic>
#include <cstdint>
#include <string>

#include <ssphh/core/error.h>

namespace ssphh {

/// Set from a signal handler, a user interface or another thread; polled by the work.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// Told how far the work is. Implementations must be safe to call from several threads.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A stage of `total` units begins; `unit` is a plural noun ("rays", "texels").
  virtual void begin(const std::string& stage, std::uint64_t total, const std::string& unit) = 0;
  /// `count` more units are done.
  virtual void advance(std::uint64_t count) = 0;
  virtual void end() = 0;
};

/// What a caller hands to every long function. Both may be null.
struct Control {
  Progress* progress = nullptr;
  const CancelToken* cancel = nullptr;

  bool cancelled() const { return cancel && cancel->requested(); }
  /// Throws Cancelled when a stop was asked for.
  void check() const {
    if (cancelled()) stop_cancelled();
  }
};

/// Begins a stage on construction and ends it on destruction; does nothing without a Progress.
class ProgressStage {
 public:
  ProgressStage(const Control& control, const std::string& stage, std::uint64_t total,
                const std::string& unit)
      : progress_(control.progress) {
    if (progress_) progress_->begin(stage, total, unit);
  }
  ~ProgressStage() {
    if (progress_) progress_->end();
  }
  ProgressStage(const ProgressStage&) = delete;
  ProgressStage& operator=(const ProgressStage&) = delete;

  void advance(std::uint64_t count) {
    if (progress_) progress_->advance(count);
  }

 private:
  Progress* progress_;
};

}  // namespace ssphh
