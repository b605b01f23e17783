#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>

namespace ssphh {
namespace {

TEST(ParallelFor, CoversEveryIndexOnceInRangesOfAtMostTheGrain) {
  for (const std::size_t count : {0, 1, 7, 64, 1000}) {
    std::vector<std::atomic<int>> seen(count);
    std::atomic<bool> too_long = false;
    parallel_for(count, 7, [&](std::size_t begin, std::size_t end) {
      if (end - begin > 7) too_long = true;
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& times : seen) EXPECT_EQ(times, 1);
    EXPECT_FALSE(too_long);
  }
}

// What is summed range by range has the same bits on every machine.
TEST(ParallelFor, RangesAreTheSameOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    std::vector<std::atomic<std::size_t>> end_of(100);
    parallel_for(100, 7, [&](std::size_t begin, std::size_t end) { end_of[begin] = end; });
    for (std::size_t i = 0; i < 100; ++i)
      EXPECT_EQ(end_of[i], i % 7 != 0 ? 0 : std::min<std::size_t>(i + 7, 100)) << i << " of " << threads;
  }
  set_thread_count(0);
}

TEST(ParallelFor, RethrowsTheBodysException) {
  EXPECT_THROW(parallel_for(100, 1,
                            [](std::size_t i, std::size_t) {
                              if (i == 50) throw Error("here", "broken");
                            }),
               Error);
}

TEST(ParallelFor, StopsWhenCancelled) {
  CancelToken token;
  std::atomic<int> calls = 0;
  const Control control{nullptr, &token};
  EXPECT_THROW(parallel_for(
                   100000, 1,
                   [&](std::size_t, std::size_t) {
                     ++calls;
                     token.request();
                   },
                   control),
               Cancelled);
  EXPECT_LT(calls, 100000);
}

#ifdef SSPHH_THREAD_SANITIZER
// parallel_for tells the sanitizer of its fork and join. Told too much, it would find nothing any more.
TEST(ParallelForDeathTest, ARaceBetweenRangesIsReported) {
  if (thread_count() < 2) GTEST_SKIP() << "one hardware thread";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  constexpr int reported = 66, one_thread = 2;
  /// Whether two threads ran a range each, one after the other, with nothing but time between them.
  const auto race = [] {
    int shared = 0;
    std::atomic<int> step = 0;
    std::atomic<bool> met = true;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    const auto wait_for = [&](int wanted) {
      while (step.load(std::memory_order_relaxed) < wanted) {
        if (std::chrono::steady_clock::now() < end) continue;
        met.store(false, std::memory_order_relaxed);
        return;
      }
    };
    parallel_for(2, 1, [&](std::size_t range, std::size_t) {
      step.fetch_add(1, std::memory_order_relaxed);
      wait_for(range == 0 ? 2 : 3);
      ++shared;
      step.fetch_add(1, std::memory_order_relaxed);
    });
    return met.load(std::memory_order_relaxed) && shared > 0;
  };
  // Where other work keeps TBB's second thread from coming, one runs both ranges, and races with nobody.
  const auto race_in_time = [&] {
    for (int tries = 0; tries < 20; ++tries) {
      if (race()) std::exit(0);  // ThreadSanitizer turns it into its own code where it has reported
    }
    std::exit(one_thread);
  };
  EXPECT_EXIT(race_in_time(), testing::ExitedWithCode(reported), "data race")
      << "exit code " << one_thread << ": a minute was too short for two threads to meet";
}
#endif

TEST(Threads, CountCanBeLimitedAndRestored) {
  set_thread_count(1);
  EXPECT_EQ(thread_count(), 1);
  set_thread_count(0);
  EXPECT_GE(thread_count(), 1);
}

}  // namespace
}  // namespace ssphh
