/// Requests of our clients and of foreign ones: deadlines, cancelling, asking again, equal ones, vanished
/// clients.

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Requests, RequestDeadline) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}, .deadline = 500}));
  h.pass(600);
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::expired);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
}

TEST(Requests, CancelReachesTheWorker) {
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

TEST(Requests, ForeignWorkerIsNotToldOfACancellationThatItsProtocolHasNoWordFor) {
  Harness h;
  h.send("w", ready02("echo"));
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  ASSERT_FALSE(h.job_of("w").empty());
  h.send("c", control(EnvelopeKind::cancel, {{1, 1}}));
  EXPECT_THAT(h.taken("w"), IsEmpty());
}

TEST(Requests, SubmittedAgainIsRunOnce) {
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

TEST(Requests, QueryTellsWhatIsUnknown) {
  Harness h;
  h.send("c", submit("echo", {.ids = {{1, 1}}}));
  h.send("c", control(EnvelopeKind::query, {{1, 1}, {2, 2}}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].kind, EnvelopeKind::unknown);
  EXPECT_THAT(news[0].ids, ElementsAre(RequestId{2, 2}));
}

TEST(Requests, VanishedOwnClientHasAGrace) {
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

TEST(Requests, QueuedRequestsOfVanishedForeignClientsAreDropped) {
  Harness h;
  h.send("c", client01("echo", {"a"}));
  h.gone("c");
  h.send("w", ready01("echo"));
  EXPECT_THAT(h.taken("w"), IsEmpty());
}

// The guide's client gives up after 2.5 s and asks again on a new socket.
TEST(Requests, ImpatientForeignClientGetsTheFirstComputationsResult) {
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

TEST(Requests, EqualRequestsWithAKeyAreComputedOnce) {
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

TEST(Requests, PermanentFailureIsToldAtOnce) {
  Harness h;
  h.send(own_a, ready02("gen"));
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .reason = "scene.glb: broken"}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::failed);
  EXPECT_THAT(news[0].reason, HasSubstr("scene.glb: broken"));
}

TEST(Requests, EnvelopeWithoutTheTokenIsABody) {
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

}  // namespace
}  // namespace ssphh::majordomo::test
