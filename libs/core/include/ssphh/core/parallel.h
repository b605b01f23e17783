#pragma once
/// Data-parallel loops. Results must not depend on the number of threads: let each range write its own
/// outputs and reduce them afterwards in index order. Loops take no memory (operator new), may nest, and may
/// be run by several threads at once.

#include <concepts>
#include <cstddef>

#include <ssphh/core/control.h>

namespace ssphh {

/// Limits the threads of the library: a loop runs on the thread that calls it and count − 1 others, which all
/// loops share; 0 means all hardware threads. Changes nothing of oneTBB outside the library's own arena, and
/// nothing of an Executor. Safe at any time; loops that run keep their number.
void set_thread_count(int count);
/// Threads that a loop may use, its own included: those of the executor, if one is set.
int thread_count();

/// What takes the ranges [begin, end) of a loop; refers to it, so that no loop takes memory.
class RangeBody {
 public:
  RangeBody(std::nullptr_t) {}
  template <std::invocable<std::size_t, std::size_t> Body>
  RangeBody(const Body& body)
      : body_(&body), call_([](const void* b, std::size_t begin, std::size_t end) {
          (*static_cast<const Body*>(b))(begin, end);
        }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(body_, begin, end); }
  bool operator==(std::nullptr_t) const { return call_ == nullptr; }

 private:
  const void* body_ = nullptr;
  void (*call_)(const void*, std::size_t, std::size_t) = nullptr;
};

/// Calls body(begin, end) for disjoint ranges of at most `grain` indices that cover [0, count), on all
/// threads. Exceptions from the body are rethrown here. Throws Cancelled when `control` is cancelled before
/// the loop is done (ranges that have begun are finished).
void parallel_for(std::size_t count, std::size_t grain, const RangeBody& body, const Control& control = {});

/// Calls a body that takes one index, for each of them.
template <std::invocable<std::size_t> Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body, const Control& control = {}) {
  const auto range = [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  };
  parallel_for(count, grain, RangeBody(range), control);
}

/// Calls `work` where no more than thread_count() threads of oneTBB serve it: for libraries that use oneTBB
/// themselves, as Embree does to build. Its exceptions are rethrown here.
void within_thread_count(void (*work)(void* data), void* data);
template <std::invocable Work>
void within_thread_count(Work work) {
  within_thread_count([](void* data) { (*static_cast<Work*>(data))(); }, &work);
}

}  // namespace ssphh
