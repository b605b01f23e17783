/// What the broker tells of itself, in JSON and to Prometheus: its numbers, under the right names.

#include <set>
#include <sstream>

#include "broker_harness.h"
#include "expected_text.h"
#include "json_text.h"

namespace ssphh::majordomo::test {
namespace {

/// A broker whose numbers are all different, so that none can stand for another.
class Telling : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 9; ++i) h.send(worker(i), ready02("gen"));
    fail();
    hand_back(7);
    finish(20);
    for (int i = 0; i < 10; ++i) submit("keyed", {.content_key = Hash128{1, 1}});  // 9 coalesced
    for (int i = 0; i < 7; ++i) h.send("c", test::submit("keyed", {.ids = {{last_, 2}}}));
    for (int i = 0; i < 4; ++i) cancel(submit("none"));
    for (int i = 0; i < 2; ++i) submit("none", {.deadline = 10});
    h.pass(10);
    for (int i = 0; i < 6; ++i) h.send("late" + std::to_string(i), final02("nobody", {"x"}));
    for (int i = 0; i < 8; ++i) h.core.dropped(h.now, "p", i < 3 ? "some" : "others");
    for (int i = 0; i < 6; ++i) h.send("big", test::submit("none", {.ids = {{5, ++last_}}}, big()));
    for (int i = 0; i < 12; ++i) join_and_die(i);
    suspect();
    for (int i = 0; i < 5; ++i) submit("gen");  // run by the nine
    h.inbox.clear();
    h.core.take();
  }

  static std::string worker(int i) { return fmt::format("ssphh1:w{}#{}", i, i); }
  static std::string big() { return std::string(600, 'b'); }
  RequestId submit(const std::string& service, Envelope envelope = {}) {
    envelope.ids = {{++last_, 2}};
    h.send("c", test::submit(service, envelope));
    return envelope.ids[0];
  }
  void cancel(const RequestId& id) { h.send("c", control(EnvelopeKind::cancel, {id})); }
  /// Answers a job that one of the nine has; false when none has any.
  bool answer(const Envelope& envelope) {
    for (int i = 0; i < 9; ++i)
      if (const std::string job = h.job_of(worker(i)); !job.empty()) {
        h.send(worker(i), result(job, envelope));
        return true;
      }
    return false;
  }
  void answer_all(const Envelope& envelope) {
    while (answer(envelope)) {
    }
  }
  void fail() {
    for (int i = 0; i < 3; ++i) submit("gen");  // parked
    for (int i = 0; i < 2; ++i) {
      answer_all({.outcome = Outcome::failed, .retry = true, .reason = "no memory"});
      h.pass(200);
    }
    for (int i = 0; i < 11; ++i) submit("gen");
    answer_all({.outcome = Outcome::failed, .reason = "broken"});
  }
  void hand_back(int times) {
    submit("gen");
    for (int i = 0; i < times; ++i) answer({.outcome = Outcome::cancelled});
    answer({});
  }
  void finish(int jobs) {
    for (int i = 0; i < jobs; ++i) submit("gen");
    answer_all({});
  }
  void join_and_die(int i) {
    const std::string name = fmt::format("ssphh1:d{}#{}", i, i);
    h.send(name, ready02("gen"));
    h.gone(name);
  }
  /// A foreign worker falls silent, and its job waits for another.
  void suspect() {
    h.send("foreign", ready02("other"));
    h.send("c", test::submit("other", {.ids = {{++last_, 2}}}));
    for (int i = 0; i < 4; ++i) {
      h.pass(2000);
      for (int w = 0; w < 9; ++w) h.send(worker(w), heartbeat02);
    }
  }
  const json::Value ask(const std::string& what) {
    h.send("x", client02("mmi." + what, {""}));
    return ssphh::test::parse_json(h.taken("x").at(0).at(4));
  }
  static BrokerLimits limits() {
    BrokerLimits limits;
    limits.client_bytes = 1000;
    limits.attempts = 2;
    return limits;
  }

  Harness h{limits()};

 private:
  std::uint64_t last_ = 0;
};

TEST_F(Telling, StatsInJsonAreTheCores) {
  const auto told = ask("stats");
  const BrokerStats s = h.core.stats();
  const json::Value total = {{"received", s.received},
                             {"sent", s.sent - 1},  // told before the answer was sent
                             {"dropped", s.dropped},
                             {"requests", s.requests},
                             {"finished", s.finished - 1},
                             {"failed", s.failed},
                             {"parked", s.parked},
                             {"expired", s.expired},
                             {"cancelled", s.cancelled},
                             {"busy", s.busy},
                             {"attempts", s.attempts},
                             {"retries", s.retries},
                             {"hedged", s.hedged},
                             {"coalesced", s.coalesced},
                             {"repeated", s.repeated},
                             {"late_replies", s.late_replies},
                             {"workers_lost", s.workers_lost}};
  const json::Value now = {
      {"peers", s.peers},   {"workers", s.workers}, {"idle", s.idle},   {"outstanding", s.outstanding},
      {"queued", s.queued}, {"running", s.running}, {"bytes", s.bytes}, {"records", s.records}};
  EXPECT_EQ(told["total"], total);
  EXPECT_EQ(told["now"], now);
  EXPECT_EQ(told["dropped"], (json::Value{{"others", 5}, {"some", 3}}));
  EXPECT_EQ(told["uptime_ms"], h.now - 1000);
  for (const auto& part : {total, now}) {
    std::set<std::uint64_t> different;
    for (const auto& [name, value] : part.members())
      EXPECT_TRUE(different.insert(ssphh::test::count_of(value)).second) << name << " " << print(value);
  }
}

TEST_F(Telling, CountsOfWhatHappened) {
  const BrokerStats s = h.core.stats();
  EXPECT_EQ(s.hedged, 1u);
  EXPECT_EQ(s.expired, 2u);
  EXPECT_EQ(s.parked, 3u);
  EXPECT_EQ(s.cancelled, 4u);
  EXPECT_EQ(s.busy, 5u);
  EXPECT_EQ(s.late_replies, 6u);
  EXPECT_EQ(s.repeated, 7u);
  EXPECT_EQ(s.dropped, 8u);
  EXPECT_EQ(s.coalesced, 9u);
  EXPECT_EQ(s.retries, 3u + 7u);
  EXPECT_EQ(s.workers_lost, 12u);
  EXPECT_EQ(s.failed, 3u + 11u);
  EXPECT_EQ(s.finished, 21u);
}

TEST_F(Telling, ServicesInJsonHaveTheirOwnCounts) {
  const auto services = ask("stats")["services"];
  ASSERT_EQ(services.size(), 4u);
  EXPECT_EQ(services[0], ssphh::test::parse_json(R"({"name": "gen", "workers": 9, "idle": 4, "queued": 0,
                                                   "clients": 1, "requests": 40, "finished": 35})"));
  EXPECT_EQ(services[2], ssphh::test::parse_json(R"({"name": "none", "workers": 0, "idle": 0, "queued": 1,
                                                   "clients": 1, "requests": 7, "finished": 0})"));
}

TEST_F(Telling, PrometheusIsToldTheSame) {
  const BrokerStats s = h.core.stats();
  std::map<std::string, std::string> told;
  std::istringstream lines(h.core.metrics_text());
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) told[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
  std::map<std::string, std::string> expected;
  const auto expect = [&](const std::string& name, std::uint64_t value) {
    expected["ssphh_broker_" + name] = std::to_string(value);
  };
  expect("messages_received_total", s.received);
  expect("messages_sent_total", s.sent);
  expect("messages_dropped_total", s.dropped);
  expect("requests_total", s.requests);
  expect("jobs_finished_total", s.finished);
  expect("jobs_failed_total", s.failed);
  expect("jobs_parked_total", s.parked);
  expect("attempts_total", s.attempts);
  expect("retries_total", s.retries);
  expect("hedged_total", s.hedged);
  expect("late_replies_total", s.late_replies);
  expect("workers_lost_total", s.workers_lost);
  expect("workers", s.workers);
  expect("workers_idle", s.idle);
  expect("jobs_queued", s.queued);
  expect("jobs_running", s.running);
  expect("requests_outstanding", s.outstanding);
  expect("request_bytes", s.bytes);
  expect("service_queued{service=\"gen\"}", 0);
  expect("service_queued{service=\"keyed\"}", 1);
  expect("service_queued{service=\"none\"}", 1);
  expect("service_queued{service=\"other\"}", 1);
  EXPECT_EQ(told, expected);
}

TEST_F(Telling, PrometheusReadsAnyNameOfAService) {
  h.send("x", client02("a\"b\\c", {""}));
  EXPECT_THAT(h.core.metrics_text(),
              testing::HasSubstr("ssphh_broker_service_queued{service=\"a\\\"b\\\\c\"} 1\n"));
}

/// The first three of each kind, with all they say.
TEST_F(Telling, WhatHappenedInWords) {
  std::map<std::string, int> told;
  std::string text;
  for (const BrokerEvent& event : h.events) {
    if (++told[event.name] <= 3) text += fmt::format("{} {}\n", name_of(event.level), event.text());
  }
  ssphh::test::expect_text_of("libs/majordomo/tests/expected/events.txt", text);
}

TEST_F(Telling, WorkersInJsonAreTheirOwn) {
  const auto workers = ask("workers")["workers"];
  ASSERT_EQ(workers.size(), 10u);
  const auto& foreign = workers[0];
  EXPECT_EQ(foreign["name"], "foreign");
  EXPECT_EQ(foreign["service"], "other");
  EXPECT_EQ(foreign["state"], "suspect");
  EXPECT_EQ(foreign["heard_ms"], 8000);
  EXPECT_EQ(foreign["since_ms"], 8000);
  EXPECT_EQ(foreign["served"], 0);
  std::map<std::string, int> states;
  int served = 0;
  for (std::size_t i = 1; i < workers.size(); ++i) {
    EXPECT_EQ(workers[i]["name"], fmt::format("w{}", i - 1));
    EXPECT_EQ(workers[i]["heard_ms"], 0);
    EXPECT_EQ(workers[i]["since_ms"], workers[i]["state"] == "busy" ? 0 : 8010) << "all that passed since";
    EXPECT_EQ(workers[i].contains("job"), workers[i]["state"] == "busy");
    ++states[workers[i]["state"].string()];
    served += static_cast<int>(workers[i]["served"].number());
  }
  EXPECT_EQ(states, (std::map<std::string, int>{{"busy", 5}, {"idle", 4}}));
  EXPECT_EQ(served, 6 + 11 + 7 + 1 + 20) << "every answer, whatever it was";
}

}  // namespace
}  // namespace ssphh::majordomo::test
