/// A broker on its socket: how its time begins, what it hears while nobody speaks, how it ends.

#include <atomic>

#include <ssphh/core/log.h>

#include "json_text.h"
#include "socket_peers.h"
#include "told.h"

namespace ssphh::majordomo::test {
namespace {

/// Silent peers are left alone for ten minutes, and what ends does so within a minute of being asked.
BrokerOptions patient() {
  BrokerOptions options;
  options.timers.heartbeat = 150'000, options.timers.worker_expiry = 600'000;
  options.timers.client_grace = 600'000;
  options.drain = 60'000;
  return options;
}

// No message, no heartbeat and no timer comes meanwhile: only its monitor tells the broker.
TEST(BrokerLife, HearsOfAConnectionsEndThoughNobodySpeaks) {
  Told told;
  RunningBroker broker(patient(), std::ref(told));
  {
    RawPeer worker(zmq::socket_type::dealer, broker.endpoint());
    worker.send({"MDPW02", "\x01", "echo"});
    ASSERT_TRUE(told.wait_for("worker-ready"));
  }
  EXPECT_TRUE(told.wait_for("worker-lost"));
  EXPECT_TRUE(told.last().ends_with("service=echo reason=\"connection lost\"")) << told.last();
}

TEST(BrokerLife, TimeBeginsWhenItIsMade) {
  const Millis before = steady_now();
  RunningBroker broker;
  const Millis made = steady_now();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  Client client({.endpoint = broker.endpoint()});
  const Millis asked = steady_now();
  const std::string stats = client.call("mmi.stats", {""}).at(1);
  const double uptime = ssphh::test::parse_json(stats)["uptime_ms"].number();
  EXPECT_GE(uptime, static_cast<double>(asked - made));
  EXPECT_LE(uptime, static_cast<double>(steady_now() - before));
}

TEST(BrokerLife, StoppedItLetsJobsFinishAndTakesNoMore) {
  Told told;
  RunningBroker broker(patient(), std::ref(told));
  std::atomic<bool> started = false, released = false;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "job", .name = "w"}, [&](const Job& job) {
    started = true;
    while (!released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return job.body;
  });
  Client client({.endpoint = broker.endpoint()});
  const RequestId first = client.submit("job", {"first"});
  while (!started) client.poll(10);
  (*broker).stop();
  ASSERT_TRUE(told.wait_for("broker-draining running=1 queued=0"));
  client.submit("job", {"second"});
  EXPECT_FALSE(client.poll(50)) << "the broker waits for the first";
  released = true;
  const auto event = client.poll(10'000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->id, first);
  EXPECT_EQ(event->outcome, Outcome::ok);
  EXPECT_TRUE(told.wait_for("broker-ended"));
  EXPECT_EQ(told.last(), "broker-ended");
}

/// A worker that takes the one job and never answers it.
struct Hanging : testing::Test {
  void begin(BrokerOptions options) {
    broker = std::make_unique<RunningBroker>(std::move(options), std::ref(told));
    worker = std::make_unique<RawPeer>(zmq::socket_type::dealer, broker->endpoint());
    worker->send({"MDPW02", "\x01", "job"});
    client = std::make_unique<RawPeer>(zmq::socket_type::dealer, broker->endpoint());
    client->send({"MDPC02", "\x01", "job", "x"});
    EXPECT_EQ(worker->receive().size(), 5u);
  }
  Told told;
  std::unique_ptr<RunningBroker> broker;
  std::unique_ptr<RawPeer> worker, client;
};

TEST_F(Hanging, JobIsWaitedForAsLongAsTheDrainLasts) {
  BrokerOptions options = patient();
  options.drain = 60;
  begin(options);
  const Millis asked = steady_now();
  (**broker).stop();
  EXPECT_TRUE(told.wait_for("broker-ended"));
  EXPECT_GE(steady_now() - asked, 60);
  EXPECT_EQ(worker->receive(), (Frames{"MDPW02", "\x06"})) << "it is told that there is no broker any more";
}

TEST_F(Hanging, JobIsNotWaitedForOnceTheBrokerIsStoppedAgain) {
  begin(patient());
  (**broker).stop();
  ASSERT_TRUE(told.wait_for("broker-draining"));
  (**broker).stop();
  EXPECT_TRUE(told.wait_for("broker-ended")) << "the drain would last for a minute";
}

TEST(BrokerLife, WithoutAListenerItLogs) {
  std::vector<std::string> lines;
  const LogSink before = set_log_sink([&](LogLevel level, const std::string& text) {
    lines.push_back(std::string(name_of(level)) + " " + text);
  });
  BrokerOptions options;
  options.bind = "tcp://127.0.0.1:0";
  Broker broker(options);
  broker.stop();
  broker.run();
  set_log_sink(before);
  EXPECT_THAT(lines, testing::ElementsAre("info broker-draining running=0 queued=0", "info broker-ended"));
}

}  // namespace
}  // namespace ssphh::majordomo::test
