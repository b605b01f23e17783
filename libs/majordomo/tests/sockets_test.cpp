/// Broker, worker and client over real sockets on loopback; foreign peers in raw frames written from the
/// RFCs.

#include <atomic>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zmq.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/worker.h>

#include "socket.h"
#include "temp_dir.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using std::string_literals::operator""s;

class RunningBroker {
 public:
  explicit RunningBroker(BrokerOptions options = {}) {
    if (options.bind == BrokerOptions{}.bind) options.bind = "tcp://127.0.0.1:0";
    options.on_event = [](const BrokerEvent&) {};
    options.drain = 2000;
    broker_ = std::make_unique<Broker>(std::move(options));
    thread_ = std::thread([this] { broker_->run(); });
  }
  ~RunningBroker() { end(); }
  void end() {
    if (!broker_) return;
    broker_->stop();
    thread_.join();
    broker_.reset();
  }
  std::string endpoint() const { return broker_->endpoint(); }
  Broker& operator*() { return *broker_; }

 private:
  std::unique_ptr<Broker> broker_;
  std::thread thread_;
};

class RunningWorker {
 public:
  RunningWorker(WorkerOptions options, Handler handler) : worker_(std::move(options)) {
    thread_ = std::thread([this, handler = std::move(handler)] { worker_.run(handler); });
  }
  ~RunningWorker() {
    worker_.abandon();
    if (thread_.joinable()) thread_.join();
  }
  Worker& operator*() { return worker_; }
  void join() { thread_.join(); }

 private:
  Worker worker_;
  std::thread thread_;
};

Frames echo(const Job& job) {
  return job.body;
}

/// A foreign peer.
class RawPeer {
 public:
  RawPeer(zmq::socket_type type, const std::string& endpoint) : socket_(context_, type) {
    socket_.set(zmq::sockopt::linger, 0);
    socket_.connect(endpoint);
  }
  void send(const Frames& frames) {
    while (send_message(socket_, nullptr, frames, nullptr) != Sent::yes)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// The next message within five seconds, HEARTBEATs of the broker aside; empty when none comes.
  Frames receive(Millis timeout = 5000) {
    for (const Millis end = steady_now() + timeout; steady_now() < end;) {
      zmq::pollitem_t item{socket_.handle(), 0, ZMQ_POLLIN, 0};
      zmq::poll(&item, 1, std::chrono::milliseconds(20));
      auto message = receive_message(socket_);
      if (!message) continue;
      if (message->frames == Frames{"", "MDPW01", "\x04"} || message->frames == Frames{"MDPW02", "\x05"})
        continue;
      return message->frames;
    }
    return {};
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_;
};

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

TEST(Foreign, Mdp01PeersInRawFrames) {
  RunningBroker broker;
  RawPeer worker(zmq::socket_type::dealer, broker.endpoint());
  worker.send({"", "MDPW01", "\x01", "echo"});
  RawPeer client(zmq::socket_type::req, broker.endpoint());
  client.send({"MDPC01", "echo", "hello"});
  const Frames job = worker.receive();
  ASSERT_EQ(job.size(), 6u);
  EXPECT_EQ(job[2], "\x02");
  EXPECT_EQ(job[5], "hello");
  worker.send({"", "MDPW01", "\x03", job[3], "", "world"});
  EXPECT_THAT(client.receive(), ElementsAre("MDPC01", "echo", "world"));
}

TEST(Foreign, OurWorkerServesAForeignBrokerExactlyByTheRfc) {
  for (const Dialect dialect : {Dialect::mdp01, Dialect::mdp02, Dialect::own}) {
    const bool old = dialect == Dialect::mdp01;
    zmq::context_t context;
    zmq::socket_t router(context, zmq::socket_type::router);
    router.set(zmq::sockopt::linger, 0);
    router.bind("tcp://127.0.0.1:*");
    const std::string endpoint = router.get(zmq::sockopt::last_endpoint);
    RunningWorker worker({.endpoint = endpoint, .service = "echo", .dialect = dialect, .heartbeat = 100},
                         echo);
    const auto receive = [&](bool heartbeat) {
      for (const Millis end = steady_now() + 5000; steady_now() < end;) {
        zmq::pollitem_t item{router.handle(), 0, ZMQ_POLLIN, 0};
        zmq::poll(&item, 1, std::chrono::milliseconds(20));
        const auto message = receive_message(router);
        if (!message) continue;
        Frames frames = message->frames;
        const bool beat = Frames(frames.begin() + 1, frames.end()) ==
                          (old ? Frames{"", "MDPW01", "\x04"} : Frames{"MDPW02", "\x05"});
        if (beat == heartbeat) return frames;
      }
      return Frames{};
    };
    const Frames ready = receive(false);
    ASSERT_FALSE(ready.empty());
    EXPECT_EQ(Frames(ready.begin() + 1, ready.end()),
              old ? (Frames{"", "MDPW01", "\x01", "echo"}) : (Frames{"MDPW02", "\x01", "echo"}));
    EXPECT_FALSE(receive(true).empty());
    Frames request = old ? Frames{ready[0], "", "MDPW01", "\x02", "client 7", "", "a", "b"}
                         : Frames{ready[0], "MDPW02", "\x02", "client 7", "", "a", "b"};
    send_message(router, nullptr, request, nullptr);
    Frames reply = receive(false);
    request[old ? 3 : 2] = old ? "\x03" : "\x04";
    EXPECT_EQ(reply, request);
  }
}

TEST(Foreign, OurClientAsksAForeignBrokerExactlyByTheRfc) {
  zmq::context_t context;
  zmq::socket_t router(context, zmq::socket_type::router);
  router.set(zmq::sockopt::linger, 0);
  router.bind("tcp://127.0.0.1:*");
  const std::string endpoint = router.get(zmq::sockopt::last_endpoint);
  Client client({.endpoint = endpoint, .dialect = Dialect::mdp01, .foreign_timeout = 200});
  client.submit("echo", {"a"});
  client.submit("echo", {"b"});
  for (const char* body :
       {"a", "a", "b"}) {  // the first is not answered, so it is asked again on a new socket
    std::optional<Received> message;
    for (int i = 0; i < 300 && !message; ++i) {
      EXPECT_FALSE(client.poll(10));
      message = receive_message(router);
    }
    ASSERT_TRUE(message);
    EXPECT_EQ(Frames(message->frames.begin() + 1, message->frames.end()),
              (Frames{"", "MDPC01", "echo", body}));
    static int asked = 0;
    if (++asked == 1) continue;
    send_message(router, nullptr, message->frames, nullptr);
    const auto event = client.poll(5000);
    ASSERT_TRUE(event);
    EXPECT_THAT(event->body, ElementsAre(body));
  }
}

TEST(Foreign, DeadClientAndWorkerAreNoticedByTheirConnection) {
  RunningBroker broker;
  Client client({.endpoint = broker.endpoint()});
  {
    RawPeer worker(zmq::socket_type::dealer, broker.endpoint());
    worker.send({"", "MDPW01", "\x01", "echo"});
    for (int i = 0; i < 500 && client.call("mmi.service", {"echo"}) != Frames{"200"}; ++i) {
    }
    EXPECT_THAT(client.call("mmi.service", {"echo"}), ElementsAre("200"));
  }
  bool gone = false;
  for (const Millis end = steady_now() + 3000; steady_now() < end && !gone;)
    gone = client.call("mmi.service", {"echo"}) == Frames{"404"};
  EXPECT_TRUE(gone);
}

TEST(Foreign, SlowReaderLosesNothing) {
  RunningBroker broker({.connection_timeout = 120'000});
  RunningWorker worker({.endpoint = broker.endpoint(), .service = "echo"}, echo);
  RawPeer client(zmq::socket_type::dealer, broker.endpoint());
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    client.send({"", "MDPC01", "echo", std::to_string(i) + std::string(2000, 'x')});
    if (i % 500 == 499) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  Client other({.endpoint = broker.endpoint()});
  for (bool waiting = true; waiting;) {  // all is answered before the first reply is read
    const std::string stats = other.call("mmi.stats", {""}).at(1);
    waiting = stats.find("\"outstanding\":0,") == std::string::npos;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  int received = 0;
  while (received < count && !client.receive(3000).empty()) ++received;
  EXPECT_EQ(received, count);
}

TEST(Curve, KnownKeysComeInOthersDoNot) {
  TempDir dir;
  for (const char* name : {"broker", "alice", "worker", "mallory"})
    write_key_pair(dir.path(), name, make_key_pair());
  add_to_allow_list(dir / "allow.txt", "alice", read_public_key(dir / "alice.pub"), {"client"});
  add_to_allow_list(dir / "allow.txt", "worker", read_public_key(dir / "worker.pub"), {"worker:echo"});
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  RunningBroker broker({.security = read_broker_security(dir.path())});
  RunningWorker worker({.endpoint = broker.endpoint(),
                        .service = "echo",
                        .security = read_peer_security(dir.path(), "worker")},
                       echo);
  Client alice({.endpoint = broker.endpoint(), .security = read_peer_security(dir.path(), "alice")});
  EXPECT_THAT(alice.call("echo", {"x"}), ElementsAre("x"));
  EXPECT_THAT(alice.call("mmi.drain", {""}), ElementsAre("403"));

  const auto refused = [&](ClientOptions options) {
    Client client(std::move(options));
    client.submit("echo", {"x"});
    return !client.poll(500) && !client.connected();
  };
  EXPECT_TRUE(
      refused({.endpoint = broker.endpoint(), .security = read_peer_security(dir.path(), "mallory")}));
  EXPECT_TRUE(refused({.endpoint = broker.endpoint()})) << "plain";
  PeerSecurity wrong_broker = read_peer_security(dir.path(), "alice");
  wrong_broker.broker_key = make_key_pair().public_key;
  EXPECT_TRUE(refused({.endpoint = broker.endpoint(), .security = wrong_broker}));
  PeerSecurity worker_key = read_peer_security(dir.path(), "worker");
  Client not_a_client({.endpoint = broker.endpoint(), .security = worker_key});
  not_a_client.submit("echo", {"x"});
  EXPECT_FALSE(not_a_client.poll(300));
  set_log_sink(before);
}

TEST(Security, PlainOnlyOnThisMachine) {
  for (const char* local : {"tcp://127.0.0.1:5555", "tcp://127.1.2.3:*", "tcp://localhost:1", "tcp://[::1]:1",
                            "ipc:///tmp/x", "inproc://x"})
    EXPECT_TRUE(is_local_endpoint(local)) << local;
  for (const char* remote : {"tcp://*:5555", "tcp://0.0.0.0:5555", "tcp://10.0.0.1:1", "tcp://eth0:1",
                             "tcp://127.evil.org:1", "tcp://[::]:1", "tcp://localhost.evil.org:1", "pgm://x"})
    EXPECT_FALSE(is_local_endpoint(remote)) << remote;
  EXPECT_THROW(Broker({.bind = "tcp://0.0.0.0:0"}), Error);
  EXPECT_THROW(Client({.endpoint = "tcp://10.0.0.1:5555"}), Error);
  EXPECT_THROW(Worker({.endpoint = "tcp://10.0.0.1:5555", .service = "x"}), Error);
  EXPECT_THROW(Client({.endpoint = "nonsense"}), Error);
}

TEST(Security, KeyFilesAndAllowLists) {
  TempDir dir;
  const KeyPair keys = make_key_pair();
  write_key_pair(dir.path(), "a", keys);
  EXPECT_EQ(read_key_pair(dir / "a.key").secret_key, keys.secret_key);
  EXPECT_EQ(read_public_key(dir / "a.pub"), keys.public_key);
  EXPECT_THROW(write_key_pair(dir.path(), "a", keys), Error);
  EXPECT_THROW(write_key_pair(dir.path(), "../a", keys), Error);
  std::filesystem::permissions(dir / "a.key", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW(read_key_pair(dir / "a.key"), Error);
  const auto list = [&](const std::string& text) {
    std::ofstream(dir / "allow.txt") << text;
    return read_allow_list(dir / "allow.txt");
  };
  const AllowList good =
      list("# comment\n\nann " + keys.public_key + " client worker:gen worker:viz.* # hers\n");
  ASSERT_EQ(good.size(), 1u);
  EXPECT_TRUE(good[0].rights.client);
  EXPECT_FALSE(good[0].rights.admin);
  EXPECT_TRUE(good[0].rights.may_serve("gen"));
  EXPECT_TRUE(good[0].rights.may_serve("viz.1"));
  EXPECT_FALSE(good[0].rights.may_serve("gen2"));
  std::string hash = keys.public_key;  // Z85 has a #
  hash[4] = '#';
  EXPECT_EQ(list("ann " + hash + " client #x\n").at(0).public_key, hash);
  for (const std::string& bad :
       {"ann\n"s, "ann short client\n"s, "ann " + keys.public_key + " king\n",
        "ann " + keys.public_key + " client\nbob " + keys.public_key + " client\n"}) {
    try {
      list(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), HasSubstr("allow.txt:"));
    }
  }
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
