/// What a bake writes down, hands on, warns of and refuses.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/log.h>

#include "bake_helpers.h"
#include "error_message.h"

namespace ssphh::bake {
namespace {

using test::constant;
using test::FakeSource;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(BakeRules, TheSetTellsHowItWasMade) {
  FakeSource source;
  source.groups = {"sun", "lamp"};
  source.reflected = {constant(vec3(1))};
  BakeParams params = test::small(8, 3);
  params.path.max_depth = 5, params.path.passes = 2, params.path.seed = 77;
  params.viz_params.source = probes::VizSource::radiance, params.viz_params.paths = rays::PathSet::diffuse;
  probes::ProbeSet start = test::places({vec3(0)}, 0.1f, 1);
  start.generator.op = probes::LightOperator::bounce;
  start.generator.time = 2.5f;
  start.hierarchy.emplace();
  const probes::ProbeSet set = test::bake_now(source, start, params);
  probes::GeneratorInfo expected;
  expected.op = probes::LightOperator::path, expected.viz = probes::VizMethod::path,
  expected.gen = probes::GenMode::full;
  expected.max_depth = 5, expected.passes = 2, expected.spp = 3, expected.face_size = 8, expected.seed = 77;
  expected.viz_source = probes::VizSource::radiance, expected.viz_paths = rays::PathSet::diffuse;
  expected.viz_max_depth = 5, expected.viz_passes = 2, expected.viz_spp = 3;
  expected.time = 2.5f;
  EXPECT_EQ(set.generator, expected);
  EXPECT_EQ(set.light_groups, (std::vector<probes::LightGroup>{{"sun", vec3(1)}, {"lamp", vec3(1)}}));
  EXPECT_FALSE(set.hierarchy.has_value());
  params.viz = false;
  EXPECT_EQ(test::bake_now(source, start, params).generator.viz, probes::VizMethod::none);
}

/// Writes down what is asked.
class Asked final : public FakeSource {
 public:
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control& control) const override {
    gen.push_back(request);
    return FakeSource::incident_radiance(request, control);
  }
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest& request,
                                             std::span<const rays::GhostSphere> ghosts, const GhostSink& sink,
                                             const Control& control) const override {
    viz.push_back(request);
    spheres.emplace_back(ghosts.begin(), ghosts.end());
    return FakeSource::ghost_radiance(request, ghosts, sink, control);
  }
  mutable std::vector<rays::CubeRequest> gen, viz;
  mutable std::vector<std::vector<rays::GhostSphere>> spheres;
};

TEST(BakeRules, EveryUnitHasItsPlaceAndASeedOfItsOwn) {
  Asked source;
  BakeParams params = test::small(4, 2);
  params.path.max_depth = 6, params.path.passes = 3, params.path.seed = 9;
  probes::ProbeSet start = test::places({vec3(1, 0, 0), vec3(2, 0, 0), vec3(4, 0, 0)}, 0.1f, 0);
  start.probes[2].radius = 0.3f;
  test::bake_now(source, start, params);
  ASSERT_EQ(source.gen.size(), 3u);
  ASSERT_EQ(source.viz.size(), 3u);
  std::vector<std::uint64_t> seeds;
  for (const auto* stage : {&source.gen, &source.viz}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const rays::CubeRequest& request = (*stage)[i];
      EXPECT_EQ(request.position, start.probes[i].position);
      EXPECT_EQ(request.face_size, 4);
      EXPECT_EQ(request.path.max_depth, 6);
      EXPECT_EQ(request.path.passes, 3);
      EXPECT_EQ(request.path.spp, 2);
      seeds.push_back(request.path.seed);
    }
  }
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::unique(seeds.begin(), seeds.end()), seeds.end());
  // All others are lit, in their order.
  ASSERT_EQ(source.spheres[1].size(), 2u);
  EXPECT_EQ(source.spheres[1][0].center, vec3(1, 0, 0));
  EXPECT_EQ(source.spheres[1][1].center, vec3(4, 0, 0));
  EXPECT_EQ(source.spheres[1][1].radius, 0.3f);
}

TEST(BakeRules, GenAndVizHavePathsOfTheirOwn) {
  Asked source;
  BakeParams params = test::small(4, 2);
  params.path.max_depth = 6, params.path.passes = 3, params.path.seed = 9;
  params.viz_path = {4, 5, 7, 1234};
  params.viz_params.paths = rays::PathSet::diffuse;
  const probes::ProbeSet start = test::places({vec3(1, 0, 0), vec3(2, 0, 0)}, 0.1f, 0);
  const probes::ProbeSet set = test::bake_now(source, start, params);
  for (const rays::CubeRequest& request : source.gen) {
    EXPECT_EQ(request.path.max_depth, 6);
    EXPECT_EQ(request.path.passes, 3);
    EXPECT_EQ(request.path.spp, 2);
    EXPECT_EQ(request.paths, rays::PathSet::all);
  }
  for (const rays::CubeRequest& request : source.viz) {
    EXPECT_EQ(request.path.max_depth, 4);
    EXPECT_EQ(request.path.passes, 5);
    EXPECT_EQ(request.path.spp, 7);
    EXPECT_EQ(request.paths, rays::PathSet::diffuse);
  }
  EXPECT_EQ(set.generator.seed, 9u) << "one for both";
  // What GEN leaves out with `local`, VIZ follows.
  params.viz_path.reset();
  params.gen = probes::GenMode::local;
  source.gen.clear(), source.viz.clear();
  const probes::ProbeSet local = test::bake_now(source, start, params);
  EXPECT_EQ(source.gen[0].path.max_depth, 1);
  EXPECT_EQ(source.viz[0].path.max_depth, 6);
  EXPECT_EQ(local.generator.max_depth, 1);
  EXPECT_EQ(local.generator.viz_max_depth, 6);
}

TEST(BakeRules, LightThatIsKeptStaysAndOnlyEdgesAreFound) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  const probes::ProbeSet lit =
      test::bake_now(source, test::places({vec3(0), vec3(1, 0, 0)}, 0.3f, 1), test::small());
  probes::ProbeSet other = lit;
  other.generator.op = probes::LightOperator::surfel;
  for (probes::Probe& probe : other.probes) probe.edges.clear();
  other.light_groups[0].scale = vec3(0.5f);
  source.reflected = {constant(vec3(7))};
  BakeParams params = test::small();
  params.keep_light = true;
  const probes::ProbeSet kept = test::bake_now(source, other, params);
  EXPECT_EQ(kept.generator.op, probes::LightOperator::surfel);
  EXPECT_EQ(kept.light_groups[0].scale, vec3(0.5f));
  EXPECT_EQ(kept.probes[0].groups, lit.probes[0].groups);
  EXPECT_EQ(kept.probes[0].edges, lit.probes[0].edges);
  source.groups = {"moon"};
  EXPECT_THAT(message_of([&] { test::bake_now(source, other, params); }), HasSubstr("other light groups"));
}

TEST(BakeRules, CountRaysAndWhatTheCheckpointHeld) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  BakeReport report;
  report.resumed = 5, report.warnings = {"of an earlier bake"};
  bake(source, test::places({vec3(0), vec3(2, 0, 0)}, 0.1f, 1), test::small(8, 3), {}, report);
  // GEN of a lit field: a ray a texel; VIZ three.
  EXPECT_EQ(report.rays, 2u * 6 * 64 * (1 + 3));
  EXPECT_EQ(report.resumed, 0u);
  EXPECT_THAT(report.warnings, testing::IsEmpty());
  EXPECT_GT(report.gen_seconds, 0);
  EXPECT_GT(report.viz_seconds, 0);
}

class BakeWords : public testing::Test {
 protected:
  std::vector<std::string> logged;
  LogSink before = set_log_sink([this](LogLevel, const std::string& line) { logged.push_back(line); });
  BakeWords() { set_log_level(LogLevel::warning); }
  ~BakeWords() override {
    set_log_sink(before);
    set_log_level(LogLevel::error);
  }
  std::vector<std::string> warnings(const rays::RadianceSource& source, const probes::ProbeSet& set) {
    BakeReport report;
    bake(source, set, test::small(8, 1), {}, report);
    return report.warnings;
  }
};

TEST_F(BakeWords, InsideABodyIsMoreThanHalfOfBacks) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  source.backfaces = 0.5f;
  EXPECT_THAT(warnings(source, test::places({vec3(0)}, 0.1f, 0)), testing::IsEmpty());
  source.backfaces = 0.56f;
  EXPECT_THAT(warnings(source, test::places({vec3(0)}, 0.1f, 0)),
              ElementsAre("probe \"SPHL0\" seems to lie inside a body: 56 % of what it sees are back faces"));
}

TEST_F(BakeWords, OnlyWhatNeitherEmitsNorReflectsIsDark) {
  FakeSource source;
  source.groups = {"sun", "lamp"};
  source.emitted = {FakeSource::Field(), constant(vec3(1))};
  EXPECT_THAT(warnings(source, test::places({vec3(0)}, 0.1f, 0)), testing::IsEmpty());
  source.emitted = {}, source.reflected = {FakeSource::Field(), constant(vec3(0, 0, 0.1f))};
  EXPECT_THAT(warnings(source, test::places({vec3(0)}, 0.1f, 0)), testing::IsEmpty());
  source.reflected = {};
  EXPECT_THAT(warnings(source, test::places({vec3(0)}, 0.1f, 0)),
              ElementsAre("probe \"SPHL0\" receives no light at all"));
}

TEST_F(BakeWords, AProbeWithinTheSphereOfAnotherIsTold) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  probes::ProbeSet two = test::places({vec3(0), vec3(1, 0, 0)}, 0.1f, 0);
  EXPECT_THAT(warnings(source, two), testing::IsEmpty());
  two.probes[1].radius = 1;
  EXPECT_THAT(
      warnings(source, two),
      ElementsAre("probe \"SPHL0\" stands within the sphere of \"SPHL1\", whose light it gets from all "
                  "sides: the radius of 1 m is too large"));
}

TEST_F(BakeWords, TenWarningsAreLoggedAndTheRestCounted) {
  const FakeSource dark;
  std::vector<vec3> where;
  for (int i = 0; i < 10; ++i) where.emplace_back(10 * i, 0, 0);
  EXPECT_EQ(warnings(dark, test::places(where, 0.01f, 0)).size(), 10u);
  EXPECT_EQ(logged.size(), 10u);
  logged.clear();
  where.emplace_back(0, 10, 0), where.emplace_back(0, 20, 0);
  EXPECT_EQ(warnings(dark, test::places(where, 0.01f, 0)).size(), 12u);
  ASSERT_EQ(logged.size(), 11u);
  EXPECT_THAT(logged[10], HasSubstr("and 2 more like these"));
}

/// Does all units, one of them as the test says.
class Crew final : public BakeCrew {
 public:
  Crew(const rays::RadianceSource& source, std::function<void(ProbeStageResult&)> change)
      : source_(source), change_(std::move(change)) {}
  std::size_t leave_out = 0;
  void run(const probes::ProbeSet& set, const BakeParams& params, std::span<const ProbeStage> stages,
           const std::function<void(ProbeStageResult)>& done, const Control&) override {
    // The last first: any order will do.
    for (std::size_t i = stages.size(); i-- > leave_out;) {
      ProbeStageResult result = bake_stage(source_, set, params.viz_params, stages[i]);
      change_(result);
      done(std::move(result));
    }
  }

 private:
  const rays::RadianceSource& source_;
  std::function<void(ProbeStageResult&)> change_;
};

TEST(BakeCrewRules, TheSameSetAsHereWhateverTheOrder) {
  FakeSource source;
  source.reflected = {[](const vec3& p, const vec3& d) { return vec3(2 + glm::dot(p, d), 1, 0.5f); }};
  const probes::ProbeSet start = test::places(test::four_places, 0.2f, 2);
  Crew crew(source, [](ProbeStageResult& r) { r.seconds = 2, r.rays = 10; });
  BakeReport report;
  EXPECT_EQ(bake(source, start, test::small(), {}, report, {}, &crew),
            test::bake_now(source, start, test::small()));
  EXPECT_EQ(report.gen_seconds, 8);
  EXPECT_EQ(report.viz_seconds, 8);
  EXPECT_EQ(report.rays, 80u);
}

TEST(BakeCrewRules, WhatAnswersNoUnitIsRefused) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  const probes::ProbeSet start = test::places(test::four_places, 0.2f, 2);
  const auto said = [&](const std::function<void(ProbeStageResult&)>& change, std::size_t leave_out = 0) {
    Crew crew(source, change);
    crew.leave_out = leave_out;
    BakeReport report;
    return message_of([&] { bake(source, start, test::small(), {}, report, {}, &crew); });
  };
  EXPECT_EQ(said([](ProbeStageResult&) {}), "no error");
  EXPECT_THAT(said([](ProbeStageResult&) {}, 1), HasSubstr("it left probes out"));
  EXPECT_THAT(said([](ProbeStageResult& r) { r.done.probe = 3; }), HasSubstr("not asked for"));
  EXPECT_THAT(said([](ProbeStageResult& r) { r.done.probe += 4; }), HasSubstr("not asked for"));
  EXPECT_THAT(said([](ProbeStageResult& r) { r.groups.clear(); }), HasSubstr("other light groups"));
  EXPECT_THAT(said([](ProbeStageResult& r) {
                if (!r.groups.empty()) r.groups[0].reflected = sh::RadianceSh(1);
              }),
              HasSubstr("not of the set's degree"));
  EXPECT_THAT(said([](ProbeStageResult& r) {
                if (!r.groups.empty()) r.groups[0].emitted = sh::RadianceSh(3);
              }),
              HasSubstr("not of the set's degree"));
  const auto edge = [](int from, int degree) {
    return [=](ProbeStageResult& r) {
      if (!r.edges.empty()) r.edges[0].from = from, r.edges[0].h = sh::RadianceSh(degree);
    };
  };
  EXPECT_THAT(said(edge(-1, 2)), HasSubstr("an edge comes from no probe"));
  EXPECT_THAT(said(edge(4, 2)), HasSubstr("an edge comes from no probe"));
  EXPECT_THAT(said(edge(0, 1)), HasSubstr("an edge comes from no probe or is not of the set's degree"));
}

TEST(BakeRules, ErrorsSayWhere) {
  FakeSource source;
  EXPECT_THAT(message_of([&] { test::bake_now(source, {}, test::small()); }), HasSubstr("INIT"));
  EXPECT_THAT(message_of([&] {
                const probes::ProbeSet set = test::places({vec3(0)}, 1, 1);
                bake_stage(source, set, {}, {BakeStage::gen, 1});
              }),
              HasSubstr("no probe of that index"));
  source.groups = {"sun", "lamp"};
  source.reflected = {constant(vec3(1)), constant(vec3(NAN))};
  EXPECT_THAT(
      message_of([&] { test::bake_now(source, test::places({vec3(1, 2.5f, 3)}, 1, 1), test::small()); }),
      HasSubstr("probe at (1, 2.5, 3), light group \"lamp\""));
  source.reflected = {}, source.emitted = {constant(vec3(NAN))};
  EXPECT_THAT(
      message_of([&] { test::bake_now(source, test::places({vec3(1, 2.5f, 3)}, 1, 1), test::small()); }),
      HasSubstr("light group \"sun\""));
}

}  // namespace
}  // namespace ssphh::bake
