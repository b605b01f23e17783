/// What places on a surface have a say.

#include "surface_samples.h"

#include <gtest/gtest.h>

namespace ssphh::probes {
namespace {

/// Whether a place has a say that sees a point `away` metres from it, of that spacing, while another, at its
/// very side and a metre apart from its neighbours, is hidden.
bool alive_by(float away, float spacing = 1) {
  SurfaceSamples samples;
  samples.add({0, 0, 0}, {0, 1, 0}, {0.5f, 0.5f, 0.5f});
  for (const auto& [x, seen] : {std::pair(0.0f, false), {away, true}}) {
    const rays::SurfacePoint point{{x, 0, 0}, {0, 1, 0}};
    const float apart = seen ? spacing : 1;
    samples.judge(point, apart);
    EXPECT_NE(samples.verdict(0), SurfaceSamples::out_of_reach) << x;
    samples.weigh(point, apart, 0);
    samples.count_in(0, 0, apart, seen, true);
  }
  EXPECT_FALSE(samples.alive(0, 1)) << "nothing faces the other side's way";
  return samples.alive(0, 0);
}

TEST(SurfaceSamples, WhatSeesNextToNothingOfTheLightAroundHasNoSay) {
  EXPECT_TRUE(alive_by(0.5f));
  EXPECT_TRUE(alive_by(1.9f)) << "(1 - 1.9² / 9)⁸ is 1.6 % of what is hidden";
  EXPECT_FALSE(alive_by(2.3f)) << "(1 - 2.3² / 9)⁸: under .1 %";
  EXPECT_FALSE(alive_by(2.9f));
}

TEST(SurfaceSamples, PointsMuchCoarserThanTheFinestAroundDoNotTell) {
  EXPECT_TRUE(alive_by(1, 7.9f));
  EXPECT_FALSE(alive_by(1, 8.1f));
}

}  // namespace
}  // namespace ssphh::probes
