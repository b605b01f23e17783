#pragma once
/// What `ssphh worker` may be told, in the units of its options.

#include <string>

#include <ssphh/farm/worker_pool.h>

#include "options/farm_options.h"

namespace ssphh::app {

struct WorkerSettings {
  BrokerChoice broker;
  farm::WorkerPoolOptions pool;    ///< those that need no conversion
  std::string cache;               ///< folder; empty: the user's own
  std::uint64_t cache_mb = 20480;  ///< of the folder
  int threads = 0;                 ///< of all jobs together; 0: all
};

/// The pool's own options. Throws Error as broker_address() does.
farm::WorkerPoolOptions pool_options(const WorkerSettings& settings);

/// Threads that remain for all jobs together where each of `slots` has one of its own; at least one.
int shared_threads(int threads, int slots);

}  // namespace ssphh::app
