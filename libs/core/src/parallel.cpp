#include <algorithm>
#include <atomic>
#include <exception>

#include <ssphh/core/executor.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

#include "tbb_loop.h"

namespace ssphh {
namespace {

std::atomic<Executor*> chosen{nullptr};

/// A loop whose chunks are taken one after the other by whoever comes.
class SharedLoop {
 public:
  explicit SharedLoop(const RangeLoop& loop) : loop_(loop) {}

  static void run(void* self) { static_cast<SharedLoop*>(self)->take_chunks(); }

  void take_chunks() {
    while (!failed_.load(std::memory_order_relaxed)) {
      const std::size_t chunk = next_.fetch_add(1, std::memory_order_relaxed);
      if (chunk >= loop_.chunks()) return;
      try {
        loop_.run(chunk);
      } catch (...) {
        if (!failed_.exchange(true)) error_ = std::current_exception();
      }
    }
  }
  /// When all runs have ended.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const RangeLoop& loop_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::exception_ptr error_;
};

void run_on(Executor& executor, int threads, const RangeLoop& loop) {
  SharedLoop shared(loop);
  const std::size_t others = std::min(static_cast<std::size_t>(threads), loop.chunks()) - 1;
  void* const started = executor.start({SharedLoop::run, &shared}, static_cast<int>(others));
  shared.take_chunks();
  executor.finish(started);
  shared.rethrow();
}

}  // namespace

void set_executor(Executor* executor) {
  chosen = executor;
}

int thread_count() {
  Executor* const executor = chosen;
  return executor ? std::max(executor->thread_count(), 1) : tbb_thread_count();
}

void parallel_for(std::size_t count, std::size_t grain, const RangeBody& body, const Control& control) {
  require(grain > 0, "parallel loop", "its grain must be over 0");
  require(!(body == nullptr), "parallel loop", "it has no body");
  if (count == 0) return;
  const RangeLoop loop{count, grain, body, control};
  Executor* const executor = chosen;
  const int threads = executor ? std::max(executor->thread_count(), 1) : tbb_thread_count();
  if (threads == 1 || loop.chunks() == 1) {
    for (std::size_t chunk = 0; chunk < loop.chunks(); ++chunk) loop.run(chunk);
  } else if (executor) {
    run_on(*executor, threads, loop);
  } else {
    run_on_tbb(loop);
  }
}

}  // namespace ssphh
