#pragma once
/// A farm of this machine alone, for one command: a broker and workers as child processes.

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include <ssphh/farm/blob_server.h>
#include <ssphh/farm/job.h>

namespace ssphh::farm {

struct LocalFarmOptions {
  std::filesystem::path tool;  ///< the ssphh program
  int workers = 2;
  Renderer renderer = Renderer::path;  ///< of the workers
  int threads = 0;                     ///< of each worker; 0: the machine's, divided
  std::filesystem::path cache;
  std::uint64_t cache_bytes = std::uint64_t{20} << 30;
  std::chrono::milliseconds look{100};  ///< after which it looks again for processes that have ended
};

/// Children talk through a socket in a private temporary folder, which also holds their logs. A worker that
/// dies is started again, some times. They end with this object, and when this process dies in any way.
class LocalFarm {
 public:
  /// Throws Error when a process cannot be started.
  explicit LocalFarm(LocalFarmOptions options);
  ~LocalFarm();
  LocalFarm(const LocalFarm&) = delete;
  LocalFarm& operator=(const LocalFarm&) = delete;

  BrokerAddress address() const;
  /// Process ids of the workers, as of now.
  std::vector<int> worker_pids() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ssphh::farm
