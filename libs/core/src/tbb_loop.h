#pragma once
/// Loops on oneTBB's threads, in an arena of the library's own.

#include <cstddef>

#include <ssphh/core/parallel.h>

namespace ssphh {

struct RangeLoop {
  std::size_t count, grain;
  const RangeBody& body;
  const Control& control;

  std::size_t chunks() const { return (count + grain - 1) / grain; }
  void run(std::size_t chunk) const {
    control.check();
    body(chunk * grain, chunk + 1 < chunks() ? (chunk + 1) * grain : count);
  }
};

void run_on_tbb(const RangeLoop& loop);

/// What set_thread_count() chose, resolved.
int tbb_thread_count();

}  // namespace ssphh
