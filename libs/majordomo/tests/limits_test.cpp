/// What the broker refuses: limits, rights of keys, new work while it drains.

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

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

TEST(RightsOfKeys, RevokedWorkersJobRunsElsewhereAndRevokedClientsRequestsAreDropped) {
  Harness h;
  const Rights a{.name = "a", .client = false, .admin = false}, c{.name = "c"};
  h.send(own_a, ready02("echo"), a);
  h.send("c", submit("echo", {.ids = {{1, 1}}}), c);
  ASSERT_FALSE(h.job_of(own_a).empty());
  h.revoke(own_a);
  EXPECT_THAT(h.taken(own_a), ElementsAre(disconnect02));
  h.send(own_b, ready02("echo"));
  h.pass(200);
  EXPECT_FALSE(h.job_of(own_b).empty());
  h.revoke("c");
  h.pass(11'000);
  EXPECT_EQ(h.core.stats().outstanding, 0u);
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

}  // namespace
}  // namespace ssphh::majordomo::test
