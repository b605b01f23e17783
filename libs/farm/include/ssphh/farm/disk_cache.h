#pragma once
/// A bounded folder of values by 128-bit key, shared by any number of processes.

#include <filesystem>
#include <mutex>
#include <optional>
#include <span>

#include <ssphh/core/hash.h>

namespace ssphh::farm {

/// Files DIR/xx/KEY: the value, then its hash. Written atomically; read back and checked; the longest unused
/// ones go when the bound is reached. Safe to call from several threads.
class DiskCache {
 public:
  /// Makes the folder. Throws Error when it cannot be written. `max_bytes` counts values alone.
  DiskCache(std::filesystem::path dir, std::uint64_t max_bytes);

  /// None when it is not there; a damaged entry is removed with a warning.
  std::optional<std::vector<std::byte>> get(const Hash128& key);
  bool contains(const Hash128& key) const;
  /// Throws Error when the value is larger than the bound, and with the system's reason when it cannot be
  /// written, e.g. on a full disk.
  void put(const Hash128& key, std::span<const std::byte> value);

  struct Counts {
    std::uint64_t hits = 0, misses = 0, damaged = 0, evicted = 0;
  };
  Counts counts() const;
  const std::filesystem::path& dir() const { return dir_; }
  std::uint64_t max_bytes() const { return max_bytes_; }

 private:
  std::filesystem::path path(const Hash128& key) const;
  void make_room(std::uint64_t size);

  std::filesystem::path dir_;
  std::uint64_t max_bytes_;
  mutable std::mutex mutex_;
  std::uint64_t bytes_ = 0;      ///< as of the last look at the folder, and what was put since
  std::uint64_t put_since_ = 0;  ///< other processes may have put as much
  Counts counts_;
};

/// Where the user's caches lie: $XDG_CACHE_HOME/ssphh/NAME, or ~/.cache/ssphh/NAME.
std::filesystem::path default_cache_dir(const std::string& name);

}  // namespace ssphh::farm
