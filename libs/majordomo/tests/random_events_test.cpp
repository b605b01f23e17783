/// Random sequences of what clients, workers and the clock do: after every step the broker's books equal a
/// recount, every request ends once, and nothing is left at the end. A failing sequence is shrunk.

#include <ssphh/core/random.h>

#include "broker_harness.h"
#include "recount.h"
#include "shrink.h"

namespace ssphh::majordomo::test {
namespace {

constexpr const char* kinds[] = {"submit", "persistent", "keyed", "deadline", "foreign", "cancel", "ack",
                                 "join",   "answer",     "fail",  "retry",    "back",    "part",   "leave",
                                 "die",    "vanish",     "pass",  "release",  "drop",    "drain"};

struct Step {
  std::string kind;
  unsigned who = 0, amount = 0;
};

std::vector<Step> random_steps(std::uint64_t seed, std::size_t count) {
  Pcg32 random(seed);
  std::vector<Step> steps;
  for (std::size_t i = 0; i < count; ++i)
    steps.push_back({kinds[random.next() % std::size(kinds)], random.next() % 1000, random.next() % 1000});
  return steps;
}

/// The peers, as simple as can be, and what must hold.
class Scenario {
 public:
  /// What is wrong first; empty when nothing is.
  std::string complaint(const std::vector<Step>& steps) {
    for (const Step& step : steps) {
      take(step);
      if (std::string wrong = check(); !wrong.empty()) return wrong;
    }
    settle();
    if (std::string wrong = check(); !wrong.empty()) return wrong;
    return check_end();
  }

 private:
  static constexpr unsigned clients = 3, workers = 4;  // the last of them is foreign

  struct Wish {
    RequestId id = {};
    unsigned client = 0;
    bool persistent = false, taken = true;
    int finals = 0;
    Millis dropped = Timers::never;  ///< its client vanished: when it is waited for no longer
  };
  struct Worker {
    std::string name = {};
    bool ready = false;
    Frame job = {};
  };

  std::string client_name(unsigned i) const { return fmt::format("c{}.{}", i, lives_[i]); }
  void send(const std::string& peer, Frames frames) {
    ++sent_;
    h_.send(peer, std::move(frames));
    read();
  }

  void take(const Step& step) {
    const unsigned c = step.who % clients, w = step.who % workers;
    if (step.kind == "submit") submit(c, step.amount, {});
    if (step.kind == "persistent") submit(c, step.amount, {.persistent = true});
    if (step.kind == "keyed")
      submit(c, step.amount % 4, {.content_key = Hash128{7, 7}, .persistent = step.amount % 3 == 0});
    if (step.kind == "deadline") submit(c, step.amount, {.deadline = 1 + step.amount});
    if (step.kind == "foreign") {
      send(fmt::format("f{}.{}", c, foreign_lives_), client02(service(step.amount), {"foreign"}));
      exact_ = false;
    }
    if ((step.kind == "cancel" || step.kind == "ack") && !wishes_.empty()) {
      const Wish& wish = wishes_[step.amount % wishes_.size()];
      send(client_name(wish.client),
           control(step.kind == "ack" ? EnvelopeKind::ack : EnvelopeKind::cancel, {wish.id}));
    }
    if (step.kind == "join") join(w, step.amount);
    if (step.kind == "answer") answer(w, {});
    if (step.kind == "fail") answer(w, {.outcome = Outcome::failed, .reason = "broken"});
    if (step.kind == "retry") answer(w, {.outcome = Outcome::failed, .retry = true, .reason = "no memory"});
    if (step.kind == "back") answer(w, {.outcome = Outcome::cancelled});
    if (step.kind == "part" && !workers_[w].job.empty())
      send(workers_[w].name, partial02(workers_[w].job, {std::string(step.amount % 9, 'p')}));
    if (step.kind == "leave" && workers_[w].ready) {
      send(workers_[w].name, disconnect02);
      workers_[w].ready = false;
    }
    if (step.kind == "die") {
      h_.gone(workers_[w].name);
      workers_[w].ready = false;
    }
    if (step.kind == "vanish") vanish(c);
    if (step.kind == "pass") h_.pass(std::array{1, 100, 250, 2500, 8000, 11'000, 70'000}[step.amount % 7]);
    if (step.kind == "release" || step.kind == "drop") admin("mmi." + step.kind, "all");
    if (step.kind == "release") exact_ = false;
    if (step.kind == "drain") admin("mmi.drain", fmt::format("w{}", w));
    read();
  }

  static std::string service(unsigned amount) { return amount % 2 ? "gen" : "viz"; }

  void submit(unsigned client, unsigned amount, Envelope envelope) {
    wishes_.push_back({.id = {++last_, 11}, .client = client, .persistent = envelope.persistent});
    envelope.ids = {wishes_.back().id};
    send(client_name(client), test::submit(service(amount), envelope, std::string(amount % 150, 'b')));
  }
  void join(unsigned i, unsigned amount) {
    Worker& worker = workers_[i];
    if (worker.ready) return;
    worker = {.name = fmt::format("{}w{}#{}", i + 1 < workers ? own_worker_prefix : "", i, ++last_),
              .ready = true};
    send(worker.name, ready02(service(amount)));
  }
  void answer(unsigned i, Envelope envelope) {
    Worker& worker = workers_[i];
    if (worker.job.empty()) return;
    const Frame job = std::exchange(worker.job, {});
    send(worker.name, result(job, envelope));  // also from one that the broker has given up
  }
  void vanish(unsigned i) {
    h_.gone(client_name(i));
    h_.gone(fmt::format("f{}.{}", i, foreign_lives_));
    ++foreign_lives_;
    ++lives_[i];
    for (Wish& wish : wishes_)
      if (wish.client == i && wish.dropped == Timers::never) wish.dropped = h_.now + 10'000;
  }
  void admin(const std::string& what, const std::string& which) {
    ++asked_;
    send("admin", client02(what, {which}));
  }

  Wish* wish(const RequestId& id) {
    return id.low == 11 ? &wishes_.at(std::find_if(wishes_.begin(), wishes_.end(),
                                                   [&](const Wish& w) { return w.id == id; }) -
                                      wishes_.begin())
                        : nullptr;
  }

  /// Everything that the broker has said.
  void read() {
    for (auto& [peer, messages] : std::exchange(h_.inbox, {}))
      for (const Frames& frames : messages) {
        ++heard_;
        if (frames[0] == "MDPW02") {
          read_worker(peer, frames);
        } else if (frames.size() > 3) {
          if (const auto envelope = decode_envelope(frames[3])) read_client(*envelope);
        }
      }
    for (const StoreOperation& operation : std::exchange(h_.store, {})) read_store(operation);
    for (const BrokerEvent& event : std::exchange(h_.events, {})) {
      ++events_[event.name];
      if (event.name == std::string("job-finished")) ++outcomes_[event.fields.at(2).second == "ok"];
    }
  }
  void read_worker(const std::string& peer, const Frames& frames) {
    for (Worker& worker : workers_) {
      if (worker.name != peer) continue;
      if (frames[1] == "\x02") ++given_, worker.job = frames[2];
      if (frames[1] == "\x06") worker.ready = false;
    }
  }
  void read_client(const Envelope& envelope) {
    if (envelope.kind == EnvelopeKind::busy) wish(envelope.ids.at(0))->taken = false;
    if (envelope.kind != EnvelopeKind::final) return;
    ++finals_[envelope.outcome];
    if (++wish(envelope.ids.at(0))->finals > 1) wrong_ += "a second FINAL\n";
  }
  void read_store(const StoreOperation& operation) {
    enum { absent, open, done };
    int& state = stored_[operation.request.id.hex()];
    const bool right = operation.kind == StoreOperation::add      ? state == absent
                       : operation.kind == StoreOperation::finish ? state == open
                                                                  : state != absent;
    if (!right) wrong_ += "the store is told what cannot be\n";
    state = operation.kind == StoreOperation::add      ? open
            : operation.kind == StoreOperation::finish ? done
                                                       : absent;
  }

  std::string check() {
    const BrokerStats s = h_.core.stats();
    std::string wrong = wrong_ + BrokerRecount::disagreements(h_.core);
    const auto equal = [&](const char* what, std::uint64_t told, std::uint64_t counted) {
      if (told != counted) wrong += fmt::format("metric {}: {}, counted {}\n", what, told, counted);
    };
    std::uint64_t taken = 0, outstanding = 0;
    for (const Wish& wish : wishes_) {
      taken += wish.taken;
      outstanding += wish.taken && !wish.persistent && wish.finals == 0 && wish.dropped > h_.now;
    }
    for (const auto& [id, state] : stored_) outstanding += state == 1;
    if (exact_) {
      equal("outstanding", s.outstanding, outstanding);
      equal("requests", s.requests, taken + asked_);
    }
    equal("received", s.received, sent_);
    equal("sent", s.sent, heard_);
    equal("attempts", s.attempts, given_);
    equal("finished", s.finished, outcomes_[true] + asked_);
    equal("failed", s.failed, outcomes_[false]);
    equal("cancelled", s.cancelled, finals_[Outcome::cancelled]);
    equal("expired", s.expired, finals_[Outcome::expired]);
    equal("parked", s.parked, events_["job-parked"]);
    equal("retries", s.retries, events_["job-retry"]);
    equal("lost workers", s.workers_lost, events_["worker-lost"]);
    equal("late replies", s.late_replies, events_["reply-late"]);
    return wrong;
  }

  /// All that is waited for is answered.
  void settle() {
    for (unsigned w = 0; w < workers; ++w) take({"die", w});
    for (int i = 0; i < 1000 && h_.core.stats().outstanding > 0; ++i) {
      for (unsigned w = 0; w < workers; ++w) {
        join(w, w);
        answer(w, {});
      }
      h_.pass(500);
      read();
    }
  }
  std::string check_end() {
    std::string wrong;
    for (const Wish& wish : wishes_)
      if (wish.taken && wish.finals != 1 && wish.dropped == Timers::never) wrong += "no FINAL\n";
    admin("mmi.drop", "all");
    h_.pass(8 * 86'400'000LL);
    const BrokerStats s = h_.core.stats();
    for (const std::size_t left : {s.outstanding, s.queued, s.running, s.bytes, s.records, s.workers})
      if (left != 0) wrong += "something is left\n";
    if (BrokerRecount::books(h_.core) != BrokerBooks{})
      wrong += testing::PrintToString(BrokerRecount::books(h_.core)) + " are left\n";
    return wrong;
  }

  static BrokerLimits limits() {
    BrokerLimits limits;
    limits.client_requests = 12;
    limits.stored_bytes = 3000;
    limits.record_bytes = 2500;
    limits.parked_bytes = 400;
    return limits;
  }
  Harness h_{limits(), {}, true};
  std::array<unsigned, clients> lives_{};
  unsigned foreign_lives_ = 0;
  std::array<Worker, workers> workers_;
  std::vector<Wish> wishes_;
  std::map<std::string, int> stored_;
  std::map<std::string, std::uint64_t> events_;
  std::map<bool, std::uint64_t> outcomes_;
  std::map<Outcome, std::uint64_t> finals_;
  std::uint64_t last_ = 0, sent_ = 0, heard_ = 0, given_ = 0, asked_ = 0;
  bool exact_ = true;  ///< neither foreign clients nor released jobs, of whose end nobody hears
  std::string wrong_;
};

TEST(RandomEvents, KeepTheBooksAndEndEveryRequestOnce) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    std::vector<Step> steps = random_steps(seed, 120);
    if (seed % 2)
      std::erase_if(steps, [](const Step& step) { return step.kind == "foreign" || step.kind == "release"; });
    if (Scenario().complaint(steps).empty()) continue;
    steps =
        shrunk(steps, [](const std::vector<Step>& fewer) { return !Scenario().complaint(fewer).empty(); });
    std::string text;
    for (const Step& step : steps) text += fmt::format("{} {} {}\n", step.kind, step.who, step.amount);
    FAIL() << "seed " << seed << ":\n" << text << Scenario().complaint(steps);
  }
}

TEST(Shrunk, SequenceHasOnlyTheStepsThatItNeedsToFail) {
  std::vector<int> steps;
  for (int i = 0; i < 100; ++i) steps.push_back(i);
  const auto fails = [](const std::vector<int>& s) {
    const auto at = [&](int value) { return std::find(s.begin(), s.end(), value); };
    return at(17) != s.end() && at(63) != s.end() && at(17) < at(63);
  };
  EXPECT_THAT(shrunk(steps, fails), testing::ElementsAre(17, 63));
}

}  // namespace
}  // namespace ssphh::majordomo::test
