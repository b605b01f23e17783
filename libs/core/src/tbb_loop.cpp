#include "tbb_loop.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <ssphh/core/require.h>

#include "fork_join.h"

namespace ssphh {
namespace {

/// Threads of the caller that may run loops in an arena at once without waiting for each other.
constexpr int callers = 16;

std::atomic<int> wanted{0};

/// One arena for each number of threads that was ever asked for, so that none ends under a loop. Never
/// destroyed: loops may still run when statics are.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static auto& arenas = *new std::map<int, std::unique_ptr<tbb::task_arena>>();
  const std::scoped_lock lock(mutex);
  std::unique_ptr<tbb::task_arena>& arena = arenas[threads];
  if (!arena) arena = std::make_unique<tbb::task_arena>(threads - 1 + callers, callers);
  return *arena;
}

/// Whether this thread works on a loop already: then the arena and its isolation hold for loops within, too.
thread_local bool within = false;

class Within {
 public:
  Within() : before_(within) { within = true; }
  ~Within() { within = before_; }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  bool before_;
};

}  // namespace

void set_thread_count(int count) {
  require(count >= 0, "thread count", "it must not be negative");
  wanted = count;
}

int tbb_thread_count() {
  const int all = tbb::info::default_concurrency(), asked = wanted;
  return asked > 0 ? std::min(asked, all) : all;
}

void run_on_tbb(const RangeLoop& loop) {
  ForkJoin order;
  const auto spread = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, loop.chunks(), 1),
        [&](const tbb::blocked_range<std::size_t>& chunks) {
          const Within here;
          for (std::size_t chunk = chunks.begin(); chunk != chunks.end(); ++chunk) {
            const ForkJoin::Chunk ordered(order);
            loop.run(chunk);
          }
        },
        tbb::simple_partitioner());
  };
  if (within) {
    spread();
    return;
  }
  // Isolated: a thread that waits for the end of its own loop takes nothing of another caller's, which may be
  // long.
  arena_of(tbb_thread_count()).execute([&] { tbb::this_task_arena::isolate(spread); });
}

void within_thread_count(void (*work)(void*), void* data) {
  tbb::task_arena(std::min(thread_count(), tbb::info::default_concurrency()), 1).execute([&] { work(data); });
}

}  // namespace ssphh
