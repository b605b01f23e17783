/// Things to be done at a time: in what order, and what may change while they are done.

#include <gtest/gtest.h>

#include "timers.h"

namespace ssphh::majordomo::test {
namespace {

struct TimerQueue : testing::Test {
  Timers::Task note(const std::string& name) {
    return [this, name](Millis now) { done += name + "@" + std::to_string(now) + " "; };
  }
  Timers timers;
  std::string done;
};

TEST_F(TimerQueue, RunsWhatIsDueByTimeAndThenByTheOrderOfSetting) {
  EXPECT_EQ(timers.next(), Timers::never);
  timers.set(20, note("c"));
  timers.set(10, note("a"));
  timers.set(20, note("d"));
  timers.set(10, note("b"));
  timers.set(21, note("e"));
  EXPECT_EQ(timers.next(), 10);
  timers.run(9);
  EXPECT_EQ(done, "");
  timers.run(20);
  EXPECT_EQ(done, "a@20 b@20 c@20 d@20 ");
  EXPECT_EQ(timers.next(), 21);
}

TEST_F(TimerQueue, WhatATaskSetsWaitsForTheNextRunAndLaterOnesStayLater) {
  timers.set(5, [this](Millis) {
    done += "a ";
    timers.set(5, note("b"));
    timers.set(10, note("c"));
  });
  timers.set(10, note("d"));
  timers.set(20, note("e"));
  timers.run(10);
  EXPECT_EQ(done, "a d@10 ");
  EXPECT_EQ(timers.next(), 5);
  timers.run(10);
  EXPECT_EQ(done, "a d@10 b@10 c@10 ");
  EXPECT_EQ(timers.next(), 20);
}

TEST_F(TimerQueue, ForgetsWhatIsCancelledAlsoByATask) {
  Timers::Handle none, first = timers.set(10, note("a")), second = timers.set(10, note("b"));
  Timers::Handle third = timers.set(5, [&](Millis) { timers.cancel(second); });
  timers.cancel(none);
  timers.cancel(first);
  EXPECT_EQ(first.serial, 0u);
  EXPECT_EQ(first.when, Timers::never);
  timers.cancel(first);
  timers.set(10, note("c"));
  timers.run(10);
  EXPECT_EQ(done, "c@10 ");
  timers.cancel(third);
  EXPECT_EQ(timers.next(), Timers::never);
}

}  // namespace
}  // namespace ssphh::majordomo::test
