/// Real sockets through a network in between that doubles messages and lets them overtake each other.

#include <atomic>
#include <map>

#include <ssphh/core/random.h>

#include "socket_peers.h"

namespace ssphh::majordomo::test {
namespace {

/// Stands before a broker: every peer gets a connection of its own to it, under the same identity.
class UnrulyNetwork {
 public:
  UnrulyNetwork(std::string broker, Millis longest_delay, float doubled)
      : broker_(std::move(broker)), longest_delay_(longest_delay), doubled_(doubled) {
    front_.set(zmq::sockopt::linger, 0);
    front_.bind("tcp://127.0.0.1:*");
    endpoint_ = front_.get(zmq::sockopt::last_endpoint);
    thread_ = std::thread([this] { run(); });
  }
  ~UnrulyNetwork() {
    ended_ = true;
    thread_.join();
  }
  const std::string& endpoint() const { return endpoint_; }
  int overtaken() const { return overtaken_; }
  int doubled() const { return copies_; }

 private:
  struct Flying {
    std::string peer;
    Frames frames;
    bool to_broker = true;
    int serial = 0;
  };

  void run() {
    while (!ended_) {
      std::vector<zmq::pollitem_t> items = {{front_.handle(), 0, ZMQ_POLLIN, 0}};
      for (auto& [peer, back] : backs_) items.push_back({back.handle(), 0, ZMQ_POLLIN, 0});
      zmq::poll(items, std::chrono::milliseconds(1));
      while (auto message = receive_message(front_)) {
        const std::string peer = message->frames[0];
        message->frames.erase(message->frames.begin());
        fly(peer, std::move(message->frames), true);
      }
      for (auto& [peer, back] : backs_)
        while (auto message = receive_message(back)) fly(peer, std::move(message->frames), false);
      while (!flying_.empty() && flying_.begin()->first <= steady_now()) {
        const Flying message = std::move(flying_.begin()->second);
        flying_.erase(flying_.begin());
        int& last = last_[{message.peer, message.to_broker}];
        if (message.serial < last) ++overtaken_;
        last = std::max(last, message.serial);
        if (message.to_broker) {
          send_message(back_of(message.peer), nullptr, message.frames, nullptr);
        } else {
          send_message(front_, &message.peer, message.frames, nullptr);
        }
      }
    }
  }

  void fly(const std::string& peer, Frames frames, bool to_broker) {
    const int copies = random_.uniform() < doubled_ ? 2 : 1;
    copies_ += copies - 1;
    ++serial_;
    for (int i = 0; i < copies; ++i) {
      const auto delay = static_cast<Millis>(random_.uniform() * static_cast<float>(longest_delay_));
      flying_.emplace(steady_now() + delay, Flying{peer, frames, to_broker, serial_});
    }
  }

  zmq::socket_t& back_of(const std::string& peer) {
    auto found = backs_.find(peer);
    if (found == backs_.end()) {
      zmq::socket_t back(context_, zmq::socket_type::dealer);
      back.set(zmq::sockopt::linger, 0);
      // Names that a ROUTER made up begin with a zero, which nobody may choose.
      back.set(zmq::sockopt::routing_id, peer[0] ? peer : "peer" + std::to_string(backs_.size()));
      back.connect(broker_);
      found = backs_.emplace(peer, std::move(back)).first;
    }
    return found->second;
  }

  std::string broker_, endpoint_;
  Millis longest_delay_;
  float doubled_;
  Pcg32 random_{5};
  zmq::context_t context_;
  zmq::socket_t front_{context_, zmq::socket_type::router};
  std::map<std::string, zmq::socket_t> backs_;
  std::multimap<Millis, Flying> flying_;
  std::map<std::pair<std::string, bool>, int> last_;
  int serial_ = 0;
  std::atomic<int> overtaken_{0}, copies_{0};
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

TEST(UnrulyNetwork, EveryRequestIsAnsweredOnceWithItsOwnResult) {
  RunningBroker broker;
  UnrulyNetwork network(broker.endpoint(), 30, 0.2f);
  std::vector<std::unique_ptr<RunningWorker>> workers;
  for (int i = 0; i < 8; ++i)
    workers.push_back(std::make_unique<RunningWorker>(
        WorkerOptions{.endpoint = network.endpoint(), .service = "double"},
        [](const Job& job) -> Frames { return {job.body.at(0) + job.body.at(0)}; }));
  Client client({.endpoint = network.endpoint(), .window = 20});
  std::map<std::string, std::string> expected;
  for (int i = 0; i < 200; ++i) {
    const std::string body = std::to_string(i) + ",";
    expected[client.submit("double", {body}).hex()] = body + body;
  }
  std::map<std::string, int> seen;
  while (client.outstanding() > 0) {
    const auto event = client.poll(15'000);
    ASSERT_TRUE(event) << "stuck after " << seen.size();
    EXPECT_EQ(event->outcome, Outcome::ok) << event->reason;
    EXPECT_THAT(event->body, testing::ElementsAre(expected.at(event->id.hex())));
    ++seen[event->id.hex()];
  }
  EXPECT_FALSE(client.poll(200)) << "nothing comes twice";
  EXPECT_EQ(seen.size(), 200u);
  for (const auto& [id, count] : seen) EXPECT_EQ(count, 1) << id;
  EXPECT_GT(network.overtaken(), 20);
  EXPECT_GT(network.doubled(), 50);
}

}  // namespace
}  // namespace ssphh::majordomo::test
