#pragma once
/// A worker process: several jobs at a time from one broker, one scene store.

#include <ssphh/farm/blob_server.h>
#include <ssphh/farm/run_job.h>

namespace ssphh::farm {

struct WorkerPoolOptions {
  BrokerAddress broker;
  int slots = 1;     ///< jobs at a time; the threads of this process are shared between them
  std::string name;  ///< of this process, for status and logs; empty: HOST:PID
  std::filesystem::path cache;
  std::uint64_t cache_bytes = std::uint64_t{20} << 30;
  OtherRenderer other = {};  ///< path: jobs are those of this program's paths; else of that renderer alone
  double idle_exit = 0;      ///< leave after so many seconds without a job; 0: never
};

struct WorkerPoolReport {
  std::uint64_t jobs = 0;
  double busy_seconds = 0;  ///< of all slots together
  double seconds = 0;
};

/// Serves until `control` is cancelled; then finishes the jobs in hand, answers them and leaves. Logs that it
/// is ready once its cache is there, and a line per job with the broker's number of it. Throws Error for
/// options that make no sense and a cache that cannot be written.
WorkerPoolReport run_workers(const WorkerPoolOptions& options, const Control& control);

}  // namespace ssphh::farm
