#include <limits>

#include <gtest/gtest.h>

#include <ssphh/farm/job_cutter.h>

namespace ssphh::farm {
namespace {

TEST(JobCutter, AimsAtTheTimeAskedFor) {
  JobCutter cutter(1.5);
  EXPECT_EQ(cutter.next(1000, 4), 1u) << "nothing is known";
  cutter.learn(1, 0.1);
  EXPECT_EQ(cutter.next(1000, 4), 15u);
  for (int i = 0; i < 50; ++i) cutter.learn(10, 0.1);
  EXPECT_NEAR(static_cast<double>(cutter.next(100'000, 4)), 150, 3);
  cutter.learn(1, 1e6);
  EXPECT_EQ(cutter.next(1000, 4), 1u) << "never none";
}

TEST(JobCutter, SharesWhatIsLeftAtTheEnd) {
  JobCutter cutter(1.5);
  cutter.learn(1, 0.001);
  EXPECT_EQ(cutter.next(80, 4), 10u) << "two jobs for each worker";
  EXPECT_EQ(cutter.next(81, 4), 11u) << "rounded up, or a unit were left over";
  EXPECT_EQ(cutter.next(3, 4), 1u);
  EXPECT_EQ(cutter.next(0, 4), 0u);
  EXPECT_EQ(cutter.next(10, 0), 5u) << "workers that are not known yet";
}

TEST(JobCutter, TheFirstJobCountsWholeAndEveryLaterOneThreeTenths) {
  JobCutter cutter(1.5);
  EXPECT_EQ(cutter.seconds_per_unit(), 0);
  cutter.learn(2, 0.4);
  EXPECT_DOUBLE_EQ(cutter.seconds_per_unit(), 0.2);
  cutter.learn(4, 3.2);
  EXPECT_DOUBLE_EQ(cutter.seconds_per_unit(), 0.7 * 0.2 + 0.3 * 0.8);
}

TEST(JobCutter, WhatIsNoTimeTeachesNothing) {
  JobCutter cutter(1.5);
  cutter.learn(1, 0.5);
  cutter.learn(0, 1);
  cutter.learn(1, -1);
  cutter.learn(1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_DOUBLE_EQ(cutter.seconds_per_unit(), 0.5);
}

TEST(JobCutter, AJobHasNoMoreThanItsMost) {
  JobCutter usual(1.5), small(1.5, 7);
  for (JobCutter* cutter : {&usual, &small})
    for (int i = 0; i < 3; ++i) cutter->learn(1000, 0);
  EXPECT_EQ(usual.next(1'000'000, 1), 1024u);
  EXPECT_EQ(small.next(1'000'000, 1), 7u);
}

}  // namespace
}  // namespace ssphh::farm
