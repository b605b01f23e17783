// What the options of a farm mean in its own units.

#include "options/farm_options.h"

#include <gtest/gtest.h>

#include "error_message.h"

namespace ssphh::app {
namespace {

TEST(FarmOptions, ResultsAreKeptInAFolderUpToSoManyMegabytes) {
  FarmChoice choice;
  choice.cache = "/tmp/x", choice.cache_mb = 3;
  const std::optional<ResultCache> cache = result_cache(choice);
  ASSERT_TRUE(cache);
  EXPECT_EQ(cache->folder, "/tmp/x");
  EXPECT_EQ(cache->bytes, 3145728u);
  choice.cache.clear();
  EXPECT_EQ(result_cache(choice).value().folder, farm::default_cache_dir("results"));
  choice.cache = "none";
  EXPECT_FALSE(result_cache(choice));
  EXPECT_EQ(result_cache({}).value().bytes, 4294967296u) << "4 GB";
}

TEST(FarmOptions, AFarmIsAskedForByABrokerOrByWorkersHere) {
  FarmChoice none, one, broker;
  one.local = 1, broker.broker.endpoint = "ipc://x";
  EXPECT_FALSE(none.any());
  EXPECT_TRUE(one.any());
  EXPECT_TRUE(broker.any());
}

TEST(FarmOptions, AFarmElsewhereIsThatOfItsBroker) {
  FarmChoice choice;
  choice.broker.endpoint = "ipc:///nowhere", choice.cache = "none";
  const FarmSession session(choice);
  EXPECT_EQ(session.options().broker.endpoint, "ipc:///nowhere");
  EXPECT_EQ(session.options().results, nullptr);
  EXPECT_EQ(session.options().content, farm::ContentType::binary);
}

TEST(FarmOptions, MessagesThatAreKeptAreSentAsJson) {
  FarmChoice choice;
  choice.messages = "kept";
  EXPECT_EQ(test::message_of([&] { farm_session(choice); }),
            "--keep-messages: without a farm nothing is sent (add --local 1 or --broker)");
  choice.broker.endpoint = "ipc:///nowhere", choice.cache = "none";
  const FarmSession session(choice);
  EXPECT_EQ(session.options().messages, "kept");
  EXPECT_EQ(session.options().content, farm::ContentType::json);
}

}  // namespace
}  // namespace ssphh::app
