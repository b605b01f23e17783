#include "model/exposure_follower.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ssphh::viewer {
namespace {

TEST(ExposureFollower, TakesTheFirstAndHoldsWhileLittleChanges) {
  ExposureFollower follower;
  EXPECT_EQ(follower.follow(-7.5f), -7.5f);
  for (const float suits : {-7.25f, -7.75f, -7.9f, -7.1f, -7.25f})
    EXPECT_EQ(follower.follow(suits), -7.5f) << suits;
}

TEST(ExposureFollower, GlidesFromARoomIntoTheSunWithinHalfASecond) {
  ExposureFollower follower;
  float last = follower.follow(1);
  int frames = 0;
  while (last != -7.5f && frames < 100) {
    const float next = follower.follow(-7.5f);
    EXPECT_LT(next, last);
    EXPECT_GE(next, -7.5f) << "never beyond";
    EXPECT_LT(last - next, 1.2f) << "no jump";
    last = next, ++frames;
  }
  EXPECT_EQ(last, -7.5f) << "it gets there";
  EXPECT_LE(frames, 32);
  EXPECT_GE(frames, 16);
}

TEST(ExposureFollower, HoldsByWhatItGlidesToNotByWhereItIs) {
  ExposureFollower follower;
  follower.follow(0);
  follower.follow(2);
  for (int i = 0; i < 100; ++i) follower.follow(2.25f);
  EXPECT_EQ(follower.follow(2.25f), 2);
  for (int i = 0; i < 100; ++i) follower.follow(2.5f);
  EXPECT_EQ(follower.follow(2.5f), 2.5f) << "half a stop is too much";
}

TEST(ExposureFollower, JumpsWhereItIsTold) {
  ExposureFollower follower;
  follower.follow(0);
  EXPECT_EQ(follower.take(0.25f), 0.25f);
  EXPECT_EQ(follower.follow(0.5f), 0.25f);
  follower.forget();
  EXPECT_EQ(follower.follow(5), 5);
}

}  // namespace
}  // namespace ssphh::viewer
