#include "options/worker_settings.h"

#include <algorithm>

namespace ssphh::app {

farm::WorkerPoolOptions pool_options(const WorkerSettings& settings) {
  farm::WorkerPoolOptions options = settings.pool;
  options.broker = broker_address(settings.broker);
  options.cache =
      settings.cache.empty() ? farm::default_cache_dir("scenes") : std::filesystem::path(settings.cache);
  options.cache_bytes = settings.cache_mb << 20;
  return options;
}

int shared_threads(int threads, int slots) {
  return std::max(1, threads - slots + 1);
}

}  // namespace ssphh::app
