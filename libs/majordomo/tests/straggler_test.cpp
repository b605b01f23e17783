/// When the last jobs of a client are run twice, on both sides of each threshold.

#include "broker_harness.h"

namespace ssphh::majordomo::test {
namespace {

class Stragglers : public testing::Test {
 protected:
  static BrokerTimers patient() {
    BrokerTimers timers;
    timers.worker_expiry = 1'000'000'000;  // no heartbeats needed here
    return timers;
  }
  void submit_jobs(const std::string& client, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) h.send(client, submit("gen", {.ids = {{++number_, 9}}}));
  }
  /// What worker b has in hand takes so long.
  void finish_on_b(Millis duration) {
    const std::string address = h.job_of(own_b);
    ASSERT_FALSE(address.empty());
    h.pass(duration);
    h.send(own_b, result(address, {}));
  }
  /// Worker b does as many jobs of a client that has two more; then a and b have these, and c has nothing.
  void leave_two(const std::vector<Millis>& durations) {
    h.send(own_b, ready02("gen"));
    submit_jobs("c", durations.size() + 2);
    for (const Millis duration : durations) finish_on_b(duration);
    h.send(own_a, ready02("gen"));
    ASSERT_FALSE(h.job_of(own_a).empty());
    h.send(own_c, ready02("gen"));
  }
  void expect_copy_after(Millis time) {
    h.pass(time - 1);
    EXPECT_EQ(h.core.stats().hedged, 0u);
    h.pass(1);
    EXPECT_EQ(h.core.stats().hedged, 1u);
    EXPECT_FALSE(h.job_of(own_c).empty());
  }
  void expect_no_copy() {
    h.pass(3'000'000);
    EXPECT_EQ(h.core.stats().hedged, 0u);
  }

  Harness h{{}, patient()};

 private:
  std::uint64_t number_ = 0;
};

TEST_F(Stragglers, AreOlderThanOneAndAHalfMedians) {
  leave_two(std::vector<Millis>(6, 2000));
  expect_copy_after(3000);
}

TEST_F(Stragglers, AreNotMeasuredByTheMean) {
  leave_two({6000, 1000, 60'000, 2000, 4000, 90'000, 3000});
  expect_copy_after(6000);
}

TEST_F(Stragglers, AreAtLeastASecondOld) {
  leave_two(std::vector<Millis>(6, 100));
  expect_copy_after(1000);
}

TEST_F(Stragglers, AreRunTwiceWhenThreeQuartersAreDone) {
  leave_two(std::vector<Millis>(6, 2000));  // 6 of 8
  expect_copy_after(3000);
}

TEST_F(Stragglers, AreLeftAloneWhenLessIsDone) {
  leave_two(std::vector<Millis>(5, 2000));  // 5 of 7
  expect_no_copy();
}

TEST_F(Stragglers, AreLeftAloneBeforeFiveDurationsAreKnown) {
  h.send(own_b, ready02("gen"));
  submit_jobs("c", 5);
  for (int i = 0; i < 4; ++i) finish_on_b(2000);
  h.send(own_a, ready02("gen"));
  expect_no_copy();
}

TEST_F(Stragglers, AreRunTwiceOnceFiveDurationsAreKnown) {
  h.send(own_b, ready02("gen"));
  submit_jobs("c", 6);
  for (int i = 0; i < 5; ++i) finish_on_b(2000);
  h.send(own_c, ready02("gen"));
  expect_copy_after(3000);
}

TEST_F(Stragglers, AreOfAClientWhoseOtherJobsAreDone) {
  h.send(own_b, ready02("gen"));
  submit_jobs("c", 8);
  for (int i = 0; i < 8; ++i) finish_on_b(2000);
  submit_jobs("d", 1);
  h.send(own_c, ready02("gen"));
  expect_no_copy();
}

TEST_F(Stragglers, AreMeasuredByTheLastThirtyOneDurations) {
  h.send(own_b, ready02("gen"));
  submit_jobs("c", 50);
  for (int i = 0; i < 33; ++i) finish_on_b(50'000);
  for (int i = 0; i < 16; ++i) finish_on_b(4000);  // the longer half of 31 is gone
  h.send(own_c, ready02("gen"));
  expect_copy_after(6000);
}

}  // namespace
}  // namespace ssphh::majordomo::test
