/// A worker that leaves properly, drains or gives its job back has not failed.

#include "broker_harness.h"
#include "recount.h"

namespace ssphh::majordomo::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// A job that may fail on two workers, and the ways in which it comes back from one.
class HandBack : public testing::Test {
 protected:
  void SetUp() override { h.send("c", submit("gen", {.ids = {{1, 1}}})); }

  std::string start(const std::string& worker) {
    h.send(worker, ready02("gen"));
    const std::string address = h.job_of(worker);
    EXPECT_FALSE(address.empty()) << worker;
    return address;
  }
  void leave(const std::string& worker) {
    start(worker);
    h.send(worker, disconnect02);
  }
  void give_back(const std::string& worker) {
    h.send(worker, result(start(worker), {.outcome = Outcome::cancelled}));
    h.send(worker, disconnect02);
  }
  void fail(const std::string& worker) {
    h.send(worker, result(start(worker), {.outcome = Outcome::failed, .retry = true, .reason = "no memory"}));
    h.send(worker, disconnect02);
    h.pass(1000);
  }

  static BrokerLimits limits() {
    BrokerLimits limits;
    limits.attempts = 2;
    return limits;
  }
  Harness h{limits()};
};

TEST_F(HandBack, OfAnyNumberOfWorkersThatLeaveDoesNotPark) {
  for (int i = 0; i < 20; ++i) leave("w" + std::to_string(i));
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  EXPECT_EQ(h.core.stats().queued, 1u);
  EXPECT_EQ(h.core.stats().parked, 0u);
  EXPECT_EQ(h.core.stats().workers_lost, 0u);
  EXPECT_EQ(h.core.stats().retries, 20u);
  EXPECT_EQ(h.count_events("worker-left"), 20u);
  EXPECT_EQ(h.count_events("worker-lost"), 0u);
}

TEST_F(HandBack, OfAnyNumberOfWorkersThatGiveItBackDoesNotPark) {
  for (int i = 0; i < 20; ++i) give_back("ssphh1:w" + std::to_string(i) + "#x");
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  EXPECT_EQ(h.core.stats().queued, 1u);
  EXPECT_EQ(h.core.stats().parked, 0u);
}

TEST_F(HandBack, IsFollowedByTheNextAttemptAtOnce) {
  start(own_a);
  h.send(own_b, ready02("gen"));
  h.send(own_a, disconnect02);
  EXPECT_FALSE(h.job_of(own_b).empty()) << "without any back-off";
}

TEST_F(HandBack, DoesNotMakeTheJobAvoidTheWorker) {
  const std::string address = start(own_a);
  h.send(own_b, ready02("gen"));
  h.send("d", submit("gen", {.ids = {{2, 2}}}));  // b is busy
  ASSERT_FALSE(h.job_of(own_b).empty());
  h.send(own_a, result(address, {.outcome = Outcome::cancelled}));
  EXPECT_FALSE(h.job_of(own_a).empty()) << "it is idle, and has not failed";
}

TEST_F(HandBack, BetweenFailuresIsNotOneOfThem) {
  leave("left");
  fail("ssphh1:first#1");
  give_back("ssphh1:given#2");
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  fail("ssphh1:second#3");
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::parked);
  EXPECT_EQ(news[0].attempts, 5u) << "given back, it was the only worker's once more until that left";
  EXPECT_THAT(news[0].reason,
              AllOf(HasSubstr("failed on 2 workers"), HasSubstr("first: no memory"),
                    HasSubstr("second: no memory"), Not(HasSubstr("left")), Not(HasSubstr("given"))));
}

TEST_F(HandBack, DoesNotLengthenTheBackOffAfterAFailure) {
  for (int i = 0; i < 5; ++i) leave("w" + std::to_string(i));
  h.send(own_a, result(start(own_a), {.outcome = Outcome::failed, .retry = true}));
  h.send(own_b, ready02("gen"));
  h.pass(99);
  EXPECT_TRUE(h.job_of(own_b).empty());
  h.pass(1);
  EXPECT_FALSE(h.job_of(own_b).empty()) << "100 ms: it is the first failure";
}

TEST_F(HandBack, OfADrainingWorkerIsNoFailure) {
  const std::string address = start(own_a);
  h.send("admin", client02("mmi.drain", {"a"}));
  h.send(own_a, result(address, {.outcome = Outcome::cancelled}));
  h.send(own_a, disconnect02);
  fail("ssphh1:first#1");
  EXPECT_EQ(h.core.stats().parked, 0u);
  EXPECT_EQ(h.core.stats().workers_lost, 0u);
  EXPECT_EQ(h.core.stats().workers, 0u);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
}

TEST_F(HandBack, ADrainingWorkerFinishesAndIsGivenNothingMore) {
  const std::string address = start(own_a);
  h.send("c", submit("gen", {.ids = {{2, 2}}}));
  h.send("admin", client02("mmi.drain", {"a"}));
  h.taken(own_a);
  h.send(own_a, result(address, {}, "done"));
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::ok);
  EXPECT_TRUE(h.job_of(own_a).empty());
  EXPECT_EQ(h.core.stats().idle, 0u);
  h.send(own_a, disconnect02);
  EXPECT_EQ(h.core.stats().workers_lost, 0u);
  EXPECT_EQ(h.count_events("job-retry"), 0u);
}

TEST_F(HandBack, ForTheHundredthTimeParks) {
  for (int i = 0; i < 99; ++i) leave("w" + std::to_string(i));
  EXPECT_THAT(h.envelopes("c"), IsEmpty());
  leave("last");
  const auto news = h.envelopes("c");
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].outcome, Outcome::parked);
  EXPECT_EQ(news[0].attempts, 100u);
}

TEST_F(HandBack, OfOneOfTwoCopiesLeavesTheOtherAlone) {
  h.send("w1", ready01("gen"));  // foreign: falls silent, and a copy runs elsewhere
  const std::string first = h.taken("w1").at(0).at(3);
  h.pass(8000);
  const std::string second = start(own_a);
  h.send(own_a, disconnect02);
  EXPECT_EQ(h.core.stats().running, 1u);
  EXPECT_EQ(h.core.stats().queued, 0u);
  EXPECT_EQ(BrokerRecount::disagreements(h.core), "");
  h.send("w1", reply01(first, {"after all"}));
  EXPECT_EQ(h.core.stats().finished, 1u);
  EXPECT_EQ(h.core.stats().retries, 0u);
}

}  // namespace
}  // namespace ssphh::majordomo::test
