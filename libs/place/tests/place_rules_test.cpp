/// What a placement tells of its probes and of the places that it did not take.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/place/place.h>
#include <ssphh/scene/primitives.h>

#include "draft.h"
#include "error_message.h"
#include "ray_source.h"
#include "scene_of.h"
#include "triangle_source.h"

namespace ssphh::place {
namespace {

using test::message_of;
using test::RaySource;
using test::TriangleSource;
using testing::HasSubstr;

scene::Scene room(const vec3& size) {
  return scene_of({scene::flipped(scene::make_box(vec3(0), size))});
}

PlaceParams params_at(float spacing, const std::vector<vec3>& interest = {}) {
  PlaceParams params;
  params.spacing = spacing;
  params.interest = interest;
  return params;
}

TEST(PlaceRules, ProbesTellTheirSpacingReachClearanceAndSize) {
  // A room of 4 m, in which a wall of 0.2 m leaves a way of 0.7 m.
  const TriangleSource source(scene_of({scene::flipped(scene::make_box(vec3(0), vec3(4, 2, 2))),
                                        scene::make_box({1.9f, -0.1f, -0.1f}, {2.1f, 2.1f, 0.6f}),
                                        scene::make_box({1.9f, -0.1f, 1.3f}, {2.1f, 2.1f, 2.1f})}));
  PlaceParams params = params_at(1.2f, {vec3(1)});
  params.manual = {{"mine", vec3(3, 1, 1), 0.25f}, {"yours", vec3(1, 1, 1), 0.25f}};
  std::map<PlaceKind, int> kinds;
  for (const int levels : {0, 2}) {
    params.levels = levels;
    const Placement placement = place_probes(source, params);
    EXPECT_EQ(placement.spacing, 1.2f);
    EXPECT_EQ(placement.clearance, 0.04f);
    EXPECT_EQ(placement.back_limit, 0.25f);
    int number = 0;
    for (const PlacedProbe& probe : placement.probes) {
      ++kinds[probe.kind];
      EXPECT_EQ(probe.clearance, look_around(source, probe.position).nearest);
      const bool manual = probe.kind == PlaceKind::manual, refined = probe.kind == PlaceKind::refined;
      EXPECT_EQ(probe.name,
                manual ? (probe.position.x > 2 ? "mine" : "yours") : "auto " + std::to_string(++number));
      EXPECT_EQ(probe.radius, manual ? 0.25f : std::min(0.1f * probe.spacing, 0.8f * probe.clearance));
      EXPECT_TRUE(refined ? probe.spacing == 0.6f || probe.spacing == 0.3f : probe.spacing <= 1.2f)
          << probe.spacing;
      if (probe.kind == PlaceKind::passage) {
        EXPECT_NEAR(probe.reach, 0.7f, 1e-4f);
        continue;
      }
      EXPECT_EQ(probe.spacing == 1.2f, !refined);
      EXPECT_FLOAT_EQ(probe.reach, 1.8f * probe.spacing);
    }
  }
  for (const PlaceKind kind : {PlaceKind::grid, PlaceKind::refined, PlaceKind::passage})
    EXPECT_GT(kinds[kind], 0);
  EXPECT_EQ(kinds[PlaceKind::manual], 4);
}

TEST(PlaceRules, TheClearanceIsAtMostATenthOfTheSpacing) {
  const TriangleSource source(room(vec3(2)));
  PlaceParams params = params_at(0.5f);
  EXPECT_EQ(place_probes(source, params).clearance, 0.04f);
  params.clearance = 0.3f;
  EXPECT_EQ(place_probes(source, params).clearance, 0.1f * 0.5f);
}

TEST(PlaceRules, BetweenCloseWallsProbesShrinkToFourFifthsOfTheGap) {
  // 0.16 m from floor to ceiling: 0.08 m to either, and a tenth of a spacing is 0.1 m.
  const TriangleSource source(room({4, 0.16f, 4}));
  const Placement placement = place_probes(source, params_at(1));
  ASSERT_FALSE(placement.probes.empty());
  for (const PlacedProbe& probe : placement.probes) {
    EXPECT_LE(probe.clearance, 0.0801f);
    EXPECT_EQ(probe.radius, std::min(0.1f * probe.spacing, 0.8f * probe.clearance));
    EXPECT_LT(probe.radius, 0.065f);
  }
}

TEST(PlaceRules, WhatNobodySeesIsUnreachableAndCounted) {
  const TriangleSource source(scene_of({scene::flipped(scene::make_box(vec3(0), vec3(3))),
                                        scene::flipped(scene::make_box(vec3(4, 0, 0), vec3(7, 3, 3)))}));
  const Placement both = place_probes(source, params_at(1, {vec3(1.5f), vec3(5.5f, 1.5f, 1.5f)}));
  const Placement one = place_probes(source, params_at(1, {vec3(1.5f)}));
  EXPECT_EQ(both.counts.unreachable, 0u);
  EXPECT_EQ(one.counts.unreachable, both.probes.size() - one.probes.size());
  EXPECT_EQ(one.counts.candidates, both.counts.candidates);
}

TEST(PlaceRules, TheSceneGivesItsSphlsCamerasAndLampsThatHaveAPlace) {
  scene::Scene scene;
  for (int i = 0; i < 5; ++i) scene.nodes.emplace_back().local.translation = vec3(i, 2, 0);
  scene.sphls = {{"a", 0, 0.2f, true}, {"b", 1, 0.2f, false}};
  scene.cameras.resize(1);
  scene.cameras[0].node = 2;
  scene.lights.resize(2);
  scene.lights[0].type = scene::LightType::directional;
  scene.lights[0].node = 3;
  scene.lights[1].type = scene::LightType::point;
  scene.lights[1].node = 4;
  const PlaceParams params = place_params(scene);
  ASSERT_EQ(params.manual.size(), 1u);
  EXPECT_EQ(params.manual[0].name, "a");
  EXPECT_EQ(params.manual[0].radius, 0.2f);
  EXPECT_EQ(params.interest, (std::vector<vec3>{{0, 2, 0}, {2, 2, 0}, {4, 2, 0}}));
}

/// A crate fills its own box: all places in there are inside of it.
TEST(PlaceRules, AroundABodyThatFillsItsBoxProbesStandOutside) {
  const scene::Bounds crate{{-1, 0, -0.5f}, {1, 1, 0.5f}};
  struct Case {
    float scale, spacing;
    int count;
  };
  for (const Case& c : {Case{1, 0, 0}, {1, 0, 8}, {1e-3f, 0.5f, 0}, {1e4f, 0.5f, 0}}) {
    SCOPED_TRACE(testing::Message() << c.scale << " " << c.spacing << " " << c.count);
    const TriangleSource source(scene_of({scene::make_box(c.scale * crate.min, c.scale * crate.max)}));
    PlaceParams params;
    params.spacing = c.scale * c.spacing, params.count = c.count;
    const Placement placement = place_probes(source, params);
    vec3 beyond(0), before(0);  // how many, along each axis
    for (const PlacedProbe& probe : placement.probes) {
      const vec3 x = probe.position / c.scale;
      const float off = glm::distance(x, glm::clamp(x, crate.min, crate.max));
      EXPECT_GT(off, 0) << probe.name;
      EXPECT_LT(off, std::sqrt(3.0f)) << "half the longest side is added on each axis: " << probe.name;
      beyond += vec3(glm::greaterThan(x, crate.max)), before += vec3(glm::lessThan(x, crate.min));
    }
    if (c.count > 0) {
      EXPECT_EQ(placement.probes.size(), static_cast<std::size_t>(c.count));
    } else {
      EXPECT_TRUE(glm::all(glm::greaterThan(glm::min(beyond, before), vec3(0))));
    }
  }
}

TEST(PlaceRules, LimitsAreNamedWithWhatWasGiven) {
  const TriangleSource source(room(vec3(2)));
  const auto said = [&](const std::function<void(PlaceParams&)>& change) {
    PlaceParams params = params_at(1);
    change(params);
    return message_of([&] { place_probes(source, params); });
  };
  EXPECT_EQ(said([](PlaceParams& p) { p.levels = 3; }), "no error");
  EXPECT_THAT(said([](PlaceParams& p) { p.levels = 4; }), HasSubstr("the levels must be 0..3, not 4"));
  EXPECT_THAT(said([](PlaceParams& p) { p.levels = -1; }), HasSubstr("not -1"));
  EXPECT_THAT(said([](PlaceParams& p) { p.max_probes = 0; }), HasSubstr("must be 1..2097152, not 0"));
  EXPECT_THAT(said([](PlaceParams& p) { p.max_probes = 2097153; }), HasSubstr("not 2097153"));
  EXPECT_EQ(said([](PlaceParams& p) { p.max_probes = 2097152; }), "no error");
  EXPECT_THAT(said([](PlaceParams& p) { p.count = -2; }), HasSubstr("must be positive, not -2"));
  EXPECT_THAT(said([](PlaceParams& p) { p.spacing = 2e9f; }), HasSubstr("not 2e+09"));
  EXPECT_THAT(said([](PlaceParams& p) { p.clearance = INFINITY; }), HasSubstr("the clearance must be"));
  EXPECT_THAT(
      said([](PlaceParams& p) { p.spacing = 0.01f; }),
      HasSubstr("a spacing of 0.01 m gives more than 65536 probes (use a larger spacing, or --probes N for a "
                "number of probes)"));
  EXPECT_THAT(said([](PlaceParams& p) { p.count = 100; }), HasSubstr("probes of 100 find a place"));
  EXPECT_THAT(said([](PlaceParams& p) {
                p.manual = {{"one", vec3(1), 0.1f}, {"two", vec3(1.5f), 0.1f}};
                p.count = 1;
              }),
              HasSubstr("1 probe was asked for, and the scene has 2 SPHLs"));
  EXPECT_EQ(said([](PlaceParams& p) {
              p.manual = {{"one", vec3(1), 0.1f}, {"two", vec3(1.5f), 0.1f}};
              p.count = 2;
            }),
            "no error");
  EXPECT_THAT(said([](PlaceParams& p) { p.manual = {{"one", vec3(1), 0}}; }), HasSubstr("SPHL \"one\""));
  EXPECT_THAT(said([](PlaceParams& p) {
                p.manual = {{"far", vec3(INFINITY), 1}};
              }),
              HasSubstr("SPHL \"far\""));
}

TEST(PlaceRules, MoreThanTheLimitIsRefusedAndAsManyAreNot) {
  const TriangleSource source(room(vec3(4)));
  PlaceParams params = params_at(1);
  const auto count = static_cast<int>(place_probes(source, params).probes.size());
  params.max_probes = count;
  EXPECT_EQ(place_probes(source, params).probes.size(), static_cast<std::size_t>(count));
  params.max_probes = count - 1;
  EXPECT_THROW(place_probes(source, params), Error);
  params.count = count - 1;
  EXPECT_EQ(place_probes(source, params).counts.surplus, 1u) << "fewer were asked for";
}

TEST(PlaceRules, SixtyFourPlacesForEachProbeAllowedAreLookedAt) {
  // Two closets far apart: of 21 · 2.4 · 2.4 = 121 places most are within no room.
  const TriangleSource source(
      scene_of({scene::flipped(scene::make_box(vec3(0), vec3(1.4f))),
                scene::flipped(scene::make_box(vec3(18.6f, 0, 0), vec3(20, 1.4f, 1.4f)))}));
  PlaceParams params = params_at(1, {vec3(0.7f), vec3(19.3f, 0.7f, 0.7f)});
  params.levels = 0;
  params.max_probes = params.count = 2;  // 128 places
  EXPECT_EQ(place_probes(source, params).probes.size(), 2u);
  params.max_probes = params.count = 1;  // 64 places
  EXPECT_THAT(message_of([&] { place_probes(source, params); }), HasSubstr("gives more than 1 probes"));
}

TEST(PlaceRules, OfAGridThatGivesMoreTheMostSpreadAreKeptAndTheOthersCounted) {
  const TriangleSource source(room(vec3(4)));
  PlaceParams params = params_at(1, {vec3(2)});
  params.levels = 0;
  const Placement all = place_probes(source, params);
  params.count = 3;
  const Placement three = place_probes(source, params);
  EXPECT_EQ(three.probes.size(), 3u);
  EXPECT_EQ(three.counts.surplus, all.probes.size() - 3);
  EXPECT_EQ(three.counts.removed(), all.counts.removed() + three.counts.surplus);
  // Far corners of the grid, not neighbours.
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(glm::distance(three.probes[i].position, three.probes[j].position), 2);
}

TEST(PlaceRules, OfEightTimesTheLimitTheUnreachableAreStillLeftOut) {
  // A small room, in which somebody is, beside a large one where nobody is
  const TriangleSource source(scene_of({scene::flipped(scene::make_box(vec3(0), vec3(1.2f))),
                                        scene::flipped(scene::make_box(vec3(2, 0, 0), vec3(5, 3, 3)))}));
  PlaceParams params = params_at(0.8f, {vec3(0.6f)});
  const Placement all = place_probes(source, params);
  const std::size_t drafts = all.probes.size() + all.counts.unreachable;
  ASSERT_GT(drafts, 8 * all.probes.size() + 8);
  params.max_probes = static_cast<int>((drafts + 7) / 8);
  EXPECT_EQ(place_probes(source, params).probes.size(), all.probes.size());
  params.max_probes = static_cast<int>((drafts - 1) / 8);
  ASSERT_GE(params.max_probes, static_cast<int>(all.probes.size()));
  EXPECT_THROW(place_probes(source, params), Error);
}

TEST(PlaceRules, AFifthMoreThanAskedForIsNearEnough) {
  const TriangleSource source(room({7, 3, 5}));
  const auto surplus = [&](int count) {
    PlaceParams params;
    params.interest = {vec3(1)};
    params.levels = 0;
    params.count = count;
    return place_probes(source, params).counts.surplus;
  };
  // For both the first grid has 105 places: 17 over 88 are a fifth, 18 over 87 are more.
  EXPECT_EQ(surplus(88), 17u);
  EXPECT_LT(surplus(87), 17u);
}

TEST(PlaceRules, WithoutASpacingTheFirstGridOfAHundredToTwoHundredIsTaken) {
  // The first has as many cells as probes are wanted, a hundred: some are halved.
  std::size_t most = 0;
  for (const float height : {0.53f, 1.1f, 1.2f, 2.3f}) {
    const vec3 size(5, height, 4);
    const TriangleSource source(room(size));
    const Placement first = place_probes(source, params_at(std::cbrt(size.x * size.y * size.z / 100)));
    const std::size_t count = first.probes.size();
    most = std::max(most, count);
    EXPECT_EQ(place_probes(source, {}).probes.size(), count) << height;
  }
  EXPECT_GT(most, 180u);
}

TEST(PlaceFilter, KeepsEdgesBetweenWhatIsKept) {
  std::vector<Draft> drafts(5);
  for (int i = 0; i < 5; ++i) drafts[i].position = vec3(i, 0, 0);
  std::vector<PlacedEdge> edges{{0, 1, false}, {1, 3, true}, {2, 3, false}, {3, 4, false}};
  filter(drafts, edges, {false, true, false, true, true});
  ASSERT_EQ(drafts.size(), 3u);
  EXPECT_EQ(drafts[1].position, vec3(3, 0, 0));
  EXPECT_EQ(edges, (std::vector<PlacedEdge>{{0, 1, true}, {1, 2, false}}));
}

TEST(PlaceReachable, WhoSeesAShiningSurfaceOrIsManualLeadsTheOthers) {
  const RaySource empty_space([](const vec3&, const vec3&) { return rays::RayHit{}; });
  const PlaceParams params;
  const PlaceContext context{empty_space, params, {}, {0.04f, 0.25f}, 1};
  std::vector<Draft> drafts(6);
  for (int i = 0; i < 6; ++i) drafts[i].position = vec3(10 * (i / 2) + i % 2, 0, 0);
  const std::vector<PlacedEdge> edges{{0, 1, false}, {2, 3, false}, {4, 5, false}};
  drafts[1].site.emitter = true;
  EXPECT_EQ(reachable(context, drafts, edges), (std::vector<bool>{true, true, false, false, false, false}));
  drafts[4].kind = PlaceKind::manual;
  EXPECT_EQ(reachable(context, drafts, edges), (std::vector<bool>{true, true, false, false, true, true}));
}

TEST(PlaceSpread, OfEquallyFarOnesTheWidestComesFirst) {
  std::vector<Draft> drafts(4);
  for (int i = 0; i < 4; ++i) drafts[i].site.nearest = static_cast<float>(i == 2 ? 5 : 1);
  EXPECT_EQ(most_spread(drafts, {}, 1), (std::vector<bool>{false, false, true, false}));
  EXPECT_EQ(most_spread(drafts, {}, 2), (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(most_spread(drafts, {}, 9), std::vector<bool>(4, true));
  drafts[1].kind = drafts[3].kind = PlaceKind::manual;
  EXPECT_EQ(most_spread(drafts, {}, 1), (std::vector<bool>{false, true, false, true}))
      << "manual ones always";
}

}  // namespace
}  // namespace ssphh::place
