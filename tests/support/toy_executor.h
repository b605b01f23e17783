#pragma once
/// A job system of std::threads, as a caller might have one.

#include <algorithm>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

#include <ssphh/core/executor.h>

namespace ssphh::test {

class ToyExecutor final : public Executor {
 public:
  explicit ToyExecutor(int threads) {
    for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }
  ~ToyExecutor() override {
    {
      const std::scoped_lock lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  int thread_count() const override { return static_cast<int>(threads_.size()) + 1; }
  void* start(Job job, int times) override {
    const std::scoped_lock lock(mutex_);
    ++started_;
    Waiting& waiting = waiting_.emplace_back(Waiting{job, times, 0});
    changed_.notify_all();
    return &waiting;
  }
  void finish(void* started) override {
    std::unique_lock lock(mutex_);
    auto* const waiting = static_cast<Waiting*>(started);
    waiting->left = 0;
    changed_.wait(lock, [&] { return waiting->running == 0; });
    waiting_.remove_if([&](const Waiting& one) { return &one == waiting; });
  }

  /// Jobs so far.
  int started() const { return started_; }

 private:
  struct Waiting {
    Job job;
    int left, running;
  };
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto next = std::ranges::find_if(waiting_, [](const Waiting& one) { return one.left > 0; });
      if (next == waiting_.end()) {
        if (ends_) return;
        changed_.wait(lock);
        continue;
      }
      --next->left, ++next->running;
      lock.unlock();
      next->job.run(next->job.data);
      lock.lock();
      --next->running;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Waiting> waiting_;
  bool ends_ = false;
  int started_ = 0;
  std::vector<std::thread> threads_;
};

/// Makes loops run on it for the time of its life.
class OnExecutor {
 public:
  explicit OnExecutor(Executor& executor) { set_executor(&executor); }
  ~OnExecutor() { set_executor(nullptr); }
  OnExecutor(const OnExecutor&) = delete;
  OnExecutor& operator=(const OnExecutor&) = delete;
};

}  // namespace ssphh::test
