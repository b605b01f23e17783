/// What the published protocol leaves open: deaths, retries, late and doubled answers, envelopes, limits.

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string own_a = "ssphh1:a#1", own_b = "ssphh1:b#2", own_c = "ssphh1:c#3";

Frames result(const std::string& address, Envelope envelope, const std::string& body = "result") {
  envelope.kind = EnvelopeKind::result;
  envelope.token = Token::parse(address);
  return final02(address, {encode_envelope(envelope), body});
}

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

TEST(Dependable, RequestDeadline) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}, .deadline = 500}));
  h.pass(600);
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::expired);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
}

TEST(Dependable, CancelReachesTheWorker) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  const std::string address = h.job_of(own_a);
  h.send("c", control(EnvelopeKind::cancel, {{1, 1}}));
  EXPECT_EQ(h.envelopes("c").at(0).outcome, Outcome::cancelled);
  const auto told = h.taken(own_a);
  ASSERT_THAT(told, SizeIs(1));
  const auto envelope = decode_envelope(told[0].at(2));
  ASSERT_TRUE(envelope);
  EXPECT_EQ(envelope->kind, EnvelopeKind::cancel_job);
  EXPECT_EQ(envelope->token, Token::parse(address));
  h.send(own_a, result(address, {.outcome = Outcome::cancelled}));
  EXPECT_EQ(h.core.stats().idle, 1u);
}

TEST(Dependable, SubmittedAgainIsRunOnce) {
  Harness h;
  h.send(own_a, ready02("echo"));
  const Frames request = submit("echo", {.ids = {{1, 1}}});
  h.send("c", request);
  h.send("c", request);
  h.gone("c");
  h.send("c2", request);
  const std::string address = h.job_of(own_a);
  ASSERT_FALSE(address.empty());
  h.send(own_a, result(address, {}));
  EXPECT_THAT(h.envelopes("c2"), SizeIs(1));
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  h.send("c3", request);  // from the record
  EXPECT_THAT(h.envelopes("c3"), SizeIs(1));
  EXPECT_EQ(h.core.stats().attempts, 1u);
  h.send("c3", control(EnvelopeKind::ack, {{1, 1}}));
  EXPECT_EQ(h.core.stats().records, 0u);
}

TEST(Dependable, QueryTellsWhatIsUnknown) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send("c", control(EnvelopeKind::query, {{1, 1}, {2, 2}}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].kind, EnvelopeKind::unknown);
  EXPECT_THAT(news[0].ids, ElementsAre(RequestId{2, 2}));
}

TEST(Dependable, VanishedOwnClientHasAGrace) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.gone("c");
  h.pass(9000);
  EXPECT_EQ(h.core.stats().outstanding, 1u);
  h.pass(2000);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
  h.send("w", ready02("echo"));
  EXPECT_THAT(h.taken("w"), IsEmpty());
}

TEST(Dependable, QueuedRequestsOfVanishedForeignClientsAreDropped) {
  Harness h;
  h.send("c", client01("echo", {"a"}));
  h.gone("c");
  h.send("w", ready01("echo"));
  EXPECT_THAT(h.taken("w"), IsEmpty());
}

// The guide's client gives up after 2.5 s and asks again on a new socket.
TEST(Dependable, ImpatientForeignClientGetsTheFirstComputationsResult) {
  Harness h;
  h.send("w", ready01("slow"));
  h.send("w2", ready01("slow"));
  h.send("c1", client01("slow", {"a"}));
  const std::string address = h.taken("w").at(0).at(3);
  h.pass(2500);
  h.gone("c1");
  h.send("c2", client01("slow", {"a"}));
  EXPECT_THAT(h.taken("w2"), IsEmpty());
  h.pass(1500);
  h.send("w", reply01(address, {"b"}));
  EXPECT_THAT(h.taken("c2"), SizeIs(1));
  // and when the answer comes between two tries
  h.send("c3", client01("slow", {"z"}));
  const std::string again = h.taken("w2").at(0).at(3);
  h.gone("c3");
  h.send("w2", reply01(again, {"y"}));
  h.send("c4", client01("slow", {"z"}));
  EXPECT_THAT(h.taken("c4"), ElementsAre(Frames{"", "MDPC01", "slow", "y"}));
  EXPECT_EQ(h.core.stats().attempts, 2u);
}

TEST(Dependable, EqualRequestsWithAKeyAreComputedOnce) {
  Harness h;
  h.send("c1", submit("gen", {.ids = {{1, 1}}, .content_key = Hash128{7, 7}}));
  h.send("c2", submit("gen", {.ids = {{2, 2}}, .content_key = Hash128{7, 7}}));
  h.send("c3", submit("gen", {.ids = {{3, 3}}, .content_key = Hash128{7, 7}}, "another body"));
  h.send("c4", submit("viz", {.ids = {{4, 4}}, .content_key = Hash128{7, 7}}));
  h.send(own_a, ready02("gen"));
  const std::string address = h.job_of(own_a);
  h.send("c1", control(EnvelopeKind::cancel, {{1, 1}}));
  EXPECT_THAT(h.taken(own_a), IsEmpty()) << "somebody else still waits";
  h.send(own_a, result(address, {}));
  EXPECT_THAT(h.envelopes("c2"), SizeIs(1));
  EXPECT_THAT(h.envelopes("c3"), IsEmpty());
  EXPECT_EQ(h.core.stats().coalesced, 1u);
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

TEST(Dependable, PermanentFailureIsToldAtOnce) {
  Harness h;
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .reason = "scene.glb: broken"}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::failed);
  EXPECT_THAT(news[0].reason, HasSubstr("scene.glb: broken"));
}

TEST(Dependable, EnvelopeWithoutTheTokenIsABody) {
  Harness h;
  h.send("w", ready02("echo"));
  const Frame looks = encode_envelope({.kind = EnvelopeKind::result, .outcome = Outcome::failed});
  h.send("c", submit("echo", {.ids = {{1, 1}}}, looks));
  h.send("w", final02(h.job_of("w"), {looks}));
  const auto all = h.taken("c");
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(decode_envelope(all[0].at(3))->outcome, Outcome::ok);
  EXPECT_EQ(all[0].at(4), looks);
}

TEST(Limits, BusyToOwnClientsSilenceToForeignOnes) {
  BrokerLimits limits;
  limits.client_requests = 2;
  Harness h(limits);
  for (std::uint64_t i = 1; i <= 3; ++i) h.send("c", submit("echo", {.ids = {{i, i}}}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].kind, EnvelopeKind::busy);
  EXPECT_THAT(news[0].ids, ElementsAre(RequestId{3, 3}));
  EXPECT_GT(news[0].retry_after, 0);
  for (int i = 0; i < 3; ++i) h.send("f", client02("echo", {"a"}));
  EXPECT_EQ(h.core.stats().dropped, 1u);
  h.send("d", submit("echo", {.ids = {{9, 9}}}));
  EXPECT_THAT(h.envelopes("d"), IsEmpty()) << "another client has its own account";
}

TEST(Limits, BytesPerClient) {
  BrokerLimits limits;
  limits.client_bytes = 1000;
  Harness h(limits);
  h.send("c", submit("echo", {.ids = {{1, 1}}}, std::string(800, 'x')));
  h.send("c", submit("echo", {.ids = {{2, 2}}}, std::string(800, 'x')));
  h.send("c", submit("echo", {.ids = {{3, 3}}}, std::string(2000, 'x')));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(2));
  EXPECT_EQ(news[0].kind, EnvelopeKind::busy);
  EXPECT_EQ(news[1].outcome, Outcome::refused);
  h.send("c", control(EnvelopeKind::cancel, {{1, 1}}));
  EXPECT_EQ(h.core.stats().bytes, 0u);
}

TEST(Limits, MessageRate) {
  BrokerLimits limits;
  limits.messages_per_second = 10;
  Harness h(limits);
  for (int i = 0; i < 15; ++i) h.send("c", client02("mmi.service", {"x"}));
  EXPECT_THAT(h.taken("c"), SizeIs(10));
  EXPECT_EQ(h.core.stats().dropped, 5u);
  h.pass(500);
  for (int i = 0; i < 15; ++i) h.send("c", client02("mmi.service", {"x"}));
  EXPECT_THAT(h.taken("c"), SizeIs(5));
}

TEST(Limits, ReplySize) {
  BrokerLimits limits;
  limits.reply_bytes = 10;
  Harness h(limits);
  h.send("w", ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  const std::string address = h.job_of("w");
  h.send("w", partial02(address, {"12345678"}));
  h.send("w", final02(address, {"12345678"}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(2));
  EXPECT_EQ(news[1].outcome, Outcome::failed);
  EXPECT_EQ(h.core.stats().idle, 1u);
}

TEST(Limits, RecordsAreBounded) {
  BrokerLimits limits;
  limits.record_bytes = 5000;
  Harness h(limits);
  h.send(own_a, ready02("echo"));
  for (std::uint64_t i = 1; i <= 100; ++i) {
    h.send("c", submit("echo", {.ids = {{i, i}}}));
    h.send(own_a, result(h.job_of(own_a), {}));
  }
  EXPECT_LE(h.core.stats().records, 5000u / 300u);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
}

TEST(Limits, PeersAndServices) {
  BrokerLimits limits;
  limits.peers = 3;
  limits.services = 2;
  Harness h(limits);
  for (int i = 0; i < 3; ++i) h.send("c", client02("s" + std::to_string(i), {"a"}));
  EXPECT_EQ(h.core.stats().services, 2u);
  for (int i = 0; i < 5; ++i) h.send("p" + std::to_string(i), client02("mmi.service", {"a"}));
  EXPECT_EQ(h.core.stats().peers, 3u);
}

TEST(RightsOfKeys, AreKept) {
  Harness h;
  const Rights worker{.name = "w", .client = false, .admin = false, .services = {"gen", "viz.*"}};
  h.send("w1", ready02("gen"), worker);
  h.send("w2", ready02("viz.7"), worker);
  h.send("w3", ready02("ref"), worker);
  EXPECT_THAT(h.taken("w3"), ElementsAre(disconnect02));
  EXPECT_EQ(h.core.stats().workers, 2u);
  h.send("w1", client02("gen", {"x"}), worker);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
  const Rights client{.name = "c", .client = true, .admin = false, .services = {}};
  h.send("c", client02("mmi.drain", {""}), client);
  EXPECT_EQ(h.taken("c").at(0).at(3), "403");
  h.send("c", ready02("gen"), client);
  EXPECT_THAT(h.taken("c"), ElementsAre(disconnect02));
}

TEST(Drain, RunningJobsFinishNewOnesWait) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send("c", submit("echo", {.ids = {{2, 2}}}));
  const std::string address = h.job_of(own_a);
  h.core.drain(h.now);
  EXPECT_FALSE(h.core.drained());
  h.send("c", submit("echo", {.ids = {{3, 3}}}));
  EXPECT_EQ(h.envelopes("c").at(0).kind, EnvelopeKind::busy);
  h.send(own_a, result(address, {}));
  EXPECT_THAT(h.taken(own_a), IsEmpty());
  EXPECT_TRUE(h.core.drained());
}

TEST(Drain, WorkersAreToldToLeave) {
  Harness h;
  h.send(own_a, ready02("echo"));
  h.send(own_b, ready02("echo"));
  h.send("x", client02("mmi.drain", {"a"}));
  EXPECT_THAT(h.taken("x"), ElementsAre(Frames{"MDPC02", "\x03", "mmi.drain", "200", "1"}));
  ASSERT_THAT(h.taken(own_a), SizeIs(1));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  EXPECT_THAT(h.taken(own_a), IsEmpty());
  EXPECT_FALSE(h.job_of(own_b).empty());
}

TEST(Store, OperationsAndRestore) {
  Harness h({}, {}, true);
  h.send("c", submit("echo", {.ids = {{1, 1}}, .persistent = true}));
  h.send("c", submit("echo", {.ids = {{2, 2}}, .persistent = true}));
  EXPECT_EQ(h.envelopes("c").at(0).kind, EnvelopeKind::accepted);
  h.send(own_a, ready02("echo"));
  h.send(own_a, result(h.job_of(own_a), {}));
  ASSERT_THAT(h.store, SizeIs(3));
  EXPECT_EQ(h.store[2].kind, StoreOperation::finish);

  Harness again({}, {}, true);  // after a restart
  StoredRequest finished = h.store[0].request;
  finished.finished = true;
  finished.reply = h.store[2].request.reply;
  again.core.restore(again.now, std::move(finished));
  again.core.restore(again.now, StoredRequest(h.store[1].request));
  again.send("c2", control(EnvelopeKind::query, {{1, 1}, {2, 2}, {3, 3}}));
  const auto news = again.envelopes("c2");
  ASSERT_THAT(news, SizeIs(2));
  EXPECT_EQ(news[0].kind, EnvelopeKind::final);
  EXPECT_THAT(news[1].ids, ElementsAre(RequestId{3, 3}));
  again.send(own_a, ready02("echo"));
  again.send(own_a, result(again.job_of(own_a), {}));
  EXPECT_THAT(again.envelopes("c2"), SizeIs(1));
  again.store.clear();
  again.send("c2", control(EnvelopeKind::ack, {{1, 1}, {2, 2}}));
  EXPECT_THAT(again.store, SizeIs(2));
}

TEST(Store, PersistentWithoutAStoreIsRefused) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}, .persistent = true}));
  EXPECT_EQ(h.envelopes("c").at(0).outcome, Outcome::refused);
}

TEST(Titanic, RequestReplyClose) {
  Harness h({}, {}, true);
  const auto ask = [&](const std::string& service, Frames body) {
    h.send("c", client01(service, std::move(body)));
    Frames reply = h.taken("c").at(0);
    return Frames(reply.begin() + 3, reply.end());
  };
  const Frames taken = ask("titanic.request", {"echo", "a", "b"});
  ASSERT_THAT(taken, SizeIs(2));
  EXPECT_EQ(taken[0], "200");
  const std::string uuid = taken[1];
  ASSERT_EQ(uuid.size(), 32u);
  EXPECT_THAT(ask("titanic.reply", {uuid}), ElementsAre("300"));
  h.gone("c");
  h.send("w", ready01("echo"));
  const auto jobs = h.taken("w");
  ASSERT_THAT(jobs, SizeIs(1));
  EXPECT_EQ(Frames(jobs[0].begin() + 5, jobs[0].end()), Frames({"a", "b"}));
  h.pass(2000);
  h.send("w", reply01(jobs[0][3], {"x", "y"}));
  EXPECT_THAT(ask("titanic.reply", {uuid}), ElementsAre("200", "x", "y"));
  EXPECT_THAT(ask("titanic.reply", {uuid}), ElementsAre("200", "x", "y")) << "idempotent";
  EXPECT_THAT(ask("titanic.close", {uuid}), ElementsAre("200"));
  EXPECT_THAT(ask("titanic.close", {uuid}), ElementsAre("200")) << "idempotent";
  EXPECT_THAT(ask("titanic.reply", {uuid}), ElementsAre("400"));
  EXPECT_THAT(ask("titanic.close", {"../../etc/passwd"}), ElementsAre("400"));
  EXPECT_THAT(ask("titanic.request", {"mmi.service", "x"}), ElementsAre("400"));
  EXPECT_THAT(ask("titanic.else", {"x"}), ElementsAre("501"));
  h.send("v", ready01("titanic.request"));
  EXPECT_THAT(h.taken("v"), ElementsAre(disconnect01));
}

}  // namespace
}  // namespace ssphh::majordomo::test
