// What `ssphh broker` is told reaches the broker in its own units, and what it says when it listens.

#include "options/broker_settings.h"

#include <csignal>

#include <gtest/gtest.h>

#include "json_text.h"
#include "tool.h"

namespace ssphh::app {
namespace {

TEST(BrokerSettings, AreConverted) {
  BrokerSettings settings;
  settings.broker.bind = "ipc:///tmp/x";
  settings.worker_expiry = 9.5, settings.drain = 0.25, settings.attempt_timeout = 12;
  settings.frame_mb = 3, settings.client_mb = 5;
  const majordomo::BrokerOptions options = broker_options(settings);
  EXPECT_EQ(options.bind, "ipc:///tmp/x");
  EXPECT_EQ(options.timers.worker_expiry, 9500);
  EXPECT_EQ(options.drain, 250);
  EXPECT_EQ(options.timers.attempt_timeout, 12000);
  EXPECT_EQ(options.limits.frame_bytes, 3145728u);
  EXPECT_EQ(options.limits.client_bytes, 5242880u);
  EXPECT_EQ(options.least_event, LogLevel::info);
  EXPECT_FALSE(options.security.has_value());
  settings.verbose = true;
  EXPECT_EQ(broker_options(settings).least_event, LogLevel::debug);
  settings.keys = "/nonexistent/keys";
  EXPECT_THROW(broker_options(settings), Error);
}

TEST(BrokerSettings, TheReadyEventNamesItsEndpoints) {
  const json::Value ready = test::parse_json(ready_event("tcp://a:1", "tcp://b:2").json());
  EXPECT_EQ(ready["event"], "broker-ready");
  EXPECT_EQ(ready["endpoint"], "tcp://a:1");
  EXPECT_EQ(ready["metrics"], "tcp://b:2");
  EXPECT_FALSE(test::parse_json(ready_event("tcp://a:1", "").json()).contains("metrics"));
}

TEST(BrokerSettings, TheToolPrintsItsEndpointAndEndsWhenAsked) {
  const test::TempDir dir;
  const std::string endpoint = "ipc://" + (dir / "broker").string();
  test::ToolProcess broker({"broker", "--bind", endpoint});
  ASSERT_TRUE(broker.wait_for_stderr("broker-ready"));
  broker.signal(SIGTERM);
  const test::ToolResult result = broker.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, endpoint + "\n");
}

}  // namespace
}  // namespace ssphh::app
