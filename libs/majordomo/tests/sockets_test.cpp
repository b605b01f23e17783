/// Our broker, worker and client over real sockets on loopback.

#include <atomic>
#include <map>

#include <ssphh/core/error.h>

#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Sockets, CallThroughOurPeers) {
  RunningBroker broker;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "echo"}, echo);
  Client client({.endpoint = broker.endpoint()});
  EXPECT_THAT(client.call("echo", {"a", "", "b"}), ElementsAre("a", "", "b"));
  EXPECT_THAT(client.call("mmi.service", {"echo"}), ElementsAre("200"));
  const Frames workers = client.call("mmi.workers", {""});
  EXPECT_THAT(workers.at(1), HasSubstr("\"echo\""));
}

TEST(Sockets, ManyRequestsManyWorkers) {
  RunningBroker broker;
  std::vector<std::unique_ptr<RunningWorker>> workers;
  for (int i = 0; i < 4; ++i)
    workers.push_back(std::make_unique<RunningWorker>(
        WorkerOptions{.endpoint = broker.endpoint(), .service = "echo"}, echo));
  Client client({.endpoint = broker.endpoint()});
  std::map<std::string, std::string> expected;
  for (int i = 0; i < 3000; ++i) {
    const std::string body = "request " + std::to_string(i);
    expected[client.submit("echo", {body}).hex()] = body;
  }
  std::map<std::string, int> seen;
  while (client.outstanding() > 0) {
    const auto event = client.poll(10'000);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->outcome, Outcome::ok) << event->reason;
    EXPECT_THAT(event->body, ElementsAre(expected.at(event->id.hex())));
    ++seen[event->id.hex()];
  }
  EXPECT_EQ(seen.size(), 3000u);
  for (const auto& [id, count] : seen) EXPECT_EQ(count, 1);
}

TEST(Sockets, LargeBodiesAndPartials) {
  RunningBroker broker;
  const std::string large(3 << 20, 'x');
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "parts"}, [](const Job& job) {
    job.partial({"one"});
    job.partial({"two"});
    return job.body;
  });
  Client client({.endpoint = broker.endpoint()});
  EXPECT_THAT(client.call("parts", {large}), ElementsAre("one", "two", large));
}

TEST(Sockets, FailuresAreTold) {
  RunningBroker broker;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "fail"}, [](const Job&) -> Frames {
    throw Error("scene.glb", "is broken", "export it again");
  });
  Client client({.endpoint = broker.endpoint()});
  try {
    client.call("fail", {"x"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("scene.glb: is broken"));
  }
}

TEST(Sockets, DeadlineAndCancel) {
  RunningBroker broker;
  Client client({.endpoint = broker.endpoint()});
  client.submit("nobody", {"x"}, {.deadline = 100});
  auto event = client.poll(5000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::expired);
  client.cancel(client.submit("nobody", {"x"}));
  event = client.poll(5000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::cancelled);
}

TEST(Sockets, CancelStopsTheComputation) {
  RunningBroker broker;
  std::atomic<bool> started = false, stopped = false;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "long"}, [&](const Job& job) -> Frames {
    started = true;
    while (!job.cancel->requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stopped = true;
    throw Cancelled();
  });
  Client client({.endpoint = broker.endpoint()});
  const RequestId id = client.submit("long", {"x"});
  while (!started) client.poll(10);
  client.cancel(id);
  for (int i = 0; i < 500 && !stopped; ++i)
    client.poll(10), std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_TRUE(stopped);
}

TEST(Sockets, VanishedClientsComputationStops) {
  BrokerOptions options;
  options.timers.client_grace = 100;
  RunningBroker broker(options);
  std::atomic<bool> started = false, stopped = false;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "long"}, [&](const Job& job) -> Frames {
    started = true;
    while (!job.cancel->requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stopped = true;
    throw Cancelled();
  });
  {
    Client client({.endpoint = broker.endpoint()});
    client.submit("long", {"x"});
    while (!started) client.poll(10);
  }
  for (int i = 0; i < 2000 && !stopped; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_TRUE(stopped);
}

TEST(Sockets, AbandonHandsTheJobToAnotherWorker) {
  RunningBroker broker;
  std::atomic<bool> started = false;
  auto first = std::make_unique<RunningWorker>(
      WorkerOptions{.endpoint = broker.endpoint(), .service = "job", .name = "first"},
      [&](const Job& job) -> Frames {
        started = true;
        while (true) {
          job.control().check();
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      });
  Client client({.endpoint = broker.endpoint()});
  client.submit("job", {"x"});
  while (!started) client.poll(10);
  RunningWorker second({.endpoint = broker.endpoint(), .service = "job", .name = "second"}, echo);
  (**first).abandon();
  first->join();
  const auto event = client.poll(10'000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::ok);
}

TEST(Sockets, WorkersComeBackAndClientsAskAgainAfterABrokerRestart) {
  TempDir dir;
  const std::string endpoint = "ipc://" + (dir / "broker").string();
  auto broker = std::make_unique<RunningBroker>(BrokerOptions{.bind = endpoint});
  RunningWorker worker({.endpoint = endpoint, .service = "late", .reconnect = 50}, echo);
  Client client({.endpoint = endpoint});
  EXPECT_THAT(client.call("late", {"1"}), ElementsAre("1"));
  broker->end();
  client.submit("late", {"2"});
  broker = std::make_unique<RunningBroker>(BrokerOptions{.bind = endpoint});
  const auto event = client.poll(15'000);
  ASSERT_TRUE(event);
  EXPECT_THAT(event->body, ElementsAre("2"));
}

TEST(Sockets, StoreSurvivesTheBrokerAndTheClient) {
  TempDir dir;
  const RequestId id = RequestId::random();
  const RequestOptions persistent{.persistent = true, .id = id};
  {
    RunningBroker broker({.store = dir / "store"});
    Client client({.endpoint = broker.endpoint()});
    client.submit("gen", {"scene"}, persistent);
    EXPECT_FALSE(client.poll(300));
    EXPECT_THROW(Broker({.bind = "tcp://127.0.0.1:0", .store = dir / "store"}), Error)
        << "the store is in use";
  }
  {
    RunningBroker broker({.store = dir / "store"});
    std::atomic<int> runs = 0;
    RunningWorker worker({.endpoint = broker.endpoint(), .service = "gen"}, [&](const Job& job) {
      ++runs;
      return job.body;
    });
    for (int i = 0; i < 1000 && runs == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(runs, 1) << "nobody is there to ask, and it runs";
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  RunningBroker broker({.store = dir / "store"});
  Client client({.endpoint = broker.endpoint()});
  client.submit("gen", {"scene"}, persistent);
  const auto event = client.poll(5000);
  ASSERT_TRUE(event);
  EXPECT_THAT(event->body, ElementsAre("scene"));
}

TEST(Metrics, AreServedToPrometheus) {
  BrokerOptions options;
  options.metrics_bind = "tcp://127.0.0.1:0";
  RunningBroker broker(options);
  zmq::context_t context;
  zmq::socket_t http(context, zmq::socket_type::stream);
  http.set(zmq::sockopt::linger, 0);
  http.connect((*broker).metrics_endpoint());
  std::string text, peer;
  for (const Millis end = steady_now() + 5000;
       steady_now() < end && text.find("jobs_queued 0") == text.npos;) {
    zmq::pollitem_t item{http.handle(), 0, ZMQ_POLLIN, 0};
    zmq::poll(&item, 1, std::chrono::milliseconds(20));
    while (const auto message = receive_message(http)) {
      if (peer.empty()) {
        peer = message->frames.at(0);
        send_message(http, &peer, {"GET /metrics HTTP/1.1\r\n\r\n"}, nullptr);
      }
      text += message->frames.at(1);
    }
  }
  EXPECT_THAT(text, HasSubstr("HTTP/1.1 200 OK"));
  EXPECT_THAT(text, HasSubstr("ssphh_broker_jobs_queued 0"));
}

}  // namespace
}  // namespace ssphh::majordomo::test
