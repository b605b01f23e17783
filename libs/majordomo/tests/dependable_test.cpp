/// What the published protocol leaves open: deaths, retries, late and doubled answers, copies of stragglers.

#include "broker_harness.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Dependable, JobOfADeadWorkerRunsElsewhere) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  ASSERT_FALSE(h.job_of("w1").empty());
  h.send("w2", ready02("echo"));
  h.gone("w1");
  h.pass(150);
  h.send("w2", final02(h.job_of("w2"), {"b"}));
  EXPECT_THAT(h.taken("c"), SizeIs(1));
  EXPECT_EQ(h.core.stats().retries, 1u);
}

TEST(Dependable, DisconnectOfABusyWorkerHandsTheJobBackAtOnce) {
  Harness h;
  h.send("w1", ready01("echo"));
  h.send("c", client01("echo", {"a"}));
  h.send("w2", ready01("echo"));
  h.send("w1", disconnect01);
  EXPECT_THAT(h.taken("w2"), SizeIs(1));
}

TEST(Dependable, BackOffDoubles) {
  BrokerLimits limits;
  limits.attempts = 5;
  Harness h(limits);
  h.send("c", client02("echo", {"a"}));
  Millis expected = 100;
  for (int i = 0; i < 4; ++i) {
    const std::string worker = "w" + std::to_string(i);
    h.send(worker, ready02("echo"));
    if (i > 0) {
      h.pass(expected - 1);
      EXPECT_TRUE(h.job_of(worker).empty()) << i;
      h.pass(1);
      expected *= 2;
    }
    ASSERT_FALSE(h.job_of(worker).empty()) << i;
    h.gone(worker);
  }
}

TEST(Dependable, NotTheSameWorkerTwiceWhileThereIsAnother) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send(own_b, ready02("other"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .retry = true, .reason = "no memory"}));
  h.send(own_c, ready02("echo"));
  h.pass(200);
  EXPECT_THAT(h.taken(own_a), IsEmpty());
  EXPECT_FALSE(h.job_of(own_c).empty());
}

TEST(Dependable, TheSameWorkerAgainWhenThereIsNoOther) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .retry = true, .reason = "no memory"}));
  h.pass(200);
  EXPECT_FALSE(h.job_of(own_a).empty());
}

TEST(Dependable, OtherJobsPassAJobThatWantsAnotherWorker) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send(own_b, ready02("echo"));
  h.send("d", submit("echo", {.ids = {{2, 2}}}));
  ASSERT_FALSE(h.job_of(own_b).empty());
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .retry = true, .reason = "no"}));
  h.pass(200);
  EXPECT_THAT(h.taken(own_a), IsEmpty()) << "b is the only other, and busy";
  h.send("d", submit("echo", {.ids = {{3, 3}}}));
  EXPECT_FALSE(h.job_of(own_a).empty());
}

TEST(Dependable, PoisonIsParkedWithItsLog) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  for (const char* w : {"w1", "w2", "w3"}) {
    h.send(w, ready02("echo"));
    h.pass(500);
    ASSERT_FALSE(h.job_of(w).empty()) << w;
    h.gone(w);
  }
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::parked);
  EXPECT_EQ(news[0].attempts, 3u);
  for (const char* w : {"w1", "w2", "w3"}) EXPECT_THAT(news[0].reason, HasSubstr(w));
  h.send("d", client02("mmi.parked", {""}));
  EXPECT_THAT(h.taken("d").at(0).at(4), HasSubstr("connection lost"));
  h.send("w4", ready02("echo"));
  h.pass(60'000);
  EXPECT_THAT(h.taken("w4"), IsEmpty());
}

TEST(Dependable, EndlessHandingBackIsPoisonToo) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  for (int i = 0; i < 200; ++i) {
    const std::string w = "w" + std::to_string(i);
    h.send(w, ready02("echo"));
    h.send(w, disconnect02);
  }
  ASSERT_THAT(h.envelopes("c"), SizeIs(1));
}

TEST(Dependable, LateReplyFromANewConnectionIsWelcome) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  const std::string address = h.job_of("w1");
  h.gone("w1");
  h.send("w1b", ready02("other"));
  h.send("w1b", final02(address, {"b"}));
  EXPECT_THAT(h.taken("c"), SizeIs(1));
  EXPECT_EQ(h.core.stats().workers, 1u);
  EXPECT_EQ(h.core.stats().queued, 0u);
}

TEST(Dependable, SecondAnswerIsFenced) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  const std::string first = h.job_of("w1");
  h.gone("w1");
  h.send("w2", ready02("echo"));
  h.pass(200);
  const std::string second = h.job_of("w2");
  EXPECT_NE(first, second);
  h.send("w2", final02(second, {"b"}));
  h.send("w1", final02(first, {"late"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"MDPC02", "\x03", "echo", "b"}));
  EXPECT_EQ(h.core.stats().late_replies, 1u);
}

TEST(Dependable, SilentBusyForeignWorkerIsSuspectAndItsAnswerStillCounts) {
  Harness h;
  h.send("w1", ready01("echo"));
  h.send("c", client01("echo", {"a"}));
  const std::string first = h.taken("w1").at(0).at(3);
  h.pass(8100);
  EXPECT_EQ(h.count_events("worker-suspect"), 1u);
  h.send("c2", client01("echo", {"x"}));
  EXPECT_THAT(h.taken("w1"), IsEmpty());
  h.send("w2", ready01("echo"));
  const auto copies = h.taken("w2");
  ASSERT_THAT(copies, SizeIs(1)) << "a second copy runs elsewhere";
  EXPECT_EQ(copies[0].at(5), "a");
  h.send("w1", reply01(first, {"from the suspect"}));
  EXPECT_THAT(h.taken("c"), ElementsAre(Frames{"", "MDPC01", "echo", "from the suspect"}));
  EXPECT_THAT(h.taken("w1"), SizeIs(1)) << "it is idle again and gets the next job";
  h.send("w2", reply01(copies[0].at(3), {"late"}));
  EXPECT_THAT(h.taken("c"), IsEmpty());
}

TEST(Dependable, WorkerThatFallsSilentTwiceHasItsJobQueuedOnce) {
  Harness h;
  h.send("w1", ready01("echo"));
  h.send("c", client01("echo", {"a"}));
  h.pass(8000);
  h.send("w1", heartbeat01);
  h.pass(8000);
  EXPECT_EQ(h.count_events("worker-suspect"), 2u);
  EXPECT_EQ(h.core.stats().queued, 1u);
  EXPECT_EQ(h.core.stats().hedged, 1u);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST(Dependable, SilentBusyOwnWorkerIsLost) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.taken(own_a);
  h.send(own_b, ready02("echo"));
  h.pass(5000);
  h.send(own_b, heartbeat02);
  h.pass(4000);
  EXPECT_EQ(h.core.stats().workers, 1u);
  EXPECT_FALSE(h.job_of(own_b).empty());
}

TEST(Dependable, HungComputationHasADeadline) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send(own_b, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}, .attempt_timeout = 3000}));
  ASSERT_FALSE(h.job_of(own_a).empty());
  h.pass(2000);
  h.send(own_a, heartbeat02);
  h.send(own_b, heartbeat02);
  h.pass(1200);
  EXPECT_THAT(h.taken(own_a), ElementsAre(disconnect02));
  EXPECT_FALSE(h.job_of(own_b).empty());
}

TEST(Dependable, StragglersAreRunTwiceAtTheEnd) {
  Harness h;
  for (int i = 0; i < 2; ++i) h.send(i ? own_b : own_a, ready02("gen"));
  for (std::uint64_t i = 1; i <= 8; ++i) h.send("c", submit("gen", {.ids = {{i, i}}}));
  const std::string straggler = h.job_of(own_a);
  for (int i = 0; i < 7; ++i) {
    const std::string address = h.job_of(own_b);
    ASSERT_FALSE(address.empty()) << i;
    h.pass(1000);
    h.send(own_a, heartbeat02);
    h.send(own_b, result(address, {}));
  }
  // 7 of 8 done, median 1 s; the first has run for 7 s.
  const std::string copy = h.job_of(own_b);
  ASSERT_FALSE(copy.empty());
  EXPECT_EQ(h.core.stats().hedged, 1u);
  h.send(own_c, ready02("gen"));
  h.pass(3000);
  EXPECT_THAT(h.taken(own_c), IsEmpty()) << "two copies at most";
  h.taken("c");
  h.send(own_b, result(copy, {}, "first"));
  ASSERT_THAT(h.envelopes("c"), SizeIs(1));
  EXPECT_THAT(h.taken(own_a), SizeIs(1)) << "the other copy is told to stop";
  h.send(own_a, result(straggler, {}, "second"));
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  EXPECT_EQ(h.core.stats().idle, 3u);
}

TEST(Dependable, NoCopiesWhileMuchIsLeft) {
  Harness h;
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.send(own_b, ready02("gen"));
  for (int i = 0; i < 5; ++i) {
    h.pass(3000);
    h.send(own_a, heartbeat02);
    h.send(own_b, heartbeat02);
  }
  EXPECT_EQ(h.core.stats().hedged, 0u);
}

TEST(Dependable, PartialsOfARetryContinueWhereTheFirstStopped) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", client02("echo", {"a"}));
  std::string address = h.job_of("w1");
  h.send("w1", partial02(address, {"0"}));
  h.send("w1", partial02(address, {"1"}));
  h.gone("w1");
  h.send("w2", ready02("echo"));
  h.pass(200);
  address = h.job_of("w2");
  for (const char* part : {"0", "1", "2"}) h.send("w2", partial02(address, {part}));
  h.send("w2", final02(address, {"3"}));
  std::string all;
  for (const Frames& frames : h.taken("c")) all += frames.at(3);
  EXPECT_EQ(all, "0123");
}

// Its PARTIALs are the same each time a job runs; who sends fewer has said less, and the FINAL counts those.
TEST(Dependable, FinalCountsThePartialsOfItsOwnAttempt) {
  Harness h;
  h.send("w1", ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  std::string address = h.job_of("w1");
  for (const char* part : {"0", "1"}) h.send("w1", partial02(address, {part}));
  h.gone("w1");
  h.send("w2", ready02("echo"));
  h.pass(200);
  address = h.job_of("w2");
  h.send("w2", partial02(address, {"0"}));
  h.send("w2", final02(address, {"1 and the rest"}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(3));
  EXPECT_EQ(news[2].kind, EnvelopeKind::final);
  EXPECT_EQ(news[2].sequence, 1u);
}

TEST(Dependable, WorkerThatWasSentAwayMayComeBackOverANewConnection) {
  Harness h;
  h.send("w", submit("other", {.ids = {{1, 1}}}));  // remembered after its connection has gone
  h.send("w", heartbeat02);
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect02));
  h.gone("w");
  h.send("w", ready02("echo"));
  EXPECT_EQ(h.core.stats().workers, 1u);
  h.send("w", ready02("echo"));
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect02)) << "and be sent away again";
}

TEST(Dependable, WorkerThatChangesItsProtocolIsLost) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("w", heartbeat01);
  EXPECT_EQ(h.core.stats().workers, 0u);
  EXPECT_EQ(h.core.stats().dropped, 1u);
  EXPECT_THAT(h.taken("w"), ElementsAre(disconnect01));
}

}  // namespace
}  // namespace ssphh::majordomo::test
