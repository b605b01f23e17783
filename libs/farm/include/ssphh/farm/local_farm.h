#pragma once
/// A farm of this machine alone, for one command: a broker and workers as child processes.

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
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

/// Exit code of a worker that would fail again in the same way.
inline constexpr int never_retry = 42;

/// Children talk through a socket in a private temporary folder, which also holds their logs. A worker that
/// dies is started again, some times, but not where it ended with never_retry. They end with this object, and
/// when this process dies in any way.
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
  int broker_pid() const;  ///< −1: it has ended
  /// Why no job will be done any more, for the caller to tell: the broker has ended, or no worker is left,
  /// how, and the end of its log. Empty: jobs are done.
  std::string failure() const;
  /// Starts the broker again if it has ended, and workers that were given up. Throws Error as the
  /// constructor.
  void restart();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ssphh::farm
