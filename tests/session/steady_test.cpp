/// What an update allocates once a session has seen its kind: nothing.

#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>

#include "count_allocations.h"
#include "game_rooms.h"

namespace ssphh::test {
namespace {

struct Case {
  const char* name;
  Play play;
  probes::LightOperator op = probes::LightOperator::surfel;
  int poses = 0, records = 0;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class SteadyUpdate : public testing::TestWithParam<Case> {};

TEST_P(SteadyUpdate, AllocatesNothing) {
  const GameRooms rooms;
  transport::RelightParams params = small_params(GetParam().op);
  params.poses = GetParam().poses;
  params.records.points = GetParam().records;
  params.records.rays = 32;
  transport::RelightSession session(rooms.source, rooms.places, params);
  const scene::LightingState start = session.lighting();
  scene::LightingState state = start;
  session.update(state);
  probes::ProbeSet set = transport::lookup_set(session);
  const trace::PathTracer eye(rooms.scene);
  probes::IrradianceLookup lookup(set, eye);
  const auto frame = [&](int i) {
    play(GetParam().play, i, start, state);
    const transport::RelightReport report = session.update(state);
    transport::refresh(set, session);
    lookup.swap_light(set);
    return report.changed_probes.size();
  };
  constexpr int warm_up = 20, frames = 20;
  for (int i = 1; i < warm_up; ++i) frame(i);
  std::size_t changed = 0;
  const long before = allocations();
  for (int i = warm_up; i < warm_up + frames; ++i) changed += frame(i);
  EXPECT_EQ(allocations() - before, 0);
  const Play& p = GetParam().play;
  EXPECT_EQ(changed > 0, p.lamp_moves || p.lamp_dims || p.group_dims || p.door_moves)
      << "what was played shows";
}

INSTANTIATE_TEST_SUITE_P(
    Of, SteadyUpdate,
    testing::Values(
        Case{"Idle", {}}, Case{"LampMove", {.lamp_moves = true}}, Case{"LampDim", {.lamp_dims = true}},
        Case{"GroupDim", {.group_dims = true}}, Case{"DoorMove", {.door_moves = true}},
        Case{"All", {true, true, true, true}},
        Case{"DoorBetweenPoses", {.door_moves = true}, probes::LightOperator::surfel, 5},
        Case{"AllWithRecords", {true, true, true, true}, probes::LightOperator::surfel, 0, 64},
        Case{"LampMoveByBounce", {.lamp_moves = true, .group_dims = true}, probes::LightOperator::bounce}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(SteadyUpdate, OfABudgetAllocatesNothing) {
  const GameRooms rooms;
  transport::RelightSession session(rooms.source, rooms.places, small_params());
  const scene::LightingState start = session.lighting();
  scene::LightingState state = start;
  session.update(state);
  const auto frame = [&](int i) {
    play({true, true, true, true}, i, start, state);
    return !session.update(state, {}, 0).changed_probes.empty();
  };
  constexpr int frames = 1500;
  int shown = 0;
  for (int i = 1; i < frames; ++i) frame(i);
  const long before = allocations();
  for (int i = frames; i < 2 * frames; ++i) shown += frame(i);
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(shown, 2);
}

}  // namespace
}  // namespace ssphh::test
