/// Persistent requests, restarts and 9/TSP.

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

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

TEST(Store, WhatItHeldIsAsItWas) {
  const auto body = std::make_shared<const Frames>(Frames{"probe"});
  const auto reply = std::make_shared<const Frames>(Frames{"reply"});
  Harness h({}, {}, true);
  h.core.restore(h.now, {.id = {1, 1}, .service = "gen", .body = body, .attempt_timeout = 1234});
  h.core.restore(h.now, {.id = {2, 2},
                         .service = "viz",
                         .body = body,
                         .attempt_timeout = 4321,
                         .finished = true,
                         .outcome = Outcome::parked,
                         .reason = "failed on 3 workers",
                         .attempts = 5,
                         .reply = reply});
  h.send(own_a, ready02("gen"));
  EXPECT_EQ(Token::parse(h.job_of(own_a))->timeout, 1234u);
  h.send("c", control(EnvelopeKind::query, {{2, 2}}));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::parked);
  EXPECT_EQ(news[0].reason, "failed on 3 workers");
  EXPECT_EQ(news[0].attempts, 5u);
  h.send("admin", client02("mmi.release", {"all"}));
  EXPECT_EQ(h.store.back().request.attempt_timeout, 4321);
  h.send(own_b, ready02("viz"));
  EXPECT_EQ(Token::parse(h.job_of(own_b))->timeout, 4321u);
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

TEST(Titanic, FailedAndRefusedRequestsAreTold) {
  Harness h({}, {}, true);
  const auto code = [&](const std::string& service, Frames body) {
    h.send("c", client01(service, std::move(body)));
    return h.taken("c").at(0).at(3);
  };
  h.send("c", client01("titanic.request", {"echo", "a"}));
  const std::string uuid = h.taken("c").at(0).at(4);
  h.send(own_a, ready02("echo"));
  h.send(own_a, result(h.job_of(own_a), {.outcome = Outcome::failed, .reason = "broken"}));
  EXPECT_EQ(code("titanic.reply", {uuid}), "500");
  EXPECT_EQ(code("titanic.request", {"echo"}), "400") << "no body";
  h.core.drain(h.now);
  EXPECT_EQ(code("titanic.request", {"echo", "a"}), "500");
}

}  // namespace
}  // namespace ssphh::majordomo::test
