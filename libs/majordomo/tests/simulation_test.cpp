/// Clients, broker and workers, all real state machines, on a network and a clock made here: messages are
/// delayed, overtake each other, get lost and come twice; workers die, freeze and come back; clients and
/// broker start again. Every request must be answered exactly once, with its own result.

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

#include "broker_harness.h"
#include "client_core.h"
#include "worker_core.h"

namespace ssphh::majordomo::test {
namespace {

struct Faults {
  double lost = 0, doubled = 0;
  Millis delay = 0;        ///< longest; more than one step lets messages overtake each other
  double worker_dies = 0;  ///< per worker and second
  double client_reconnects = 0, broker_restarts = 0;  ///< per second
  bool store = false;
  double clock_jumps = 0;  ///< per second and clock: some seconds back, or up to an hour ahead
};

class World {
 public:
  World(std::uint64_t seed, const Faults& faults, int clients, int workers, int jobs)
      : faults_(faults), random_(seed), seed_(seed) {
    limits_.attempts = 1'000'000;  // here, nothing that fails is poison
    timers_.attempt_timeout = 4000;
    start_broker();
    for (int i = 0; i < clients; ++i) {
      ClientOptions options;
      options.window = 5;
      options.ask_again = 1000;
      clients_.push_back({ClientCore(options, [this] {
        const auto bits = id_random_();
        return RequestId{bits[0], bits[1] + 77};
      })});
    }
    for (int i = 0; i < workers; ++i) workers_.push_back(new_worker());
    for (int i = 0; i < jobs; ++i) {
      Client& client = clients_[i % clients];
      RequestOptions options;
      options.persistent = faults.store && i % 2 == 0;
      const std::string body = "job " + std::to_string(i);
      client.expected[client.core.submit(now_, "gen", {body}, options).hex()] = body;
    }
  }

  /// Runs until all is answered; false when that takes longer than `longest`.
  bool run(Millis longest) {
    const Millis end = now_ + longest;
    while (now_ < end) {
      step();
      bool done = true;
      for (const Client& client : clients_) done &= client.core.outstanding() == 0;
      if (done) {
        for (const Millis later = now_ + 12'000; now_ < later;) step();  // late copies and acknowledgements
        return true;
      }
    }
    return false;
  }

  void check() const {
    for (const Client& client : clients_) {
      EXPECT_EQ(client.answers.size(), client.expected.size());
      for (const auto& [id, body] : client.expected) {
        const auto found = client.answers.find(id);
        ASSERT_NE(found, client.answers.end()) << body;
        EXPECT_EQ(found->second, std::vector<std::string>{"result of " + body});
      }
    }
    const BrokerStats stats = broker_->stats();
    EXPECT_EQ(stats.outstanding, 0u);
    EXPECT_EQ(stats.queued, 0u);
    EXPECT_EQ(stats.bytes, 0u);
  }

  int executions() const { return executions_; }

 private:
  static constexpr Millis step_ms = 10;

  struct Client {
    ClientCore core;
    std::map<std::string, std::string> expected = {};
    std::map<std::string, std::vector<std::string>> answers = {};
    Millis skew = 0;
  };
  struct Worker {
    std::unique_ptr<WorkerCore> core;
    std::string identity = {};
    std::string body = {};
    Millis done_at = Timers::never;
    Millis frozen_until = 0;
    Millis skew = 0;
  };
  struct Flying {
    int kind;  // 0: to the broker, 1: to a client, 2: to a worker
    std::string peer;
    Frames frames;
  };

  /// A clock that is put: up to twenty seconds back, or up to an hour ahead.
  void jump(Millis& skew, double per_step) {
    if (faults_.clock_jumps == 0 || !chance(faults_.clock_jumps * per_step)) return;
    const float most = chance(0.5) ? -20'000.0f : 3'600'000.0f;
    skew += static_cast<Millis>(random_.uniform() * most);
  }
  bool chance(double p) { return static_cast<double>(random_.uniform()) < p; }

  Worker new_worker() {
    WorkerOptions options;
    options.service = "gen";
    return {.core = std::make_unique<WorkerCore>(options)};
  }

  void start_broker() {
    broker_ =
        std::make_unique<BrokerCore>(limits_, timers_, sequence(seed_ + 1000 * ++generation_), faults_.store);
    broker_->tick(now_ + skew_);
    for (StoredRequest& stored : std::vector(stored_)) broker_->restore(now_ + skew_, std::move(stored));
  }

  void fly(int kind, const std::string& peer, const Frames& head, const Body& body) {
    Frames frames = head;
    if (body) frames.insert(frames.end(), body->begin(), body->end());
    if (chance(faults_.lost)) return;
    for (int copies = chance(faults_.doubled) ? 2 : 1; copies > 0; --copies) {
      const Millis delay =
          step_ms + static_cast<Millis>(random_.uniform() * static_cast<float>(faults_.delay));
      flying_.emplace(now_ + delay, Flying{kind, peer, frames});
    }
  }

  void apply(const StoreOperation& operation) {
    const auto same = [&](const StoredRequest& r) { return r.id == operation.request.id; };
    const auto found = std::find_if(stored_.begin(), stored_.end(), same);
    if (operation.kind == StoreOperation::add) {
      stored_.push_back(operation.request);
    } else if (operation.kind == StoreOperation::forget) {
      std::erase_if(stored_, same);
    } else if (found != stored_.end()) {
      found->finished = true;
      found->outcome = operation.request.outcome;
      found->reply = operation.request.reply;
    }
  }

  void drop_connection(const std::string& peer, bool noticed) {
    std::erase_if(flying_, [&](const auto& entry) { return entry.second.peer == peer; });
    if (noticed) broker_->peer_gone(now_ + skew_, peer);
  }

  void step() {
    now_ += step_ms;
    while (!flying_.empty() && flying_.begin()->first <= now_) {
      const Flying message = std::move(flying_.begin()->second);
      flying_.erase(flying_.begin());
      deliver(message);
    }
    const double per_step = static_cast<double>(step_ms) / 1000;
    jump(skew_, per_step);
    for (Client& client : clients_) jump(client.skew, per_step);
    for (Worker& worker : workers_) jump(worker.skew, per_step);
    for (std::size_t i = 0; i < workers_.size(); ++i) step_worker(i, per_step);
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      const std::string name = "client " + std::to_string(i);
      if (chance(faults_.client_reconnects * per_step)) {
        drop_connection(name, true);
        clients_[i].core.connected(now_ + clients_[i].skew);
      }
      clients_[i].core.tick(now_ + clients_[i].skew);
      for (const ToBroker& message : clients_[i].core.take()) fly(0, name, message.head, message.body);
      while (const auto event = clients_[i].core.next_event()) {
        std::string text = event->outcome == Outcome::ok ? "" : std::string(name_of(event->outcome));
        for (const Frame& frame : event->body) text += frame;
        clients_[i].answers[event->id.hex()].push_back(text);
      }
    }
    if (chance(faults_.broker_restarts * per_step)) {
      flying_.clear();
      start_broker();
      for (Client& client : clients_) client.core.connected(now_ + client.skew);
    }
    broker_->tick(now_ + skew_);
    const BrokerOutputs out = broker_->take();
    for (const StoreOperation& operation : out.store) apply(operation);
    for (const Outgoing& message : out.messages)
      fly(message.peer.starts_with("client") ? 1 : 2, message.peer, message.head, message.body);
  }

  void step_worker(std::size_t i, double per_step) {
    Worker& worker = workers_[i];
    if (chance(faults_.worker_dies * per_step)) {
      if (chance(0.3)) {
        worker.frozen_until = now_ + 12'000;
      } else {
        drop_connection(worker.identity, chance(0.5));
        worker = new_worker();
      }
    }
    if (now_ < worker.frozen_until) return;
    const Millis now = now_ + worker.skew;
    if (worker.core->connect_at().value_or(Timers::never) <= now) {
      if (!worker.identity.empty()) drop_connection(worker.identity, true);
      worker.identity = "ssphh1:worker" + std::to_string(i) + "#" + std::to_string(++connections_);
      worker.core->connected(now);
    }
    if (now_ >= worker.done_at) {
      worker.done_at = Timers::never;
      ++executions_;
      if (chance(0.05)) {
        worker.core->done(now, {.outcome = Outcome::failed, .retry = true, .reason = "unlucky"});
      } else {
        worker.core->done(now, {.body = {"result of ", worker.body}});
      }
    }
    worker.core->tick(now);
    if (auto job = worker.core->take_job()) {
      worker.body = job->body.at(0);
      worker.done_at = now_ + 50 + static_cast<Millis>(random_.uniform() * 500);
    }
    for (const ToBroker& message : worker.core->take()) fly(0, worker.identity, message.head, message.body);
  }

  void deliver(const Flying& message) {
    if (message.kind == 0) return broker_->receive(now_ + skew_, message.peer, Frames(message.frames));
    if (message.kind == 1) {
      Client& client = clients_.at(std::stoul(message.peer.substr(7)));
      return client.core.receive(now_ + client.skew, Frames(message.frames));
    }
    for (Worker& worker : workers_)
      if (worker.identity == message.peer && now_ >= worker.frozen_until)
        worker.core->receive(now_ + worker.skew, Frames(message.frames));
  }

  Faults faults_;
  Pcg32 random_;
  std::uint64_t seed_;
  BrokerCore::Random id_random_ = sequence(99);
  BrokerLimits limits_;
  BrokerTimers timers_;
  Millis now_ = 1'000'000;
  Millis skew_ = 0;  ///< of the broker's clock
  std::uint64_t generation_ = 0;
  int connections_ = 0, executions_ = 0;
  std::unique_ptr<BrokerCore> broker_;
  std::vector<Client> clients_;
  std::vector<Worker> workers_;
  std::vector<StoredRequest> stored_;
  std::multimap<Millis, Flying> flying_;
};

void answered_exactly_once(const Faults& faults, int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    World world(static_cast<std::uint64_t>(seed), faults, 3, 4, 60);
    ASSERT_TRUE(world.run(600'000));
    world.check();
    EXPECT_GE(world.executions(), 60);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Simulation, WithoutFaultsEachJobRunsOnce) {
  World world(1, {.delay = 5}, 3, 4, 60);
  ASSERT_TRUE(world.run(60'000));
  world.check();
  EXPECT_LE(world.executions(), 60 + 10) << "only handlers that fail by themselves run again";
}

TEST(Simulation, DelayedAndDoubledMessages) {
  answered_exactly_once({.doubled = 0.2, .delay = 200}, 10);
}

TEST(Simulation, LostMessages) {
  answered_exactly_once({.lost = 0.1, .doubled = 0.05, .delay = 50}, 10);
}

TEST(Simulation, DyingAndFreezingWorkers) {
  answered_exactly_once({.delay = 20, .worker_dies = 0.2}, 10);
}

TEST(Simulation, ReconnectingClientsAndRestartingBroker) {
  answered_exactly_once({.delay = 20, .client_reconnects = 0.2, .broker_restarts = 0.1}, 10);
}

TEST(Simulation, JumpingClocks) {
  answered_exactly_once({.delay = 20, .clock_jumps = 0.02}, 10);
}

TEST(Simulation, Everything) {
  answered_exactly_once({.lost = 0.02,
                         .doubled = 0.05,
                         .delay = 100,
                         .worker_dies = 0.1,
                         .client_reconnects = 0.05,
                         .broker_restarts = 0.03,
                         .store = true},
                        20);
}

}  // namespace
}  // namespace ssphh::majordomo::test
