#pragma once
/// The scenes of a worker: on disk by content, in memory ready for rays.

#include <functional>
#include <list>
#include <memory>
#include <mutex>

#include <ssphh/core/control.h>
#include <ssphh/farm/disk_cache.h>
#include <ssphh/farm/job.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::farm {

/// This worker cannot do the job (a full disk, a client that is gone); another may.
struct BlobUnavailable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bytes [offset, offset + length) of a blob of the package, from whoever has it. May give fewer, not none.
using FetchChunk = std::function<std::vector<std::byte>(const Hash128& package, const Hash128& blob,
                                                        std::uint64_t offset, std::uint64_t length)>;

/// A blob from the cache, or fetched in chunks into DIR/KEY.part, where an interrupted transfer continues,
/// also another process's. Throws BlobUnavailable when it does not arrive whole or cannot be kept.
std::vector<std::byte> fetch_blob(DiskCache& cache, const Hash128& package, const Hash128& blob,
                                  std::uint64_t size, const FetchChunk& fetch, const Control& control);

struct PreparedScene {
  scene::Scene scene;
  trace::SharedGeometry geometry;
  std::unique_ptr<trace::PathTracer> tracer;
};

/// Safe to call from several threads; one loads at a time.
class SceneStore {
 public:
  /// Keeps the `keep` scenes last used in memory, 1 at least; else throws Error.
  explicit SceneStore(DiskCache& cache, std::size_t keep = 2);

  /// Throws Error when the package is another scene than `ref.light` says.
  std::shared_ptr<const PreparedScene> get(const SceneRef& ref, const FetchChunk& fetch,
                                           const Control& control);
  DiskCache& cache() { return cache_; }

 private:
  struct Entry {
    SceneRef ref;
    std::shared_ptr<const PreparedScene> scene;
  };
  DiskCache& cache_;
  std::size_t keep_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the last used first
};

}  // namespace ssphh::farm
