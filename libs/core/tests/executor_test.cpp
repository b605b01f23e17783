/// Loops on a caller's job system.

#include <atomic>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>

#include "toy_executor.h"

namespace ssphh {
namespace {

using test::OnExecutor;
using test::ToyExecutor;

TEST(Executor, RunsEveryRangeOnce) {
  for (const int threads : {1, 2, 5}) {
    ToyExecutor pool(threads);
    const OnExecutor on(pool);
    EXPECT_EQ(thread_count(), threads);
    for (const std::size_t count : {0, 1, 7, 64, 1000}) {
      std::vector<std::atomic<int>> seen(count);
      parallel_for(count, 7, [&](std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, 7u);
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
      });
      for (const auto& times : seen) EXPECT_EQ(times, 1);
    }
    EXPECT_EQ(pool.started() > 0, threads > 1) << "one thread needs no other";
  }
}

// All threads of the pool wait for loops within at once: none may wait for a thread that never comes.
TEST(Executor, LoopsNest) {
  ToyExecutor pool(4);
  const OnExecutor on(pool);
  std::vector<int> sums(64);
  parallel_for(sums.size(), 1, [&](std::size_t i) {
    std::vector<int> parts(100);
    parallel_for(parts.size(), 3, [&](std::size_t k) {
      std::atomic<int> depth = 0;
      parallel_for(4, 1, [&](std::size_t) { ++depth; });
      parts[k] = static_cast<int>(i + k) * depth / 4;
    });
    sums[i] = std::accumulate(parts.begin(), parts.end(), 0);
  });
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], static_cast<int>(100 * i) + 4950);
}

TEST(Executor, SeveralThreadsRunLoopsAtOnce) {
  ToyExecutor pool(3);
  const OnExecutor on(pool);
  std::vector<std::thread> callers;
  std::atomic<int> all = 0;
  for (int c = 0; c < 3; ++c) {
    callers.emplace_back([&] {
      for (int i = 0; i < 50; ++i) parallel_for(20, 1, [&](std::size_t) { ++all; });
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(all, 3 * 50 * 20);
}

TEST(Executor, RethrowsTheBodysExceptionAndStops) {
  ToyExecutor pool(3);
  const OnExecutor on(pool);
  std::atomic<int> calls = 0;
  EXPECT_THROW(parallel_for(100000, 1,
                            [&](std::size_t) {
                              if (++calls == 50) throw Error("here", "broken");
                            }),
               Error);
  EXPECT_LT(calls, 100000);
  CancelToken token;
  token.request();
  EXPECT_THROW(parallel_for(10, 1, [](std::size_t) {}, {nullptr, &token}), Cancelled);
}

// The same for oneTBB: callers beyond the arena's threads, and loops within.
TEST(ParallelFor, SeveralThreadsRunNestedLoopsAtOnce) {
  for (const int threads : {1, 2, 0}) {
    set_thread_count(threads);
    std::vector<std::thread> callers;
    std::atomic<int> all = 0;
    for (int c = 0; c < 24; ++c) {
      callers.emplace_back([&] {
        for (int i = 0; i < 10; ++i) {
          parallel_for(8, 1, [&](std::size_t) { parallel_for(5, 1, [&](std::size_t) { ++all; }); });
        }
      });
    }
    for (std::thread& caller : callers) caller.join();
    EXPECT_EQ(all, 24 * 10 * 8 * 5);
  }
  set_thread_count(0);
}

TEST(ParallelFor, WithinThreadCountRethrows) {
  int calls = 0;
  within_thread_count([&] { ++calls; });
  EXPECT_EQ(calls, 1);
  EXPECT_THROW(within_thread_count([] { throw Error("here", "broken"); }), Error);
}

}  // namespace
}  // namespace ssphh
