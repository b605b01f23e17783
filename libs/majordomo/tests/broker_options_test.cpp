/// What a broker on a socket does not begin with.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/majordomo/broker.h>

namespace ssphh::majordomo::test {
namespace {

BrokerOptions silent_for(Millis worker_expiry, Millis heartbeat) {
  BrokerOptions options;
  options.bind = "tcp://127.0.0.1:0";
  options.timers.worker_expiry = worker_expiry;
  options.timers.heartbeat = heartbeat;
  return options;
}

TEST(BrokerOptions, WorkersMayBeSilentForThreeHeartbeats) {
  EXPECT_NO_THROW(Broker(silent_for(7500, 2500)));
  EXPECT_THROW(Broker(silent_for(7499, 2500)), Error);
  EXPECT_NO_THROW(Broker(silent_for(300, 100)));
  EXPECT_THROW(Broker(silent_for(299, 100)), Error);
  EXPECT_NO_THROW(Broker(silent_for(3, 1)));
  EXPECT_THROW(Broker(silent_for(3, 0)), Error) << "would do nothing but beat";
}

}  // namespace
}  // namespace ssphh::majordomo::test
