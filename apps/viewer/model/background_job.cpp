#include "background_job.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace ssphh::viewer {

/// Progress that the window reads.
class BackgroundJob::Meter final : public Progress {
 public:
  void begin(const std::string& stage, std::uint64_t total, const std::string&) override {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    total_ = total;
    done_.store(0, std::memory_order_relaxed);
  }
  void advance(std::uint64_t count) override { done_.fetch_add(count, std::memory_order_relaxed); }
  void end() override {}

  void read(std::string& stage, double& fraction) const {
    const std::lock_guard lock(mutex_);
    stage = stage_;
    fraction = total_ == 0 ? -1
                           : std::min(1.0, static_cast<double>(done_.load(std::memory_order_relaxed)) /
                                               static_cast<double>(total_));
  }

 private:
  mutable std::mutex mutex_;
  std::string stage_;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

BackgroundJob::BackgroundJob() : meter_(std::make_unique<Meter>()), token_(std::make_unique<CancelToken>()) {}

BackgroundJob::~BackgroundJob() {
  cancel();
  join();
}

void BackgroundJob::join() {
  if (thread_.joinable()) thread_.join();
}

void BackgroundJob::start(const std::string& name, Work work) {
  cancel();
  join();
  {
    const std::lock_guard lock(mutex_);
    name_ = name;
    error_.clear();
    running_ = true;
    start_ = std::chrono::steady_clock::now();
    meter_ = std::make_unique<Meter>();
    token_ = std::make_unique<CancelToken>();
  }
  thread_ = std::thread([this, work = std::move(work), control = Control{meter_.get(), token_.get()}] {
    Finish finish;
    std::string error;
    try {
      finish = work(control);
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
      error = e.what();
    }
    const std::lock_guard lock(mutex_);
    if (!control.cancelled()) {
      if (finish) handed_.push_back(std::move(finish));
      error_ = error;
    }
    running_ = false;
    end_ = std::chrono::steady_clock::now();
  });
}

void BackgroundJob::cancel() {
  token_->request();
  const std::lock_guard lock(mutex_);
  handed_.clear();
}

JobStatus BackgroundJob::status() const {
  const std::lock_guard lock(mutex_);
  JobStatus status;
  status.name = name_;
  status.running = running_;
  status.error = error_;
  if (!name_.empty()) {
    const auto until = running_ ? std::chrono::steady_clock::now() : end_;
    status.seconds = std::chrono::duration<double>(until - start_).count();
    meter_->read(status.stage, status.fraction);
  }
  return status;
}

bool BackgroundJob::idle() const {
  const std::lock_guard lock(mutex_);
  return !running_ && handed_.empty();
}

std::string BackgroundJob::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void BackgroundJob::hand_over(Finish step) {
  const std::lock_guard lock(mutex_);
  if (!token_->requested()) handed_.push_back(std::move(step));
}

bool BackgroundJob::poll() {
  std::vector<Finish> steps;
  {
    const std::lock_guard lock(mutex_);
    steps.swap(handed_);
  }
  for (const Finish& step : steps) step();
  return !steps.empty();
}

}  // namespace ssphh::viewer
