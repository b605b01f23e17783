#pragma once
/// Data-parallel loops. Results must not depend on the number of threads: let each range write its own
/// outputs and reduce them afterwards in index order.

#include <concepts>
#include <cstddef>
#include <functional>

#include <ssphh/core/control.h>

namespace ssphh {

/// Limits the worker threads of this process; 0 means all hardware threads.
void set_thread_count(int count);
int thread_count();

/// Calls body(begin, end) for disjoint ranges of at most `grain` indices that cover [0, count), on all
/// threads. Exceptions from the body are rethrown here. Throws Cancelled when `control` is cancelled before
/// the loop is done (ranges that have begun are finished).
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body, const Control& control = {});

/// The same for a body that takes one index.
template <std::invocable<std::size_t> Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body, const Control& control = {}) {
  const auto range = [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  };
  parallel_for(count, grain, range, control);
}

}  // namespace ssphh
