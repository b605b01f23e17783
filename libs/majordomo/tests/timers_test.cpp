/// Every time of the broker, on both sides, by its defaults: those of docs/protocol.md.

#include "broker_harness.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Millis minute = 60'000, day = 86'400'000;

class BrokerTimes : public testing::Test {
 protected:
  /// Time passes while these workers beat their hearts.
  void pass_with(std::initializer_list<std::string> workers, Millis time) {
    for (; time > 2500; time -= 2500) {
      h.pass(2500);
      for (const std::string& worker : workers) h.send(worker, heartbeat02);
    }
    h.pass(time);
    for (const std::string& worker : workers) h.send(worker, heartbeat02);
  }
  bool knows(const RequestId& id) {
    h.send("asker", control(EnvelopeKind::query, {id}));
    return h.envelopes("asker").at(0).kind == EnvelopeKind::final;
  }
  /// A finished request of client c, in the past.
  void finish(const RequestId& id, bool persistent) {
    h.send(own_a, ready02("gen"));
    h.send("c", submit("gen", {.ids = {id}, .persistent = persistent}));
    h.send(own_a, result(h.job_of(own_a), {}));
    h.send(own_a, disconnect02);
    h.taken("c");
  }
  Harness h{{}, {}, true};
};

TEST_F(BrokerTimes, HeartbeatComesAfterTwoAndAHalfSecondsOfSayingNothing) {
  h.send("w", ready02("gen"));
  h.pass(2499);
  EXPECT_THAT(h.taken("w", true), IsEmpty());
  h.pass(1);
  EXPECT_THAT(h.taken("w", true), ElementsAre(heartbeat02));
  h.send("w", heartbeat02);
  h.pass(1000);
  h.send("c", client02("gen", {"x"}));
  EXPECT_THAT(h.taken("w", true), SizeIs(1));
  h.pass(2499);
  EXPECT_THAT(h.taken("w", true), IsEmpty()) << "the REQUEST was one, too";
  h.pass(1);
  EXPECT_THAT(h.taken("w", true), ElementsAre(heartbeat02));
}

TEST_F(BrokerTimes, IdleWorkerIsLostAfterEightSecondsOfSilence) {
  h.send("w", ready01("gen"));
  h.pass(3000);
  h.send("w", heartbeat01);
  h.pass(7999);
  EXPECT_EQ(h.core.stats().workers, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().workers, 0u);
  EXPECT_EQ(h.core.stats().workers_lost, 1u);
}

TEST_F(BrokerTimes, BusyOwnWorkerIsLostAfterEightSecondsOfSilence) {
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.pass(7999);
  EXPECT_EQ(h.core.stats().workers, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().workers, 0u);
}

TEST_F(BrokerTimes, BusyForeignWorkerIsSuspectAfterEightSecondsOfSilence) {
  h.send("w", ready02("gen"));
  h.send("c", client02("gen", {"x"}));
  h.pass(7999);
  EXPECT_EQ(h.count_events("worker-suspect"), 0u);
  h.pass(1);
  EXPECT_EQ(h.count_events("worker-suspect"), 1u);
  EXPECT_EQ(h.core.stats().hedged, 1u);
  EXPECT_EQ(h.core.stats().queued, 1u) << "for another worker";
}

TEST_F(BrokerTimes, ForeignRequestWithoutAWorkerExpiresAfterTenMinutes) {
  h.send("f", client02("gen", {"x"}));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.pass(10 * minute - 1);
  EXPECT_EQ(h.core.stats().outstanding, 2u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().outstanding, 1u) << "an own client sets its own deadline";
  EXPECT_EQ(h.core.stats().expired, 1u);
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
}

TEST_F(BrokerTimes, ForeignRequestBehindAWorkerDoesNotExpire) {
  h.send(own_a, ready02("gen"));
  for (int i = 0; i < 2; ++i) h.send("f", client02("gen", {"x"}));
  pass_with({own_a}, 11 * minute);
  EXPECT_EQ(h.core.stats().outstanding, 2u);
}

TEST(BackOff, DoublesFromATenthOfASecondToTenSeconds) {
  BrokerLimits limits;
  limits.attempts = 11;
  Harness h(limits);
  h.send("c", client02("gen", {"x"}));
  for (const Millis pause : {0, 100, 200, 400, 800, 1600, 3200, 6400, 10'000, 10'000}) {
    h.send("w", ready02("gen"));
    if (pause > 0) {
      h.pass(pause - 1);
      for (; h.core.stats().workers == 0;) h.send("w", ready02("gen"));  // was silent for too long
      EXPECT_TRUE(h.job_of("w").empty()) << pause;
      h.pass(1);
    }
    ASSERT_FALSE(h.job_of("w").empty()) << pause;
    h.gone("w");
    h.taken("w");
  }
}

TEST_F(BrokerTimes, AttemptIsOverdueAfterAnHour) {
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  EXPECT_EQ(Token::parse(h.job_of(own_a))->timeout, 60 * minute);
  pass_with({own_a}, 60 * minute - 1);
  EXPECT_EQ(h.core.stats().running, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().running, 0u);
  EXPECT_THAT(h.taken(own_a), ElementsAre(disconnect02));
}

TEST_F(BrokerTimes, AttemptIsOverdueWhenItsRequestSaysSo) {
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}, .attempt_timeout = 700}));
  EXPECT_EQ(Token::parse(h.job_of(own_a))->timeout, 700u);
  h.pass(699);
  EXPECT_THAT(h.taken(own_a), IsEmpty());
  h.pass(1);
  EXPECT_THAT(h.taken(own_a), ElementsAre(disconnect02));
}

TEST_F(BrokerTimes, TheNextJobOfAWorkerHasItsWholeTime) {
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}, .attempt_timeout = 700}));
  h.pass(600);
  h.send(own_a, result(h.job_of(own_a), {}));
  h.send("c", submit("gen", {.ids = {{2, 2}}, .attempt_timeout = 700}));
  h.taken(own_a);
  h.pass(699);
  EXPECT_THAT(h.taken(own_a), IsEmpty());
  h.pass(1);
  EXPECT_THAT(h.taken(own_a), ElementsAre(disconnect02));
}

TEST_F(BrokerTimes, RequestExpiresAtItsDeadline) {
  h.send("c", submit("gen", {.ids = {{1, 1}}, .deadline = 500}));
  h.pass(499);
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  h.pass(1);
  EXPECT_EQ(h.envelopes("c").at(0).outcome, Outcome::expired);
}

TEST_F(BrokerTimes, ReplyIsOnRecordForAMinute) {
  finish({1, 1}, false);
  h.pass(minute - 1);
  EXPECT_TRUE(knows({1, 1}));
  h.pass(1);
  EXPECT_FALSE(knows({1, 1}));
  EXPECT_THAT(h.store, IsEmpty());
}

TEST_F(BrokerTimes, PersistentResultIsKeptForSevenDays) {
  finish({1, 1}, true);
  h.store.clear();
  h.pass(7 * day - 1);
  EXPECT_TRUE(knows({1, 1}));
  EXPECT_THAT(h.store, IsEmpty());
  h.pass(1);
  EXPECT_FALSE(knows({1, 1}));
  ASSERT_THAT(h.store, SizeIs(1)) << "nor does the store";
  EXPECT_EQ(h.store[0].kind, StoreOperation::forget);
  EXPECT_EQ(BrokerRecount::books(h.core), BrokerBooks{});
}

TEST_F(BrokerTimes, PersistentResultIsKeptForSevenDaysAfterARestart) {
  const auto body = std::make_shared<const Frames>(Frames{"b"});
  h.core.restore(h.now, {.id = {1, 1}, .service = "gen", .body = body, .finished = true, .reply = body});
  h.pass(7 * day - 1);
  EXPECT_TRUE(knows({1, 1}));
  h.pass(1);
  EXPECT_FALSE(knows({1, 1}));
}

TEST(StoredResult, IsKeptAsLongAsTheOptionSays) {
  BrokerTimers timers;
  timers.stored_result = 5000;
  Harness h({}, timers, true);
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}, .persistent = true}));
  h.send(own_a, result(h.job_of(own_a), {}));
  h.pass(4999);
  EXPECT_EQ(h.core.stats().records, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().records, 0u);
}

// Looked at once a minute.
TEST_F(BrokerTimes, ServiceWithoutWorkersIsForgottenAfterTenMinutes) {
  h.send("w", ready02("gen"));
  h.send("w", disconnect02);
  h.pass(11 * minute - 1);
  EXPECT_EQ(h.core.stats().services, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().services, 0u);
}

TEST_F(BrokerTimes, ServiceWithARequestIsNotForgotten) {
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.pass(30 * minute);
  EXPECT_EQ(h.core.stats().services, 1u);
}

TEST_F(BrokerTimes, ServiceIsForgottenTenMinutesAfterItsLastUse) {
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.pass(5 * minute);
  h.send("c", control(EnvelopeKind::cancel, {{1, 1}}));
  h.pass(11 * minute - 1);
  EXPECT_EQ(h.core.stats().services, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().services, 0u);
}

// Looked at once a minute.
TEST_F(BrokerTimes, SilentClientWithoutRequestsIsForgottenAfterAMinute) {
  h.send("c", client02("mmi.service", {"x"}));
  h.pass(2 * minute - 1);
  EXPECT_EQ(h.core.stats().peers, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().peers, 0u);
}

TEST_F(BrokerTimes, RequestsOfAVanishedOwnClientWaitTenSeconds) {
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.gone("c");
  h.pass(9999);
  EXPECT_EQ(h.core.stats().outstanding, 1u);
  h.pass(1);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
  EXPECT_EQ(h.core.stats().peers, 0u);
}

TEST_F(BrokerTimes, RequestsOfAClientThatComesBackInTimeStay) {
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.gone("c");
  h.pass(9999);
  h.send("c", control(EnvelopeKind::query, {{1, 1}}));
  h.pass(minute);
  EXPECT_EQ(h.core.stats().outstanding, 1u);
}

/// How many answers a second client gets that asks for the same as the first after so long.
std::size_t answers_after(Millis wait, bool released) {
  BrokerLimits limits;
  limits.attempts = 1;
  Harness h(limits);
  const Frames request = client02("gen", {"probe"});
  if (released) {
    h.send("c", submit("gen", {.ids = {{1, 1}}}, "probe"));
    h.send("v", ready02("gen"));
    h.gone("v");
    h.send("admin", client02("mmi.release", {"all"}));
    h.send("w", ready02("gen"));
  } else {
    h.send("w", ready02("gen"));
    h.send("c", request);
    h.gone("c");
  }
  h.send("w", final02(h.job_of("w"), {"result"}));
  h.pass(wait);
  h.send("d", request);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  return h.taken("d").size();
}

TEST(KeptResult, OfAVanishedForeignClientWaitsForHalfAMinute) {
  EXPECT_EQ(answers_after(29'999, false), 1u);
  EXPECT_EQ(answers_after(30'000, false), 0u);
}

TEST(KeptResult, OfAReleasedJobWaitsForTenMinutes) {
  EXPECT_EQ(answers_after(10 * minute - 1, true), 1u);
  EXPECT_EQ(answers_after(10 * minute, true), 0u);
}

TEST(Busy, ClientsAreToldAfterWhatTimeToTryAgain) {
  BrokerLimits limits;
  limits.client_requests = 1;
  Harness h(limits);
  for (std::uint64_t i = 1; i <= 2; ++i) h.send("c", submit("gen", {.ids = {{i, i}}}));
  EXPECT_EQ(h.envelopes("c").at(0).retry_after, 250);
  h.core.drain(h.now);
  h.send("d", submit("gen", {.ids = {{3, 3}}}));
  EXPECT_EQ(h.envelopes("d").at(0).retry_after, 1000);
}

TEST(DroppedMessages, AreLoggedTenTimesASecond) {
  Harness h;
  const auto drops = [&](int count) {
    for (int i = 0; i < count; ++i) h.core.dropped(h.now, "p", "reason");
    h.send("x", heartbeat02);
    return h.count_events("message-dropped");
  };
  EXPECT_EQ(drops(15), 10u);
  h.pass(999);
  EXPECT_EQ(drops(5), 10u);
  h.pass(1);
  EXPECT_EQ(drops(15), 20u);
  EXPECT_EQ(h.core.stats().dropped, 35u) << "and counted always";
}

// The broker looks for them four times within the time that they have, every 50 ms to every minute.
TEST(ExpiredRequests, AreFoundByTheNextLook) {
  struct Case {
    Millis expiry, found;
  };
  for (const auto& [expiry, found] : {Case{400, 1500}, Case{100, 1150}, Case{480'000, 541'000}}) {
    BrokerTimers timers;
    timers.request_expiry = expiry;
    Harness h({}, timers);  // looks for the first time at 1000
    h.pass(10);
    h.send("c", client01("nobody", {"x"}));
    h.pass(found - 1 - h.now);
    EXPECT_EQ(h.core.stats().outstanding, 1u) << expiry;
    h.pass(1);
    EXPECT_EQ(h.core.stats().outstanding, 0u) << expiry;
  }
}

}  // namespace
}  // namespace ssphh::majordomo::test
