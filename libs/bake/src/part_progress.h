#pragma once

#include <algorithm>
#include <mutex>

#include <ssphh/core/control.h>

namespace ssphh::bake {

/// Maps the stages that one piece of the work reports, in whatever unit, onto `share` units of the stage
/// around it.
class PartProgress final : public Progress {
 public:
  PartProgress(ProgressStage& whole, std::uint64_t share) : whole_(whole), share_(share) {}
  ~PartProgress() override { whole_.advance(share_ - reported_); }
  PartProgress(const PartProgress&) = delete;
  PartProgress& operator=(const PartProgress&) = delete;

  void begin(const std::string&, std::uint64_t total, const std::string&) override {
    std::lock_guard lock(mutex_);
    total_ = total, done_ = 0;
  }
  void advance(std::uint64_t count) override {
    std::lock_guard lock(mutex_);
    done_ += count;
    if (total_ == 0) return;
    const double fraction = std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_));
    const auto reached = static_cast<std::uint64_t>(fraction * static_cast<double>(share_));
    if (reached <= reported_) return;
    whole_.advance(reached - reported_);
    reported_ = reached;
  }
  void end() override {}

 private:
  ProgressStage& whole_;
  std::uint64_t share_, total_ = 0, done_ = 0, reported_ = 0;
  std::mutex mutex_;
};

}  // namespace ssphh::bake
