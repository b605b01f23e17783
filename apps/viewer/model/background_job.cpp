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
    over_ = false;
    begun_ = std::chrono::steady_clock::now();
    done_.store(0, std::memory_order_relaxed);
  }
  void advance(std::uint64_t count) override { done_.fetch_add(count, std::memory_order_relaxed); }
  void end() override {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }

  void read(JobStatus& status) const {
    const std::lock_guard lock(mutex_);
    status.stage = stage_;
    // What follows may take long without telling how far it is: the share of what is over says nothing of it.
    if (total_ == 0 || (over_ && status.running)) return;
    status.fraction = std::min(
        1.0, static_cast<double>(done_.load(std::memory_order_relaxed)) / static_cast<double>(total_));
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begun_;
    if (status.fraction > 0) status.stage_left = gone.count() * (1 / status.fraction - 1);
  }

 private:
  mutable std::mutex mutex_;
  std::string stage_;
  std::uint64_t total_ = 0;
  bool over_ = false;
  std::chrono::steady_clock::time_point begun_;
  std::atomic<std::uint64_t> done_{0};
};

BackgroundJob::BackgroundJob() : meter_(std::make_shared<Meter>()), token_(std::make_shared<CancelToken>()) {}

BackgroundJob::~BackgroundJob() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void BackgroundJob::start(const std::string& name, Work work) {
  cancel();
  const std::lock_guard lock(mutex_);
  name_ = name;
  error_.clear();
  running_ = true;
  start_ = std::chrono::steady_clock::now();
  meter_ = std::make_shared<Meter>();
  token_ = std::make_shared<CancelToken>();
  next_ = std::move(work);
  if (executing_) return;
  // A thread that is not at work any more takes no lock on its way to the end.
  if (thread_.joinable()) thread_.join();
  executing_ = token_;
  thread_ = std::thread([this] { run(); });
}

void BackgroundJob::run() {
  std::unique_lock lock(mutex_);
  while (next_) {
    const Work work = std::exchange(next_, {});
    const std::shared_ptr<Meter> meter = meter_;
    const std::shared_ptr<CancelToken> token = executing_ = token_;
    lock.unlock();
    Finish finish;
    std::string error;
    try {
      finish = work({meter.get(), token.get()});
    } catch (const Cancelled&) {
    } catch (const std::exception& e) {
      error = e.what();
    }
    lock.lock();
    if (token->requested()) continue;
    if (finish) handed_.push_back(std::move(finish));
    error_ = error;
    running_ = false;
    end_ = std::chrono::steady_clock::now();
  }
  executing_.reset();
}

void BackgroundJob::cancel() {
  const std::lock_guard lock(mutex_);
  token_->request();
  handed_.clear();
  next_ = {};
  if (!std::exchange(running_, false)) return;
  end_ = std::chrono::steady_clock::now();
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
    meter_->read(status);
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
  if (executing_ == token_ && !token_->requested()) handed_.push_back(std::move(step));
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
