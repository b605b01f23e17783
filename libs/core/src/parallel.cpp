#include <algorithm>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

#include "fork_join.h"

namespace ssphh {
namespace {

std::unique_ptr<tbb::global_control>& limit() {
  static std::unique_ptr<tbb::global_control> instance;
  return instance;
}

}  // namespace

void set_thread_count(int count) {
  require(count >= 0, "thread count", "it must not be negative");
  limit().reset();
  if (count > 0) {
    limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
  }
}

int thread_count() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(
      std::min<std::size_t>(allowed, static_cast<std::size_t>(tbb::info::default_concurrency())));
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body, const Control& control) {
  require(grain > 0, "parallel loop", "its grain must be over 0");
  require(body != nullptr, "parallel loop", "it has no body");
  ForkJoin loop;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, (count + grain - 1) / grain, 1),
      [&](const tbb::blocked_range<std::size_t>& chunks) {
        for (std::size_t chunk = chunks.begin(); chunk != chunks.end(); ++chunk) {
          const ForkJoin::Chunk within(loop);
          control.check();
          body(chunk * grain, std::min(count, (chunk + 1) * grain));
        }
      },
      tbb::simple_partitioner());
}

}  // namespace ssphh
