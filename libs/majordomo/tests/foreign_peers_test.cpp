/// Our broker, worker and client with foreign peers, whose raw frames are written from the RFCs.

#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;

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

// Silence is allowed to last for minutes here: only the connection's end tells.
TEST(Foreign, AWorkerWhoseConnectionEndsGivesUpItsJobAtOnce) {
  BrokerOptions options;
  options.timers.heartbeat = 150'000, options.timers.worker_expiry = 600'000;
  RunningBroker broker(options);
  auto first = std::make_unique<RawPeer>(zmq::socket_type::dealer, broker.endpoint());
  first->send({"", "MDPW01", "\x01", "echo"});
  RawPeer client(zmq::socket_type::req, broker.endpoint());
  client.send({"MDPC01", "echo", "hello"});
  ASSERT_EQ(first->receive().size(), 6u);
  first.reset();
  RawPeer second(zmq::socket_type::dealer, broker.endpoint());
  second.send({"", "MDPW01", "\x01", "echo"});
  const Frames job = second.receive();
  ASSERT_EQ(job.size(), 6u);
  EXPECT_EQ(job[5], "hello");
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

}  // namespace
}  // namespace ssphh::majordomo::test
