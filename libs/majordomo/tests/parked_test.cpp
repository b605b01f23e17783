/// Jobs that were set aside: listed, put back, forgotten.

#include "broker_harness.h"
#include "json_text.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Kills one worker after the other with the job that is waiting, until it is set aside.
void poison(Harness& h, const std::string& name) {
  for (int i = 0; i < 3; ++i) {
    const std::string worker = name + std::to_string(i);
    h.send(worker, ready02("gen"));
    h.pass(500);
    ASSERT_FALSE(h.job_of(worker).empty()) << worker;
    h.gone(worker);
  }
}

/// The reply's frames behind the service.
Frames ask(Harness& h, const std::string& service, const std::string& body, const Rights& rights = {}) {
  h.send("admin", client02(service, {body}), rights);
  const Frames reply = h.taken("admin").at(0);
  return Frames(reply.begin() + 3, reply.end());
}

const json::Value list(Harness& h) {
  return ssphh::test::parse_json(ask(h, "mmi.parked", "").at(1))["jobs"];
}

TEST(Parked, ReleasedJobsRunAgainAndTheirResultIsForWhoeverAsksForTheSame) {
  Harness h;
  h.send("c", submit("gen", {.ids = {{1, 1}}}, "probe 7"));
  poison(h, "w");
  EXPECT_EQ(h.envelopes("c").at(0).outcome, Outcome::parked);
  h.pass(2000);
  const auto parked = list(h);
  ASSERT_EQ(parked.size(), 1u);
  EXPECT_EQ(parked[0]["bytes"], 7);
  EXPECT_EQ(parked[0]["since_ms"], 2000);
  EXPECT_EQ(parked[0]["failures"].size(), 3u);

  EXPECT_THAT(ask(h, "mmi.release", "99"), ElementsAre("404"));
  EXPECT_THAT(ask(h, "mmi.release", "all of them"), ElementsAre("400"));
  EXPECT_THAT(ask(h, "mmi.release", print(parked[0]["job"])), ElementsAre("200", "1"));
  EXPECT_TRUE(list(h).empty());
  h.send(own_a, ready02("gen"));
  const std::string address = h.job_of(own_a);
  ASSERT_FALSE(address.empty());
  h.send(own_a, result(address, {}, "seven"));
  h.pass(300'000);
  h.send(own_a, heartbeat02);
  h.send("d", submit("gen", {.ids = {{2, 2}}}, "probe 8"));
  EXPECT_THAT(h.envelopes("d"), IsEmpty()) << "another job";
  h.send("d", submit("gen", {.ids = {{3, 3}}}, "probe 7"));
  const auto answers = h.taken("d");
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(answers[0].back(), "seven");
  h.send("d", submit("gen", {.ids = {{3, 3}}}, "probe 7"));
  EXPECT_THAT(h.taken("d"), SizeIs(1)) << "the answer got lost and is given again";
}

TEST(Parked, WhoAsksWhileAReleasedJobRunsJoinsIt) {
  Harness h;
  h.send("c", submit("gen", {.ids = {{1, 1}}}, "probe 7"));
  poison(h, "w");
  h.envelopes("c");
  EXPECT_THAT(ask(h, "mmi.release", "all"), ElementsAre("200", "1"));
  h.send(own_a, ready02("gen"));
  const std::string address = h.job_of(own_a);
  h.send("c", submit("gen", {.ids = {{4, 4}}}, "probe 7"));
  EXPECT_EQ(h.core.stats().running + h.core.stats().queued, 1u);
  h.send(own_a, result(address, {}));
  ASSERT_THAT(h.envelopes("c"), SizeIs(1));
  EXPECT_EQ(h.core.stats().outstanding, 0u);
}

TEST(Parked, ReleasedPoisonIsSetAsideAgain) {
  Harness h;
  h.send("c", submit("gen", {.ids = {{1, 1}}}));
  poison(h, "w");
  ask(h, "mmi.release", "all");
  poison(h, "v");
  EXPECT_EQ(list(h).size(), 1u);
  EXPECT_THAT(ask(h, "mmi.drop", "all"), ElementsAre("200", "1"));
  EXPECT_TRUE(list(h).empty());
  h.send(own_a, ready02("gen"));
  EXPECT_TRUE(h.job_of(own_a).empty());
  EXPECT_EQ(h.core.stats().outstanding, 0u);
  EXPECT_EQ(h.core.stats().bytes, 0u);
}

TEST(Parked, PersistentRequestsGetTheResultUnderTheirIdAlsoAfterARestart) {
  Harness h({}, {}, true);
  h.send("c", client01("titanic.request", {"gen", "probe 7"}));
  const RequestId id = *RequestId::parse(h.taken("c").at(0).at(4));
  poison(h, "w");
  ASSERT_THAT(h.store, SizeIs(2));
  EXPECT_EQ(h.store[1].kind, StoreOperation::finish);

  Harness again({}, {}, true);
  StoredRequest stored = h.store[0].request;
  stored.finished = true;
  stored.outcome = h.store[1].request.outcome;
  stored.reason = h.store[1].request.reason;
  stored.reply = h.store[1].request.reply;
  again.core.restore(again.now, std::move(stored));
  ASSERT_EQ(list(again).size(), 1u);
  EXPECT_THAT(ask(again, "mmi.release", "all"), ElementsAre("200", "1"));
  EXPECT_EQ(again.store.back().kind, StoreOperation::add);
  again.send(own_a, ready02("gen"));
  again.send(own_a, result(again.job_of(own_a), {}, "seven"));
  again.send("c", client01("titanic.reply", {id.hex()}));
  EXPECT_THAT(again.taken("c"), ElementsAre(Frames{"", "MDPC01", "titanic.reply", "200", "seven"}));
}

TEST(Parked, ReleasedJobsKeepTheTimeOfTheirAttempts) {
  Harness h;
  h.send("c", submit("gen", {.ids = {{1, 1}}, .attempt_timeout = 4321}));
  poison(h, "w");
  ask(h, "mmi.release", "all");
  h.send(own_a, ready02("gen"));
  EXPECT_EQ(Token::parse(h.job_of(own_a))->timeout, 4321u);
}

// A foreign client asked for the same and vanished while it runs: its result is kept already.
TEST(Parked, ReleasedJobLeavesTheResultOfAnEqualOneAlone) {
  Harness h;
  h.send("c", submit("gen", {.ids = {{1, 1}}}, "probe 7"));
  poison(h, "w");
  h.send(own_a, ready02("gen"));
  h.send("f", client02("gen", {"probe 7"}));
  const std::string foreign = h.job_of(own_a);
  h.gone("f");
  ask(h, "mmi.release", "all");
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  h.send(own_b, ready02("gen"));
  h.send(own_b, result(h.job_of(own_b), {}, "of the released"));
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  h.send(own_a, result(foreign, {}, "of the first"));
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  h.send("f2", client02("gen", {"probe 7"}));
  EXPECT_EQ(h.taken("f2").at(0).back(), "of the first");
}

TEST(Parked, OnlyAdministratorsReleaseAndDrop) {
  Harness h;
  const Rights user{.name = "user", .admin = false};
  EXPECT_THAT(ask(h, "mmi.release", "all", user), ElementsAre("403"));
  EXPECT_THAT(ask(h, "mmi.drop", "all", user), ElementsAre("403"));
}

TEST(Parked, BodiesAreBounded) {
  BrokerLimits limits;
  limits.parked_bytes = 1000;
  Harness h(limits);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    h.send("c", submit("gen", {.ids = {{i, i}}}, std::string(400, 'x')));
    poison(h, "w" + std::to_string(i));
  }
  EXPECT_EQ(list(h).size(), 2u);
}

}  // namespace
}  // namespace ssphh::majordomo::test
