/// Updates that stop when their time is over and go on.

#include <gmock/gmock.h>

#include <ssphh/transport/surface_gather.h>

#include "error_message.h"
#include "game_rooms.h"

namespace ssphh::test {
namespace {

using transport::RelightReport;
using transport::RelightSession;

struct Kind {
  const char* name;
  probes::LightOperator op;
  int poses, records;
  bool warm;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

class Budget : public testing::TestWithParam<Kind> {
 protected:
  RelightSession session() const {
    transport::RelightParams params = small_params(GetParam().op);
    params.poses = GetParam().poses;
    params.records.points = GetParam().records;
    params.records.rays = 32;
    params.warm_start = GetParam().warm;
    return {rooms_.source, rooms_.places, params};
  }
  scene::LightingState state_of(int i) const {
    const scene::LightingState start = rays::lighting_at(rooms_.source);
    scene::LightingState state = start;
    play({true, true, true, true}, 7 * i, start, state);
    return state;
  }
  static void expect_same(const RelightSession& a, const RelightSession& b) {
    EXPECT_TRUE(a.reflected() == b.reflected());
    EXPECT_TRUE(a.patch_direct() == b.patch_direct());
    EXPECT_TRUE(a.surfel_irradiance() == b.surfel_irradiance());
    EXPECT_TRUE(a.record_light() == b.record_light());
    EXPECT_TRUE(a.shown() == b.shown());
  }
  /// Updates without time until all is done; returns the calls.
  static int catch_up(RelightSession& session, const scene::LightingState& state) {
    int calls = 1;
    for (RelightReport report = session.update(state, {}, 0); !report.finished; ++calls)
      report = session.update(state, {}, 0);
    return calls;
  }

  const GameRooms rooms_{};
};

TEST_P(Budget, PiecesEndWithTheBitsOfTheWhole) {
  RelightSession whole = session(), pieces = session();
  for (int i = 0; i < 4; ++i) {
    const scene::LightingState state = state_of(i);
    whole.update(state);
    EXPECT_GT(catch_up(pieces, state), 3);
    expect_same(pieces, whole);
    EXPECT_EQ(pieces.age().updates, 0u);
    EXPECT_EQ(pieces.age().seconds, 0);
    EXPECT_FALSE(pieces.under_way());
  }
}

// A call brings another state each time: those that were begun are finished and shown, in their order.
TEST_P(Budget, StatesThatWereBegunAreShownInTurn) {
  RelightSession pieces = session(), whole = session();
  std::vector<scene::LightingState> given, shown;
  for (int i = 0; i < 3000 && shown.size() < 4; ++i) {
    given.push_back(state_of(i));
    const RelightReport report = pieces.update(given.back(), {}, 0);
    EXPECT_FALSE(report.finished) << "there is always a newer one";
    if (pieces.reflected().empty()) {
      EXPECT_EQ(report.age.updates, given.size());
      continue;
    }
    const auto of_shown = given.size() - 1 - report.age.updates;
    ASSERT_LT(of_shown, given.size());
    EXPECT_TRUE(pieces.shown() == given[of_shown]) << "the age says which call brought what is shown";
    if (shown.empty() || !(shown.back() == pieces.shown())) {
      shown.push_back(pieces.shown());
      whole.update(shown.back());
      EXPECT_TRUE(pieces.reflected() == whole.reflected()) << shown.size();
      EXPECT_FALSE(report.changed_probes.empty());
    } else {
      EXPECT_TRUE(pieces.reflected() == whole.reflected()) << "what is finished stays whole";
      EXPECT_TRUE(report.changed_probes.empty());
    }
    EXPECT_TRUE(pieces.lighting() == given.back());
  }
  ASSERT_EQ(shown.size(), 4u);
  // Time enough: what is under way is finished, then the newest.
  const RelightReport report = pieces.update(state_of(5000));
  EXPECT_TRUE(report.finished);
  EXPECT_EQ(report.age.updates, 0u);
  EXPECT_TRUE(pieces.shown() == state_of(5000));
}

TEST_P(Budget, WhatIsCancelledBetweenPiecesIsDoneByTheNext) {
  RelightSession pieces = session(), whole = session();
  pieces.update(state_of(0)), whole.update(state_of(0));
  const std::vector<sh::RadianceSh> before = pieces.reflected();
  pieces.update(state_of(1), {}, 0);
  pieces.update(state_of(1), {}, 0);
  CancelToken cancel;
  cancel.request();
  EXPECT_THROW(pieces.update(state_of(1), {nullptr, &cancel}, 0), Cancelled);
  EXPECT_TRUE(pieces.reflected() == before);
  EXPECT_FALSE(pieces.under_way());
  catch_up(pieces, state_of(2));
  whole.update(state_of(2));
  expect_same(pieces, whole);
}

TEST_P(Budget, ASessionIsMovedInTheMiddle) {
  RelightSession pieces = session(), whole = session();
  pieces.update(state_of(0)), whole.update(state_of(0));
  pieces.update(state_of(1), {}, 0);
  pieces.update(state_of(1), {}, 0);
  RelightSession moved = std::move(pieces);
  EXPECT_THROW(pieces.update(state_of(1)), Error);
  EXPECT_THROW(pieces.age(), Error);
  EXPECT_THROW(pieces.under_way(), Error);
  EXPECT_TRUE(moved.under_way());
  catch_up(moved, state_of(1));
  whole.update(state_of(1));
  expect_same(moved, whole);
  pieces = std::move(moved);
  catch_up(pieces, state_of(2));
  whole.update(state_of(2));
  expect_same(pieces, whole);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Budget,
    testing::Values(Kind{"Surfels", probes::LightOperator::surfel, 0, 0, true},
                    Kind{"SurfelsFromDarkness", probes::LightOperator::surfel, 0, 0, false},
                    Kind{"Poses", probes::LightOperator::surfel, 4, 0, true},
                    Kind{"Records", probes::LightOperator::surfel, 0, 64, true},
                    Kind{"Bounce", probes::LightOperator::bounce, 0, 0, true},
                    Kind{"BounceWithRecords", probes::LightOperator::bounce, 0, 64, true}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(Budget, TellsWhatItCannotDoOnTheWay) {
  const GameRooms rooms;
  RelightSession session(rooms.source, rooms.places, small_params());
  EXPECT_THROW(session.update(session.lighting(), {}, -1), Error);
  EXPECT_THROW(session.update(session.lighting(), {}, NAN), Error);
  session.update(session.lighting());
  scene::LightingState state = session.lighting();
  state.time = 0.5f;
  ASSERT_FALSE(session.update(state, {}, 0).finished);
  const auto refused = [&](const auto& call) {
    EXPECT_THAT(message_of(call), testing::HasSubstr("an update is under way"));
  };
  refused([&] { session.emitted(0); });
  refused([&] { session.arriving(0, 0); });
  refused([&] { session.emitted_by_group(); });
  refused([&] { session.direct_by_group(); });
  refused([&] { session.reflected_by_group(); });
  refused([&] { session.emission_profile(vec3(0), 0.1f, 1); });
  refused([&] { session.keep_records({.points = 8}); });
  refused([&] { session.keep_records_at({}, {.points = 0}); });
  EXPECT_TRUE(session.update(state).finished);
  session.emitted(0);
}

TEST(Budget, OfNothingToDoIsFinished) {
  const GameRooms rooms;
  RelightSession session(rooms.source, rooms.places, small_params());
  session.update(session.lighting());
  const RelightReport idle = session.update(session.lighting(), {}, 0);
  EXPECT_TRUE(idle.finished);
  EXPECT_EQ(idle.age.updates, 0u);
  EXPECT_TRUE(idle.changed_probes.empty());
}

}  // namespace
}  // namespace ssphh::test
