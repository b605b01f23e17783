/// A game's thread that reads light while a worker updates it, and sessions on job systems of the caller: run
/// these under ThreadSanitizer, too (scripts/check-threads session).

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/snapshots.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>

#include "game_rooms.h"
#include "toy_executor.h"

namespace ssphh::test {
namespace {

using probes::IrradianceLookup;

TEST(GameThreads, ReadFinishedLightWhileAWorkerUpdates) {
  const GameRooms rooms;
  const trace::PathTracer eye(rooms.scene);
  transport::RelightParams params = small_params();
  params.records = {.points = 64, .rays = 32};
  transport::RelightSession session(rooms.source, rooms.places, params);
  const scene::LightingState start = session.lighting();
  session.update(start);
  probes::ProbeSet set = transport::lookup_set(session);
  Snapshots<IrradianceLookup> light{IrradianceLookup(set, eye)};
  Snapshots<scene::LightingState> wanted{start};
  // What surfaces must see of the n-th light, by the worker's own lookup.
  const rays::SurfacePoint at{rooms.places[0].position, {0, 1, 0}};
  constexpr int published = 12;
  std::vector<vec3> expected{light.read()->irradiance(at)};
  expected.reserve(published + 1);
  std::atomic<bool> done = false;

  std::thread worker([&] {
    IrradianceLookup own(set, eye);
    scene::LightingState state;
    while (expected.size() <= published) {
      state = *wanted.read();
      const bool finished = session.update(state, {}, 0.2).finished;
      if (!finished && session.under_way() && session.shown() == start) continue;
      transport::refresh(set, session);
      own.swap_light(set);
      expected.push_back(own.irradiance(at));
      EXPECT_TRUE(light.publish([&](IrradianceLookup& next) { next.swap_light(set); }));
    }
    done = true;
  });
  std::vector<std::pair<std::uint64_t, vec3>> seen;
  scene::LightingState state = start;
  for (int frame = 0; !done; ++frame) {
    play({true, true, true, true}, frame, start, state);
    wanted.publish([&](scene::LightingState& next) { next = state; });
    const auto now = light.read();
    const vec3 e = now->irradiance(at);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(now->irradiance(at), e) << "it stays while it is read";
    seen.emplace_back(now.version(), e);
  }
  worker.join();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].second, expected[seen[i].first]) << "light is finished light";
    EXPECT_GE(seen[i].first, seen[i == 0 ? 0 : i - 1].first);
  }
  EXPECT_EQ(light.read().version(), static_cast<std::uint64_t>(published));
}

/// All that a session finds in a few updates.
std::vector<std::vector<sh::RadianceSh>> light_of_updates(probes::LightOperator op) {
  const GameRooms rooms;
  transport::RelightParams params = small_params(op);
  params.transport.directions = 48;
  transport::RelightSession session(rooms.source, rooms.places, params);
  const scene::LightingState start = session.lighting();
  scene::LightingState state = start;
  std::vector<std::vector<sh::RadianceSh>> light;
  for (int i = 0; i < 3; ++i) {
    play({true, true, true, true}, 5 * i, start, state);
    session.update(state);
    light.push_back(session.reflected());
    light.push_back({session.emitted(0)});
  }
  return light;
}

TEST(GameThreads, SameBitsOnAnyExecutor) {
  for (const auto op : {probes::LightOperator::surfel, probes::LightOperator::bounce}) {
    const auto expected = light_of_updates(op);
    for (const int threads : {1, 3}) {
      ToyExecutor pool(threads);
      const OnExecutor on(pool);
      EXPECT_TRUE(light_of_updates(op) == expected) << threads;
      EXPECT_EQ(pool.started() > 0, threads > 1);
    }
  }
}

// Two sessions on one scene, each on a thread of its own: what they share are the source and the job system.
TEST(GameThreads, SessionsUpdateBesideEachOther) {
  const GameRooms rooms;
  const auto run = [&] {
    transport::RelightSession session(rooms.source, rooms.places, small_params());
    const scene::LightingState start = session.lighting();
    scene::LightingState state = start;
    for (int i = 0; i < 4; ++i) {
      play({true, true, true, true}, 3 * i, start, state);
      session.update(state);
    }
    return session.reflected();
  };
  std::vector<sh::RadianceSh> one, two;
  std::thread first([&] { one = run(); }), second([&] { two = run(); });
  first.join(), second.join();
  EXPECT_TRUE(one == two);
  EXPECT_TRUE(one == run());
}

}  // namespace
}  // namespace ssphh::test
