/// An animation that repeats: what its poses' rays met is kept.

#include <gtest/gtest.h>

#include <ssphh/transport/surface_gather.h>

#include "count_allocations.h"
#include "game_rooms.h"

namespace ssphh::test {
namespace {

using transport::RelightParams;
using transport::RelightReport;
using transport::RelightSession;

constexpr int period = 6;

RelightParams params_with(std::size_t kept_bytes, int records = 64) {
  RelightParams params = small_params();
  params.records.points = records;
  params.records.rays = 32;
  params.kept_pose_bytes = kept_bytes;
  return params;
}

/// The door of frame i; lamps move on, so that light never repeats.
scene::LightingState state_of(const scene::LightingState& start, int i) {
  scene::LightingState state = start;
  play({.lamp_moves = true}, i, start, state);
  state.time = 0.2f + 0.1f * static_cast<float>(i % period);
  return state;
}

void expect_same(const RelightSession& a, const RelightSession& b) {
  EXPECT_TRUE(a.reflected() == b.reflected());
  EXPECT_TRUE(a.patch_direct() == b.patch_direct());
  EXPECT_TRUE(a.record_light() == b.record_light());
  EXPECT_TRUE(a.network().sample_used() == b.network().sample_used());
  EXPECT_TRUE(a.network().seen() == b.network().seen());
  EXPECT_TRUE(a.network().seen_distance() == b.network().seen_distance());
  EXPECT_EQ(a.network().lost_links(), b.network().lost_links());
}

TEST(KeptPoses, CastNoRayInTheSecondPeriodAndGiveTheSameBits) {
  const GameRooms rooms;
  RelightSession keeps(rooms.source, rooms.places, params_with(RelightParams().kept_pose_bytes)),
      casts(rooms.source, rooms.places, params_with(0));
  const scene::LightingState start = keeps.lighting();
  keeps.update(start), casts.update(start);
  for (int i = 0; i < 3 * period; ++i) {
    const RelightReport kept = keeps.update(state_of(start, i)), cast = casts.update(state_of(start, i));
    EXPECT_GT(cast.pose_rays, 0u);
    EXPECT_EQ(kept.pose_rays, i < period ? cast.pose_rays : 0) << "frame " << i;
    EXPECT_EQ(kept.hits_changed, cast.hits_changed);
    expect_same(keeps, casts);
  }
  EXPECT_GT(keeps.network().pose_bytes(), 0u);
  EXPECT_EQ(casts.network().pose_bytes(), 0u);
}

TEST(KeptPoses, TakeNoMoreMemoryThanAllowed) {
  const GameRooms rooms;
  RelightSession all(rooms.source, rooms.places, params_with(RelightParams().kept_pose_bytes));
  const scene::LightingState start = all.lighting();
  for (int i = 0; i < period; ++i) all.update(state_of(start, i));
  const std::size_t allowed = all.network().pose_bytes() / 2;
  RelightSession some(rooms.source, rooms.places, params_with(allowed)),
      none(rooms.source, rooms.places, params_with(64));
  int without_rays = 0;
  for (int i = 0; i < 8 * period; ++i) {
    without_rays += some.update(state_of(start, i)).pose_rays == 0;
    EXPECT_GT(none.update(state_of(start, i)).pose_rays, 0u) << "not even one fits";
    EXPECT_LE(some.network().pose_bytes(), allowed);
    expect_same(some, none);
  }
  EXPECT_GT(some.network().pose_bytes(), 0u);
  EXPECT_GT(without_rays, 2 * period)
      << "an animation of twice as many poses as there is room for meets some again";
}

TEST(KeptPoses, KnowRecordsThatCameLater) {
  const GameRooms rooms;
  RelightSession keeps(rooms.source, rooms.places, params_with(RelightParams().kept_pose_bytes, 0)),
      casts(rooms.source, rooms.places, params_with(0, 0));
  const scene::LightingState start = keeps.lighting();
  const auto play_both = [&](int from, int to) {
    for (int i = from; i < to; ++i) keeps.update(state_of(start, i)), casts.update(state_of(start, i));
  };
  play_both(0, period);
  transport::GatherParams records;
  records.points = 64, records.rays = 32;
  keeps.keep_records(records), casts.keep_records(records);
  play_both(0, 2 * period);
  EXPECT_EQ(keeps.update(state_of(start, 0)).pose_rays, 0u);
  casts.update(state_of(start, 0));
  expect_same(keeps, casts);
}

TEST(KeptPoses, AreMetInPiecesToo) {
  const GameRooms rooms;
  RelightSession keeps(rooms.source, rooms.places, params_with(RelightParams().kept_pose_bytes)),
      casts(rooms.source, rooms.places, params_with(0));
  const scene::LightingState start = keeps.lighting();
  keeps.update(start), casts.update(start);
  for (int i = 0; i < 2 * period; ++i) {
    std::uint64_t rays = 0;
    for (bool finished = false; !finished;) {
      const RelightReport report = keeps.update(state_of(start, i), {}, 0);
      rays += report.pose_rays;
      finished = report.finished;
    }
    casts.update(state_of(start, i));
    EXPECT_EQ(rays == 0, i >= period);
    expect_same(keeps, casts);
  }
}

TEST(KeptPoses, TakeTheirMemoryOnce) {
  const GameRooms rooms;
  RelightSession session(rooms.source, rooms.places, params_with(RelightParams().kept_pose_bytes));
  const scene::LightingState start = session.lighting();
  std::vector<scene::LightingState> states;
  for (int i = 0; i < 40; ++i) {
    states.push_back(state_of(start, i));
    states.back().time = 0.01f * static_cast<float>(i);
  }
  for (int i = 0; i < 20; ++i) session.update(states[i]);
  const long before = allocations();
  for (int i = 20; i < 40; ++i) session.update(states[i]);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace ssphh::test
