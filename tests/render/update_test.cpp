/// Updates of bakes through the path tracer: what they bake and what they keep, beside bakes in full.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/scene_items.h>
#include <ssphh/trace/path_tracer.h>

#include "property.h"
#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two closed rooms side by side, each with a lamp, a body and three SPHLs: probes 0 to 2 stand in the first.
scene::Scene two_closed_rooms(const vec3& body_at = {-1, -1.5f, 0.5f}, const vec3& body_color = vec3(0.7f)) {
  scene::Scene scene;
  for (const float x : {-2.5f, 2.5f}) {
    add_body(scene, "walls", scene::flipped(scene::make_box({x - 2, -2, -2}, {x + 2, 2, 2})), vec3(0.6f));
    scene::Light& lamp = scene.lights.emplace_back();
    lamp.name = x < 0 ? "lamp a" : "lamp b";
    lamp.intensity = 10;
    lamp.node = static_cast<int>(scene.nodes.size());
    scene.nodes.emplace_back().local.translation = {x, 1.5f, 0};
    for (const float z : {-1.0f, 0.0f, 1.0f}) add_sphl(scene, "SPHL", {x + 0.3f * z, 0, z});
  }
  add_body(scene, "table", scene::make_box(vec3(-0.4f), vec3(0.4f)), body_color, vec3(0),
           vec3(-2.5f, 0, 0) + body_at);
  add_body(scene, "chair", scene::make_box(vec3(-0.3f), vec3(0.3f)), vec3(0.3f), vec3(0), {3, -1.5f, 0.5f});
  scene::validate(scene);
  return scene;
}

bake::BakeParams quick_params() {
  bake::BakeParams params;
  params.face_size = 8;
  params.path.spp = 16;
  params.viz = false;
  return params;
}

probes::ProbeSet full_bake(const scene::Scene& scene, const bake::BakeParams& params = quick_params()) {
  set_log_level(LogLevel::error);
  const trace::PathTracer tracer(scene);
  bake::BakeReport report;
  probes::ProbeSet set = bake::bake(tracer, place::init_from_scene(scene, 3), params, {}, report);
  probes::Baseline& baseline = set.baseline.emplace();
  baseline.items = scene::scene_items(scene);
  baseline.trials = bake::make_trials(tracer, set);
  return set;
}

struct Updated {
  probes::ProbeSet set;
  bake::UpdatePlan plan;
};

Updated update(probes::ProbeSet set, const scene::Scene& scene, std::optional<float> tolerance,
               bake::BakeParams params = quick_params()) {
  const trace::PathTracer tracer(scene);
  bake::adopt_groups(set, tracer.light_groups());
  Updated result;
  result.plan = bake::plan_update(tracer, set, tolerance);
  params.only = result.plan.probes;
  bake::BakeReport report;
  set.generator.scene_hash = scene::light_hash(scene);
  result.set = bake::bake(tracer, std::move(set), params, {}, report);
  bake::renew_trials(result.set, result.plan);
  result.set.baseline->items = scene::scene_items(scene);
  return result;
}

TEST(UpdateOfBakes, AStrictUpdateEqualsTheFullBakeWhereTheRestIsOutOfReach) {
  const probes::ProbeSet old = full_bake(two_closed_rooms());
  for (const scene::Scene& changed :
       {two_closed_rooms({-1, -1.5f, -0.8f}), two_closed_rooms({-1, -1.5f, 0.5f}, {0.7f, 0.1f, 0.1f})}) {
    const Updated updated = update(old, changed, 0.0f);
    EXPECT_THAT(updated.plan.probes, ElementsAre(0, 1, 2)) << "no path leads to the other room";
    EXPECT_EQ(updated.set, full_bake(changed));
    EXPECT_NE(updated.set.probes[0], old.probes[0]);
  }
}

TEST(UpdateOfBakes, NothingChangedIsNothingBaked) {
  const probes::ProbeSet old = full_bake(two_closed_rooms());
  const Updated updated = update(old, two_closed_rooms(), 0.0f);
  EXPECT_THAT(updated.plan.probes, IsEmpty());
  EXPECT_EQ(updated.set, old);
}

TEST(UpdateOfBakes, WhatIsAddedAndWhatIsGoneCounts) {
  scene::Scene more = two_closed_rooms();
  add_body(more, "box", scene::make_box(vec3(-0.3f), vec3(0.3f)), vec3(0.5f), vec3(0), {2.5f, -1, -1});
  scene::validate(more);
  const probes::ProbeSet of_more = full_bake(more), of_less = full_bake(two_closed_rooms());
  const Updated added = update(of_less, more, 0.0f), removed = update(of_more, two_closed_rooms(), 0.0f);
  EXPECT_THAT(added.plan.probes, ElementsAre(3, 4, 5));
  EXPECT_EQ(added.set, of_more);
  EXPECT_THAT(removed.plan.probes, ElementsAre(3, 4, 5));
  EXPECT_EQ(removed.set, of_less);
}

TEST(UpdateOfBakes, ALampOfItsOwnGroupThatGoesTakesItsLightAlong) {
  const probes::ProbeSet old = full_bake(two_closed_rooms());
  scene::Scene dark = two_closed_rooms();
  dark.lights.erase(dark.lights.begin());
  const Updated updated = update(old, dark, 0.0f);
  ASSERT_EQ(updated.set.light_groups.size(), 1u);
  EXPECT_EQ(updated.set.light_groups[0].name, "lamp b");
  const probes::ProbeSet full = full_bake(dark);
  for (const std::uint32_t i : updated.plan.probes) EXPECT_EQ(updated.set.probes[i], full.probes[i]) << i;
  EXPECT_EQ(sh::mean(updated.set.probes[0].self), vec3(0));
  EXPECT_GT(sh::mean(updated.set.probes[3].self).x, 0);
}

TEST(UpdateOfBakes, ThreadsChangeNoBit) {
  const probes::ProbeSet old = full_bake(two_closed_rooms());
  const scene::Scene changed = two_closed_rooms({-1, -1.5f, -0.8f});
  const probes::ProbeSet many = update(old, changed, {}).set;
  set_thread_count(1);
  EXPECT_EQ(update(old, changed, {}).set, many);
  set_thread_count(0);
}

TEST(UpdateOfBakes, EdgesOfTheProbesBakedAreFoundAnew) {
  bake::BakeParams params = quick_params();
  params.viz = true;
  const probes::ProbeSet old = full_bake(two_closed_rooms(), params);
  const scene::Scene changed = two_closed_rooms({-1, -1.5f, -0.8f});
  const Updated updated = update(old, changed, 0.0f, params);
  EXPECT_EQ(updated.set, full_bake(changed, params));
  EXPECT_NE(updated.set.probes[0].edges, old.probes[0].edges);
}

/// A body is moved to anywhere in the first room.
TEST(UpdateOfBakes, ProbesAreAsBakedInFullOrAsBeforeWithinTheTolerance) {
  const probes::ProbeSet old = full_bake(two_closed_rooms());
  int kept = 0, baked = 0;
  double worst = 0;
  EXPECT_TRUE(for_all(floats(-1.5f, 1.5f), floats(-1.5f, 1.5f)).cases(12).holds([&](float y, float z) {
    const scene::Scene changed = two_closed_rooms({-1.2f, y, z});
    const Updated updated = update(old, changed, 0.03f);
    const probes::ProbeSet full = full_bake(changed);
    bool right = true;
    for (std::size_t i = 0; i < old.probes.size(); ++i) {
      const auto& is = updated.set.probes[i];
      const bool again = std::ranges::count(updated.plan.probes, static_cast<std::uint32_t>(i)) > 0;
      right = right && is == (again ? full : old).probes[i];
      (again ? baked : kept) += 1;
      const double level = double(luminance(sh::mean(full.probes[i].self)));
      worst = std::max(worst, std::abs(double(luminance(sh::mean(is.self))) / level - 1));
    }
    return right;
  }));
  EXPECT_GE(kept, 36) << "the second room's at least";
  EXPECT_GE(baked, 12);
  // The tolerance, and as much again for the noise of 768 paths of a trial and 6144 of the bake.
  EXPECT_LT(worst, 0.06);
}

TEST(UpdateOfEdges, ByLinksHaveTheBitsOfABakeInFull) {
  set_log_level(LogLevel::error);
  const scene::Scene before = two_closed_rooms(), now = two_closed_rooms({-1, -1.5f, -0.8f});
  bake::TransportBakeParams params;
  params.transport = small_network();
  params.viz = true;
  bake::TransportBakeReport report;
  const auto with_edges = [&](const scene::Scene& scene) {
    probes::ProbeSet set = place::init_from_scene(scene, 2);
    bake::add_transport(trace::TransportScene(scene), set, params, report);
    return set;
  };
  const probes::ProbeSet old = with_edges(before), full = with_edges(now);
  probes::ProbeSet set = old;
  bake::add_transport(trace::TransportScene(now), set, params, report, {},
                      {.light = {}, .edges = std::vector<std::uint32_t>{0, 2}});
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(set.probes[i].edges, full.probes[i].edges) << i;
    EXPECT_NE(set.probes[i].edges, old.probes[i].edges) << i;
  }
  for (const std::size_t i : {1, 3, 4, 5}) EXPECT_EQ(set.probes[i].edges, old.probes[i].edges) << i;
}

/// Everything that transport gives, of the two closed rooms.
bake::TransportBakeParams quick_transport() {
  set_log_level(LogLevel::error);
  bake::TransportBakeParams params;
  params.transport = small_network();
  params.viz = true;
  params.records.points = 400;
  params.records.rays = 64;
  return params;
}

std::vector<vec3> record_places(const probes::ProbeSet& set) {
  std::vector<vec3> places;
  for (const rays::SurfacePoint& point : set.surface->points) places.push_back(point.position);
  return places;
}

probes::ProbeSet with_records(const scene::Scene& scene) {
  probes::ProbeSet set = full_bake(scene);
  bake::TransportBakeReport report;
  bake::add_transport(trace::TransportScene(scene), set, quick_transport(), report);
  return set;
}

TEST(UpdateOfRecords, AsAWholeHasTheBitsOfABakeInFull) {
  const scene::Scene now = two_closed_rooms({-1, -1.5f, -0.8f});
  const probes::ProbeSet old = with_records(two_closed_rooms()), full = with_records(now);
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  bake::add_transport(trace::TransportScene(now), set, quick_transport(), report, {},
                      {.light = {}, .edges = std::vector<std::uint32_t>{}});
  EXPECT_EQ(record_places(set), record_places(full));
  EXPECT_EQ(set.surface->groups, full.surface->groups);
  EXPECT_NE(set.surface->groups, old.surface->groups);
  EXPECT_EQ(report.viz_seconds, 0);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(set.probes[i], old.probes[i]) << i;
}

TEST(UpdateOfRecords, OfSomeProbesKeepsThoseOfTheOthers) {
  const scene::Scene now = two_closed_rooms({-1, -1.5f, -0.8f});
  const probes::ProbeSet old = with_records(two_closed_rooms()), full = with_records(now);
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  bake::add_transport(
      trace::TransportScene(now), set, quick_transport(), report, {},
      {.light = {.probes = {{0, 1, 2}}, .groups = {}}, .edges = std::vector<std::uint32_t>{}});
  // The first room's are those of the full bake, the other's those of before; x = 0 parts the rooms.
  const auto of_room = [](const probes::ProbeSet& of, bool first) {
    std::vector<std::pair<float, probes::PackedRecordLight>> records;
    for (std::size_t p = 0; p < of.surface->points.size(); ++p) {
      if ((of.surface->points[p].position.x < 0) == first)
        records.emplace_back(of.surface->points[p].position.x, of.surface->groups[0][p]);
    }
    return records;
  };
  EXPECT_EQ(of_room(set, false), of_room(old, false));
  EXPECT_EQ(of_room(set, true), of_room(full, true));
  EXPECT_NE(of_room(set, true), of_room(old, true));
  EXPECT_GT(of_room(set, false).size(), 20u);
}

TEST(UpdateOfRecords, OfSomeLampsKeepsPlacesAndTheOtherLamps) {
  const probes::ProbeSet old = with_records(two_closed_rooms());
  scene::Scene now = two_closed_rooms();
  for (scene::Light& lamp : now.lights) lamp.intensity *= 2;
  ASSERT_EQ(old.light_groups[0].name, "lamp a");
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  bake::add_transport(trace::TransportScene(now), set, quick_transport(), report, {},
                      {.light = {.probes = {}, .groups = {{0}}}, .edges = std::vector<std::uint32_t>{}});
  EXPECT_EQ(record_places(set), record_places(old));
  EXPECT_EQ(set.surface->groups[1], old.surface->groups[1]);
  // Twice the light, gathered by other rays: of 64 rays a record errs by some 5 %, a sum of a hundred by 1 %.
  const auto sum = [](const probes::ProbeSet& of) {
    glm::dvec3 all(0);
    for (std::size_t p = 0; p < of.surface->points.size(); ++p)
      all += glm::dvec3(probes::unpack(of.surface->groups[0][p], of.surface->points[p].normal)[3]);
    return all;
  };
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(sum(set)[c] / sum(old)[c], 2, 0.05) << c;
}

TEST(UpdateOfRecords, OfAllLampsByNameLeavesNoRecordAsItWas) {
  const probes::ProbeSet old = with_records(two_closed_rooms());
  scene::Scene now = two_closed_rooms();
  for (scene::Light& lamp : now.lights) lamp.intensity *= 2;
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  bake::add_transport(trace::TransportScene(now), set, quick_transport(), report, {},
                      {.light = {.probes = {}, .groups = {{0, 1}}}, .edges = std::vector<std::uint32_t>{}});
  for (std::size_t p = 0; p < set.surface->points.size(); ++p) {
    const auto is_old = [&](std::size_t g) { return set.surface->groups[g][p] == old.surface->groups[g][p]; };
    EXPECT_FALSE(is_old(0) && is_old(1)) << p;
  }
}

class UpdateOfTransport : public testing::TestWithParam<probes::LightOperator> {
 protected:
  static bake::TransportBakeParams params() {
    bake::TransportBakeParams params = quick_transport();
    params.op = GetParam();
    return params;
  }
  static probes::ProbeSet full(const scene::Scene& scene) {
    bake::TransportBakeReport report;
    return bake::bake_transport(trace::TransportScene(scene), place::init_from_scene(scene, 3), params(),
                                report);
  }
};

TEST_P(UpdateOfTransport, HasTheBitsOfABakeInFull) {
  const scene::Scene now = two_closed_rooms({-1, -1.5f, -0.8f});
  const probes::ProbeSet old = full(two_closed_rooms()), wanted = full(now);
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  const bake::TransportUpdate update =
      bake::update_transport(trace::TransportScene(now), set, params(), {}, -1, report);
  set.generator.scene_hash = wanted.generator.scene_hash;
  EXPECT_EQ(set, wanted);
  EXPECT_THAT(update.probes, testing::SizeIs(6)) << "surfels of both rooms are numbered together";
}

TEST_P(UpdateOfTransport, KeepsWhatIsOutOfScopeAndEdgesToWhatHasHardlyChanged) {
  const scene::Scene now = two_closed_rooms({-1, -1.5f, -0.8f});
  const probes::ProbeSet old = full(two_closed_rooms()), wanted = full(now);
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  const bake::TransportUpdate update = bake::update_transport(trace::TransportScene(now), set, params(),
                                                              {.probes = {{0, 2}}, .groups = {}}, 0, report);
  EXPECT_THAT(update.probes, ElementsAre(0, 2));
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(set.probes[i], wanted.probes[i]) << i;
    EXPECT_GT(update.changed[i], 0) << i;
  }
  for (const std::size_t i : {1, 3, 4, 5}) {
    EXPECT_EQ(set.probes[i], old.probes[i]) << i;
    EXPECT_EQ(update.changed[i], 0) << i;
  }

  set = old;
  bake::update_transport(trace::TransportScene(now), set, params(), {}, 1, report);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(set.probes[i].groups, wanted.probes[i].groups) << i;
    EXPECT_EQ(set.probes[i].edges, old.probes[i].edges) << i;
  }
  EXPECT_EQ(report.viz_seconds, 0);
}

TEST_P(UpdateOfTransport, OfSomeLampsKeepsTheLightOfTheOthers) {
  const probes::ProbeSet old = full(two_closed_rooms());
  scene::Scene now = two_closed_rooms();
  for (scene::Light& lamp : now.lights) lamp.intensity *= 2;
  probes::ProbeSet set = old;
  bake::TransportBakeReport report;
  bake::update_transport(trace::TransportScene(now), set, params(), {.probes = {}, .groups = {{1}}}, 0,
                         report);
  const probes::ProbeSet wanted = full(now);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(set.probes[i].groups[0], old.probes[i].groups[0]) << i;
    EXPECT_EQ(set.probes[i].groups[1], wanted.probes[i].groups[1]) << i;
  }
  EXPECT_NE(wanted.probes[4].groups[1], old.probes[4].groups[1]);
}

INSTANTIATE_TEST_SUITE_P(Operators, UpdateOfTransport,
                         testing::Values(probes::LightOperator::surfel, probes::LightOperator::bounce),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace ssphh::test
