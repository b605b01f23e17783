/// Workers and clients on their sockets: what a handler is told and may do, and what becomes of the rest when
/// one request ends.

#include <algorithm>
#include <atomic>
#include <mutex>

#include <gmock/gmock.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>

#include "error_message.h"
#include "json_text.h"
#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;

TEST(PeerSocket, HasItsLimitsTimesAndKeys) {
  zmq::context_t context;
  const KeyPair own = make_key_pair(), broker = make_key_pair();
  const zmq::socket_t client = peer_socket(context, Side::client, PeerSecurity{broker.public_key, own});
  const zmq::socket_t worker = peer_socket(context, Side::worker, {});
  EXPECT_EQ(client.get(zmq::sockopt::linger), 500) << "until its cancellations are out";
  EXPECT_EQ(worker.get(zmq::sockopt::linger), 2000) << "until its result is out";
  for (const zmq::socket_t* socket : {&client, &worker}) {
    EXPECT_EQ(socket->get(zmq::sockopt::type), ZMQ_DEALER);
    EXPECT_EQ(socket->get(zmq::sockopt::maxmsgsize), 1 << 30);
    EXPECT_EQ(socket->get(zmq::sockopt::heartbeat_ivl), 1000);
    EXPECT_EQ(socket->get(zmq::sockopt::heartbeat_timeout), 6000);
  }
  EXPECT_EQ(client.get(zmq::sockopt::curve_serverkey), broker.public_key);
  EXPECT_EQ(client.get(zmq::sockopt::curve_publickey), own.public_key);
  EXPECT_EQ(client.get(zmq::sockopt::curve_secretkey), own.secret_key);
  EXPECT_EQ(worker.get(zmq::sockopt::mechanism), ZMQ_NULL);
}

TEST(RandomNames, AreTwelveDigitsAndNeverTwice) {
  const std::string a = random_name(), b = random_name();
  EXPECT_THAT(a, testing::MatchesRegex("[0-9a-f]{12}"));
  EXPECT_NE(a, b);
}

TEST(WorkerLife, WithoutANameItIsItsHostAndProcess) {
  RunningBroker broker;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "echo"}, echo);
  Client client({.endpoint = broker.endpoint()});
  client.call("echo", {"x"});
  const auto told = ssphh::test::parse_json(client.call("mmi.workers", {""}).at(1))["workers"];
  char host[256] = "";
  ::gethostname(host, sizeof host);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["name"], std::string(host) + ":" + std::to_string(::getpid()));
  EXPECT_EQ(told[0]["version"], "0.2");
}

// The same job fails on one worker and is done by the next; each knows which attempt it is.
TEST(WorkerLife, WhoCannotLetsAnotherTryAndBothAreCounted) {
  BrokerOptions options;
  options.timers.retry_backoff = 1;
  RunningBroker broker(options);
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, int>> seen;
  const Handler handler = [&](const Job& job) -> Frames {
    const std::lock_guard lock(mutex);
    seen.emplace_back(job.number, job.attempt);
    if (seen.size() == 2) throw std::runtime_error("no memory");
    return {"done"};
  };
  RunningWorker a({.endpoint = broker.endpoint(), .service = "job", .name = "a"}, handler);
  Client client({.endpoint = broker.endpoint()});
  EXPECT_THAT(client.call("job", {"x"}), ElementsAre("done"));
  RunningWorker b({.endpoint = broker.endpoint(), .service = "job", .name = "b"}, handler);
  EXPECT_THAT(client.call("job", {"y"}), ElementsAre("done"));
  {
    const std::lock_guard lock(mutex);
    EXPECT_THAT(seen, ElementsAre(std::pair(1u, 1), std::pair(2u, 1), std::pair(2u, 2)));
  }
  for (int i = 0; i < 1000 && (*a).served() + (*b).served() < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ((*a).served() + (*b).served(), 3u);
}

TEST(WorkerLife, WhyItCouldNotIsToldWhenNobodyIsLeft) {
  BrokerOptions options;
  options.limits.attempts = 1;
  RunningBroker broker(options);
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "job", .name = "w"},
                       [](const Job&) -> Frames { throw std::runtime_error("no memory"); });
  RunningWorker never({.endpoint = broker.endpoint(), .service = "never", .name = "n"},
                      [](const Job&) -> Frames { throw Error("scene", "is none", "take another"); });
  RunningWorker strange({.endpoint = broker.endpoint(), .service = "strange", .name = "s"},
                        [](const Job&) -> Frames { throw 5; });
  Client client({.endpoint = broker.endpoint()});
  const std::string hint = " (the broker's log and `mmi.parked` tell more)";
  EXPECT_EQ(ssphh::test::message_of([&] { client.call("job", {"x"}); }),
            "job: parked: failed on 1 worker; w: no memory" + hint);
  EXPECT_EQ(ssphh::test::message_of([&] { client.call("never", {"x"}); }),
            "never: failed: n: scene: is none (take another)" + hint);
  EXPECT_EQ(ssphh::test::message_of([&] { client.call("strange", {"x"}); }),
            "strange: parked: failed on 1 worker; s: the handler threw no std::exception" + hint);
}

TEST(WorkerLife, ThatCannotConnectSaysSo) {
  Worker worker({.endpoint = "tcp://127.0.0.1", .service = "job", .name = "w"});
  EXPECT_THAT(ssphh::test::message_of([&] { worker.run(echo); }),
              testing::StartsWith("tcp://127.0.0.1: cannot connect: "));
}

TEST(WorkerLife, StoppedItFinishesTheJobInHand) {
  RunningBroker broker;
  std::atomic<bool> started = false, released = false;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "job"}, [&](const Job& job) -> Frames {
    started = true;
    while (!released && !job.cancel->requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {job.cancel->requested() ? "cancelled" : "finished"};
  });
  Client client({.endpoint = broker.endpoint()});
  client.submit("job", {"x"});
  while (!started) client.poll(10);
  (*worker).stop();
  EXPECT_FALSE(client.poll(50)) << "it goes on";
  released = true;
  worker.join();
  const auto event = client.poll(10'000);
  ASSERT_TRUE(event);
  EXPECT_THAT(event->body, ElementsAre("finished"));
  EXPECT_EQ(event->attempts, 1);
  EXPECT_THAT(client.call("mmi.service", {"job"}), ElementsAre("404"));
}

// The broker would keep the request for ten minutes: the client's own word must end it.
TEST(ClientLife, EndsWhatItStillWaitsFor) {
  BrokerOptions options;
  options.timers.client_grace = 600'000;
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
  for (int i = 0; i < 5000 && !stopped; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(stopped);
}

TEST(ClientLife, CallThatIsCancelledEndsItsRequestAlone) {
  RunningBroker broker;
  Client client({.endpoint = broker.endpoint()});
  const RequestId other = client.submit("nobody", {"x"});
  CancelToken token;
  token.request();
  EXPECT_THROW(client.call("nobody", {"y"}, {}, {nullptr, &token}), Cancelled);
  EXPECT_EQ(client.outstanding(), 1u);
  const auto now = ssphh::test::parse_json(client.call("mmi.stats", {""}).at(1));
  EXPECT_EQ(now["total"]["cancelled"], 1);
  EXPECT_EQ(now["now"]["outstanding"], 1);
  client.cancel(other);
  const auto event = client.poll(10'000);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->id, other);
}

// call() hears of other requests meanwhile: their results are there afterwards, each once.
TEST(ClientLife, CallKeepsTheResultsOfOthers) {
  RunningBroker broker;
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "echo"}, [](const Job& job) {
    job.partial({"part of " + job.body[0]});
    return job.body;
  });
  Client client({.endpoint = broker.endpoint()});
  EXPECT_FALSE(client.connected());
  const RequestId a = client.submit("echo", {"a"}), b = client.submit("echo", {"b"});
  EXPECT_THAT(client.call("echo", {"c"}), ElementsAre("part of c", "c")) << "one worker: after a and b";
  EXPECT_TRUE(client.connected());
  EXPECT_EQ(client.outstanding(), 2u) << "their last words are to be asked for yet";
  for (const auto& [id, body, left] : {std::tuple(a, "a", 1u), std::tuple(b, "b", 0u)}) {
    const auto part = client.poll(0), last = client.poll(-1);
    ASSERT_TRUE(part && last);
    EXPECT_EQ(part->id, id);
    EXPECT_FALSE(part->final);
    EXPECT_THAT(part->body, ElementsAre(std::string("part of ") + body));
    EXPECT_EQ(last->id, id);
    EXPECT_TRUE(last->final);
    EXPECT_THAT(last->body, ElementsAre(body));
    EXPECT_EQ(client.outstanding(), left);
  }
  EXPECT_FALSE(client.poll(0));
}

TEST(ClientLife, IsConnectedUntilTheBrokerIsGone) {
  auto broker = std::make_unique<RunningBroker>();
  Client client({.endpoint = broker->endpoint()});
  client.call("mmi.service", {"x"});
  EXPECT_TRUE(client.connected());
  broker.reset();
  client.submit("nobody", {"x"});
  for (int i = 0; i < 500 && client.connected(); ++i) client.poll(10);
  EXPECT_FALSE(client.connected());
}

// Every attempt of ZeroMQ to get in is refused anew; people are told once.
TEST(ClientLife, SaysOnceThatTheBrokerRefusesItsKey) {
  std::mutex mutex;  // the broker's thread logs, too
  std::vector<std::string> lines;
  const LogSink before = set_log_sink([&](LogLevel, const std::string& text) {
    const std::lock_guard lock(mutex);
    lines.push_back(text);
  });
  std::string endpoint;
  {
    const KeyPair keys = make_key_pair();
    RunningBroker broker({.security = BrokerSecurity{keys, {}, {}}});
    endpoint = broker.endpoint();
    for (int i = 0; i < 2; ++i) {
      Client client({.endpoint = endpoint, .security = PeerSecurity{keys.public_key, make_key_pair()}});
      client.submit("echo", {"x"});
      EXPECT_FALSE(client.poll(60));
      EXPECT_FALSE(client.connected());
    }
  }
  set_log_sink(before);
  EXPECT_EQ(std::ranges::count(lines, endpoint + ": the broker refuses the connection; is this key in its "
                                                 "allow.txt, and broker.pub its own? Still trying"),
            2)
      << "once a client";
}

TEST(ClientLife, PollReturnsWhenItsTimeIsOver) {
  RunningBroker broker;
  Client client({.endpoint = broker.endpoint()});
  EXPECT_FALSE(client.poll(-1)) << "nothing to wait for";
  client.submit("nobody", {"x"});
  const Millis begin = steady_now();
  EXPECT_FALSE(client.poll(40));
  EXPECT_GE(steady_now() - begin, 40);
  EXPECT_LT(steady_now() - begin, 2000);
}

}  // namespace
}  // namespace ssphh::majordomo::test
