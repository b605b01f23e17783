#pragma once
/// What the one who waits for a farm sees beside the bar: workers that come and go, and retries.

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/farm/dispatch.h>

namespace ssphh::farm {

class FarmProgress {
 public:
  FarmProgress(const Control& control, const char* stage, std::size_t total, const char* unit)
      : stage_(control, stage, total, unit) {}

  void cached(std::size_t units) {
    if (units > 0) log_info("{} in the cache", counted(units, "result is", "results are"));
    stage_.advance(units);
  }
  void finished(std::size_t units, const FarmReport& report) {
    stage_.advance(units);
    if (report.workers > workers_) log_info("{}", counted(report.workers, "worker"));
    if (report.retries > retries_)
      log_info("{}: workers were lost or failed", counted(report.retries, "retry", "retries"));
    workers_ = report.workers, retries_ = report.retries;
  }

 private:
  ProgressStage stage_;
  int workers_ = 0;
  std::uint64_t retries_ = 0;
};

}  // namespace ssphh::farm
