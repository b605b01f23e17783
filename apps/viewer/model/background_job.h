#pragma once
/// Long work on a thread of its own: started, watched and stopped by the window, which takes the result over
/// when it is there. Control, status and results pass through one lock; nothing else is shared.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <ssphh/core/control.h>

namespace ssphh::viewer {

struct JobStatus {
  std::string name;                  ///< of the job; empty: none was started yet
  std::string stage;                 ///< what it is at
  double fraction = -1;              ///< of the stage, 0..1; −1: not known
  double seconds = 0;                ///< since the start
  std::optional<double> stage_left;  ///< seconds of the stage that are left at its mean rate; none: not known
  bool running = false;
  std::string error;  ///< why the last job ended without a result; empty: it did not, or was cancelled
};

/// One job at a time. The destructor cancels and waits.
class BackgroundJob {
 public:
  /// Does the work and returns what the window's thread shall do with the result; runs on the job's thread.
  using Finish = std::function<void()>;
  using Work = std::function<Finish(const Control&)>;

  BackgroundJob();
  ~BackgroundJob();
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Cancels what runs, and begins anew once that has ended; nobody waits for it here. What the old job would
  /// have handed over is dropped.
  void start(const std::string& name, Work work);
  /// Asks the job to stop; its result is dropped. It counts as ended at once.
  void cancel();
  JobStatus status() const;
  bool running() const { return status().running; }
  /// Nothing runs, and nothing waits for poll().
  bool idle() const;
  /// Why the last job failed, once; empty: it did not.
  std::string take_error();

  /// Called by the job, from any thread: `step` is run by the next poll(), before the result. For results
  /// that come piece by piece.
  void hand_over(Finish step);
  /// Runs what was handed over, on the caller's thread. True when there was anything.
  bool poll();

 private:
  class Meter;
  void run();

  mutable std::mutex mutex_;
  std::shared_ptr<Meter> meter_;
  std::shared_ptr<CancelToken> token_;      ///< of the job that was started last
  std::shared_ptr<CancelToken> executing_;  ///< of the one whose work is being done; null: none
  Work next_;                               ///< to be done after that
  std::thread thread_;
  std::string name_, error_;
  std::vector<Finish> handed_;
  bool running_ = false;
  std::chrono::steady_clock::time_point start_, end_;
};

}  // namespace ssphh::viewer
