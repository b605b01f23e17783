#pragma once
/// What a broker tells of its workers and jobs: for `ssphh farm`, and for the window's panel.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/blob_server.h>
#include <ssphh/majordomo/client.h>

namespace ssphh::farm {

struct FarmStatus {
  json::Value stats, workers;        ///< answers of mmi.stats and mmi.workers (docs/protocol.md)
  std::optional<double> per_second;  ///< jobs that were finished since the look before; none: it is the first
};

/// A FarmStatus in numbers. What older brokers do not tell is 0.
struct FarmFigures {
  struct Service {
    std::string name;
    std::uint64_t workers = 0, idle = 0, queued = 0, finished = 0;
  };
  struct Worker {
    std::string name, state;  ///< "idle", "busy" ...
    double seconds = 0;       ///< in that state
    std::uint64_t served = 0;
    std::string service;
  };
  std::uint64_t workers = 0, idle = 0, queued = 0, running = 0;  ///< as of now
  std::uint64_t finished = 0, retries = 0, parked = 0;           ///< since the broker's start
  std::optional<double> seconds_left;                            ///< at the present rate; none: unknown
  std::vector<Service> services;
  std::vector<Worker> each_worker;
};
/// Throws Error for an answer that lacks its parts.
FarmFigures figures_of(const FarmStatus& status);

/// Asks one broker, again and again; for one thread at a time.
class StatusWatch {
 public:
  /// Throws Error for a bad endpoint; a broker that is not there yet is none.
  explicit StatusWatch(const BrokerAddress& broker);
  /// Throws Error when no answer comes within five seconds, or it is none; Cancelled.
  FarmStatus look(const Control& control = {});

 private:
  majordomo::Client client_;
  std::optional<double> finished_;  ///< jobs at the look before
  Stopwatch since_;
};

}  // namespace ssphh::farm
