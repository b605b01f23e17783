#pragma once
/// The farm as the window knows it.

#include <optional>
#include <string>

#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/status.h>

#include "background_job.h"

namespace ssphh::viewer {

/// Asks a farm's broker every second, on a thread of its own.
class FarmClient {
 public:
  /// `options` must outlive it. Throws Error for an endpoint that is none; a broker that is not there counts
  /// as lost after some seconds.
  explicit FarmClient(const farm::FarmOptions& options);

  /// Takes what was told since; false: nothing.
  bool poll() { return watch_.poll(); }
  const farm::FarmOptions& options() const { return options_; }
  const std::string& endpoint() const { return options_.broker.endpoint; }
  /// As of the last answer; none: there was none yet.
  const std::optional<farm::FarmFigures>& figures() const { return figures_; }
  std::optional<double> jobs_per_second() const { return per_second_; }
  /// Whether the last question had no answer.
  bool lost() const { return lost_; }

  bool used = true;  ///< bakes go there; else they are done here

 private:
  const farm::FarmOptions& options_;
  std::optional<farm::FarmFigures> figures_;
  std::optional<double> per_second_;
  bool lost_ = false;
  BackgroundJob watch_;
};

}  // namespace ssphh::viewer
