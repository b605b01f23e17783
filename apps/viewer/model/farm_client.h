#pragma once
/// The farm as the window knows it.

#include <functional>
#include <optional>
#include <string>

#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/status.h>

#include "background_job.h"

namespace ssphh::viewer {

/// A farm that this session has started: why no job will be done any more (empty: jobs are done), and what
/// starts again what has ended. Both empty: it is another's.
struct OwnFarm {
  std::function<std::string()> failure;
  std::function<void()> restart;
};

/// Asks a farm's broker every second, on a thread of its own.
class FarmClient {
 public:
  /// `options` must outlive it. Throws Error for an endpoint that is none; a broker that is not there counts
  /// as lost after some seconds.
  explicit FarmClient(const farm::FarmOptions& options, OwnFarm own = {});

  /// Takes what was told since; false: nothing.
  bool poll() { return watch_.poll(); }
  const farm::FarmOptions& options() const { return options_; }
  const std::string& endpoint() const { return options_.broker.endpoint; }
  /// As of the last answer; none: there was none yet.
  const std::optional<farm::FarmFigures>& figures() const { return figures_; }
  std::optional<double> jobs_per_second() const { return per_second_; }
  /// Whether the last question had no answer.
  bool lost() const { return lost_; }
  /// Of a farm of this session's own, as OwnFarm::failure.
  std::string failure() const { return own_.failure ? own_.failure() : std::string(); }
  void restart() const { own_.restart(); }

  bool used = true;  ///< bakes go there; else they are done here

 private:
  const farm::FarmOptions& options_;
  OwnFarm own_;
  std::optional<farm::FarmFigures> figures_;
  std::optional<double> per_second_;
  bool lost_ = false;
  BackgroundJob watch_;
};

}  // namespace ssphh::viewer
