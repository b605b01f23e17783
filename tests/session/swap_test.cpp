/// Lookups whose light changes: the bits of lookups made anew; what they are not given for is refused.

#include <gmock/gmock.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/surface_gather.h>

#include "error_message.h"
#include "game_rooms.h"

namespace ssphh::test {
namespace {

using probes::IrradianceLookup;
using probes::LightLookup;

static_assert(std::is_nothrow_move_constructible_v<transport::RelightSession> &&
              std::is_nothrow_move_assignable_v<transport::RelightSession> &&
              !std::is_copy_constructible_v<transport::RelightSession>);
static_assert(std::is_nothrow_move_constructible_v<IrradianceLookup> &&
              std::is_nothrow_move_assignable_v<IrradianceLookup> &&
              std::is_copy_constructible_v<IrradianceLookup>);
static_assert(std::is_nothrow_move_constructible_v<LightLookup> &&
              std::is_nothrow_move_assignable_v<LightLookup> && std::is_copy_constructible_v<LightLookup>);

/// Points of both rooms, some on things that move.
std::vector<rays::SurfacePoint> points(const GameRooms& rooms) {
  std::vector<rays::SurfacePoint> found;
  for (int part = 0; part < rooms.source.part_count(); ++part) {
    for (const rays::PartPoint& p : rooms.source.sample_part(part, 2)) {
      found.push_back(p.point);
      found.back().moves = part > 0;
    }
  }
  return found;
}

template <class Lookup>
void expect_same(const Lookup& a, const Lookup& b, const GameRooms& rooms) {
  for (const rays::SurfacePoint& p : points(rooms)) {
    EXPECT_EQ(a.irradiance(p), b.irradiance(p));
    EXPECT_EQ(a.glossy(p, p.normal, 0.4f), b.glossy(p, p.normal, 0.4f));
  }
  EXPECT_EQ(a.direct_groups(), b.direct_groups());
  EXPECT_EQ(a.mirrored_groups(), b.mirrored_groups());
}

template <class Lookup>
class SwappedLight : public testing::Test {};
using Lookups = testing::Types<IrradianceLookup, LightLookup>;
TYPED_TEST_SUITE(SwappedLight, Lookups);

TYPED_TEST(SwappedLight, HasTheBitsOfALookupMadeAnew) {
  const GameRooms rooms;
  const trace::PathTracer eye(rooms.scene);
  for (const int records : {0, 64}) {
    for (const bool baked : {false, true}) {
      if (baked && records == 0) continue;
      transport::RelightParams params = small_params();
      params.records.points = records;
      params.records.rays = 32;
      if (baked) params.records.baked = {0};
      transport::RelightSession session(rooms.source, rooms.places, params);
      const scene::LightingState start = session.lighting();
      scene::LightingState state = start;
      session.update(state);
      probes::ProbeSet set = transport::lookup_set(session);
      TypeParam lookup(set, eye);
      const TypeParam first(set, eye);
      TypeParam copy(lookup);
      for (int i = 1; i < 4; ++i) {
        // Factors alone at first, so that direct light that is kept holds; then it does not.
        play({.lamp_moves = i > 1, .group_dims = true, .door_moves = i > 2}, 3 * i, start, state);
        session.update(state);
        transport::refresh(set, session);
        lookup.swap_light(set);
        expect_same(lookup, TypeParam(set, eye), rooms);
        expect_same(copy, first, rooms);  // copies have light of their own
      }
      copy.swap_light(set);
      expect_same(copy, lookup, rooms);
      TypeParam moved = std::move(lookup);
      expect_same(copy, moved, rooms);
      EXPECT_THROW(lookup.irradiance({}), Error);
      EXPECT_THROW(lookup.swap_light(set), Error);
      EXPECT_THROW(TypeParam{lookup}, Error);
    }
  }
}

TYPED_TEST(SwappedLight, OfOtherProbesIsRefused) {
  const GameRooms rooms;
  const trace::PathTracer eye(rooms.scene);
  transport::RelightSession session(rooms.source, rooms.places, small_params());
  session.update(session.lighting());
  const probes::ProbeSet set = transport::lookup_set(session);
  TypeParam lookup(set, eye);
  const TypeParam first(set, eye);
  const auto refuses = [&](const auto& spoil, const std::string& word) {
    probes::ProbeSet other = set;
    spoil(other);
    EXPECT_THAT(message_of([&] { lookup.swap_light(other); }), testing::HasSubstr(word));
  };
  refuses([](auto& s) { s.probes.pop_back(); }, "other probes");
  refuses([](auto& s) { std::swap(s.probes[0], s.probes[1]); }, "other probes");
  refuses([](auto& s) { s.degree = 2; }, "other probes");
  refuses([](auto& s) { s.probes.back().reflected[1].y = NAN; }, "not finite");
  refuses([](auto& s) { s.probes.back().reflected = {}; }, "merge_groups");
  expect_same(lookup, first, rooms);
}

TEST(SwappedLight, OfOtherRecordsIsRefused) {
  const GameRooms rooms;
  const trace::PathTracer eye(rooms.scene);
  transport::RelightParams params = small_params();
  params.records = {.points = 64, .rays = 32};
  transport::RelightSession session(rooms.source, rooms.places, params);
  session.update(session.lighting());
  const probes::ProbeSet set = transport::lookup_set(session);
  IrradianceLookup lookup(set, eye);
  probes::ProbeSet without = set, fewer = set, unmerged = set;
  without.surface.reset();
  fewer.surface->points.pop_back();
  unmerged.surface->light.clear();
  EXPECT_THAT(message_of([&] { lookup.swap_light(without); }), testing::HasSubstr("other records"));
  EXPECT_THAT(message_of([&] { lookup.swap_light(fewer); }), testing::HasSubstr("other records"));
  EXPECT_THAT(message_of([&] { lookup.swap_light(unmerged); }), testing::HasSubstr("merge_groups"));
  expect_same(lookup, IrradianceLookup(set, eye), rooms);
}

}  // namespace
}  // namespace ssphh::test
