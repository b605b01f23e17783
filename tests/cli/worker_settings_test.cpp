// What `ssphh worker` is told reaches its pool in the pool's units.

#include "options/worker_settings.h"

#include <gtest/gtest.h>

#include <ssphh/farm/engine.h>

namespace ssphh::app {
namespace {

TEST(WorkerSettings, AreConverted) {
  WorkerSettings settings;
  settings.broker.endpoint = "tcp://127.0.0.1:7";
  settings.pool.slots = 3, settings.pool.name = "n", settings.pool.idle_exit = 2.5;
  settings.cache = "/tmp/x", settings.cache_mb = 3;
  const farm::WorkerPoolOptions options = pool_options(settings);
  EXPECT_EQ(options.broker.endpoint, "tcp://127.0.0.1:7");
  EXPECT_EQ(options.cache, "/tmp/x");
  EXPECT_EQ(options.cache_bytes, 3145728u);
  EXPECT_EQ(options.slots, 3);
  EXPECT_EQ(options.name, "n");
  EXPECT_EQ(options.idle_exit, 2.5);
  settings.cache.clear();
  EXPECT_EQ(pool_options(settings).cache, farm::default_cache_dir("scenes"));
  EXPECT_EQ(WorkerSettings().cache_mb, 20480u) << "20 GB";
}

TEST(WorkerSettings, EverySlotHasAThreadAndTheOthersAreShared) {
  EXPECT_EQ(shared_threads(8, 1), 8);
  EXPECT_EQ(shared_threads(8, 3), 6);
  EXPECT_EQ(shared_threads(2, 2), 1);
  EXPECT_EQ(shared_threads(2, 9), 1);
}

}  // namespace
}  // namespace ssphh::app
