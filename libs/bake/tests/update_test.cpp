#include <functional>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/error.h>
#include <ssphh/core/random.h>

#include "error_message.h"
#include "fake_source.h"
#include "progress_recorder.h"

namespace ssphh::bake {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Five probes in a row along x, at 0, 1, ... 4 m.
probes::ProbeSet row() {
  probes::ProbeSet set;
  set.degree = 2;
  for (int i = 0; i < 5; ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = "p" + std::to_string(i);
    probe.position = {static_cast<float>(i), 0, 0};
  }
  return set;
}

probes::ProbeSet lit_row() {
  probes::ProbeSet set = row();
  set.light_groups = {{"sky", vec3(1)}};
  return set;
}

BakeParams row_bake() {
  BakeParams params;
  params.face_size = 4;
  params.path.spp = 4;
  params.viz = false;
  return params;
}

TEST(TransportParamsOf, AFileAreThoseOfItsBake) {
  probes::ProbeSet set = lit_row();
  set.generator.op = probes::LightOperator::surfel;
  set.generator.directions = 77, set.generator.surfel_size = 0.25f, set.generator.link_rays = 33;
  set.generator.viz = probes::VizMethod::links;
  set.generator.viz_source = probes::VizSource::radiance;
  probes::Baseline& baseline = set.baseline.emplace();
  baseline.viz_neighbors = 5, baseline.viz_threshold = 0.125f, baseline.records = 99,
  baseline.most_surfels = 4321;
  const TransportBakeParams params = transport_params_of(set);
  EXPECT_EQ(params.op, probes::LightOperator::surfel);
  EXPECT_EQ(params.transport.directions, 77);
  EXPECT_EQ(params.transport.surfel_size, 0.25f);
  EXPECT_EQ(params.transport.link_rays, 33);
  EXPECT_EQ(params.transport.most_surfels, 4321);
  EXPECT_TRUE(params.viz);
  EXPECT_EQ(params.viz_params.source, probes::VizSource::radiance);
  EXPECT_EQ(params.viz_params.neighbors, 5);
  EXPECT_EQ(params.viz_params.threshold, 0.125f);
  EXPECT_EQ(params.records.points, 99);
  EXPECT_FALSE(params.fit);
}

/// Light that depends on the paths' seed alone; remembers the seeds.
class SeededSource : public test::FakeSource {
 public:
  std::function<float(std::uint64_t seed)> level = [](std::uint64_t) { return 1.0f; };
  mutable std::set<std::uint64_t> seeds;

  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control&) const override {
    seeds.insert(request.path.seed);
    image::CubeMap map(request.face_size);
    for (image::Image& face : map.faces)
      for (float& value : face.pixels) value = level(request.path.seed);
    return {{image::CubeMap(request.face_size), map}};
  }
};

/// Radiance 1, times 1 + `more` beyond 2.5 m.
test::FakeSource::Field brighter_beyond(float more) {
  return [more](const vec3& position, const vec3& direction) {
    return vec3((position.x > 2.5f ? 1 + more : 1) * (1 + 0.5f * direction.y));
  };
}

probes::ProbeSet baked(const test::FakeSource& source) {
  BakeReport report;
  probes::ProbeSet set = bake(source, row(), row_bake(), {}, report);
  set.baseline.emplace().trials = make_trials(source, set);
  return set;
}

probes::Trial trial_of(const std::vector<float>& a, const std::vector<float>& b) {
  probes::Trial trial;
  const auto half = [](const std::vector<float>& values) {
    std::vector<sh::RadianceSh> groups;
    for (const float v : values) groups.emplace_back(probes::trial_degree)[4] = vec3(v, 0, 0);
    return groups;
  };
  trial.halves = {half(a), half(b)};
  return trial;
}

TEST(Update, ChangeIsRelativeToTheBrighterOfBothOverAllGroups) {
  EXPECT_EQ(changed_share(trial_of({0, 0}, {0, 0}), trial_of({0, 0}, {0, 0})), 0);
  EXPECT_EQ(changed_share(trial_of({3}, {3}), trial_of({3}, {3})), 0);
  EXPECT_FLOAT_EQ(changed_share(trial_of({3}, {3}), trial_of({4}, {4})), 0.25f);
  EXPECT_FLOAT_EQ(changed_share(trial_of({4}, {4}), trial_of({3}, {3})), 0.25f);
  EXPECT_FLOAT_EQ(changed_share(trial_of({0}, {0}), trial_of({3}, {3})), 1);
  EXPECT_FLOAT_EQ(changed_share(trial_of({3, 4}, {3, 4}), trial_of({3, 3}, {3, 3})), 0.2f);
  EXPECT_FLOAT_EQ(changed_share(trial_of({5}, {5}), trial_of({7}, {5})), 0) << "the other half denies it";
  EXPECT_FLOAT_EQ(changed_share(trial_of({5}, {5}), trial_of({7}, {4})), 0) << "they contradict each other";
}

TEST(Update, SquareOfTheChangeIsEstimatedWithoutBias) {
  // Halves of light 10 and of 10.5, each with noise of its own; what is cut off below 0 raises the mean by
  // next to nothing, for the change is 5 times its deviation.
  Pcg32 random(3);
  const auto noisy = [&](float v) { return v + 0.1f * (random.uniform() - 0.5f); };
  double sum2 = 0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const float share =
        changed_share(trial_of({noisy(10)}, {noisy(10)}), trial_of({noisy(10.5f)}, {noisy(10.5f)}));
    sum2 += double(share) * double(share) / count;
  }
  // One square has a deviation of sqrt(2) · 0.5 · 0.041 / 10.5² = 2.6e-4, the mean 4.1e-6; 5 sigma. The
  // light's own noise adds a relative 1e-5.
  EXPECT_NEAR(sum2, 0.25 / (10.5 * 10.5), 2.1e-5);
}

TEST(Update, NoiseIsThatOfTheBakeNotOfTheTrial) {
  probes::GeneratorInfo g;  // 6 · 64² · 16 paths; a half has 6 · 32²
  EXPECT_FLOAT_EQ(bake_noise(trial_of({5}, {5}), g), 0);
  EXPECT_EQ(bake_noise(trial_of({0}, {0}), g), 0);
  EXPECT_FLOAT_EQ(bake_noise(trial_of({9}, {11}), g), 0.1f / std::sqrt(32.0f));
}

TEST(Update, FindsTheProbesWhoseLightHasChanged) {
  test::FakeSource source;
  source.reflected = {brighter_beyond(0)};
  const probes::ProbeSet set = baked(source);
  EXPECT_THAT(plan_update(source, set, {}).probes, IsEmpty());
  EXPECT_THAT(plan_update(source, set, 0.0f).probes, IsEmpty()) << "nothing has changed by a bit";

  source.reflected = {brighter_beyond(0.25f)};
  const UpdatePlan plan = plan_update(source, set, {});
  EXPECT_THAT(plan.probes, ElementsAre(3, 4));
  EXPECT_THAT(plan.changed, ElementsAre(0, 0, 0, testing::FloatEq(0.2f), testing::FloatEq(0.2f)));
  EXPECT_EQ(plan.noise, 0);
  EXPECT_EQ(plan.tolerance, usual_tolerance);
  EXPECT_THAT(plan_update(source, set, 0.19f).probes, ElementsAre(3, 4));
  EXPECT_THAT(plan_update(source, set, 0.21f).probes, IsEmpty());

  source.reflected = {brighter_beyond(1e-4f)};
  EXPECT_THAT(plan_update(source, set, {}).probes, IsEmpty());
  EXPECT_THAT(plan_update(source, set, 0.0f).probes, ElementsAre(3, 4));
}

TEST(Update, EveryHalfHasRandomNumbersOfItsOwn) {
  SeededSource source;
  probes::ProbeSet set = lit_row();
  make_trials(source, set);
  EXPECT_EQ(source.seeds.size(), 10u) << "two of each probe";
  const std::set<std::uint64_t> first = source.seeds;
  make_trials(source, set);
  EXPECT_EQ(source.seeds, first) << "the same every time";
  set.generator.seed = 1;
  make_trials(source, set);
  EXPECT_EQ(source.seeds.size(), 20u);
}

TEST(Update, WithoutToleranceOneHalfIsEnough) {
  SeededSource source;
  probes::ProbeSet set = lit_row();
  set.baseline.emplace().trials = make_trials(source, set);
  const std::uint64_t changed = *source.seeds.begin();
  source.level = [&](std::uint64_t seed) { return seed == changed ? 1.5f : 1.0f; };
  EXPECT_THAT(plan_update(source, set, {}).changed, testing::Each(0));
  EXPECT_EQ(plan_update(source, set, 0.0f).probes.size(), 1u);
}

TEST(Update, EmittedLightCounts) {
  test::FakeSource source;
  const probes::ProbeSet dark = baked(source);
  source.emitted = {brighter_beyond(0)};
  EXPECT_EQ(plan_update(source, dark, {}).probes.size(), 5u);
}

TEST(Update, BakesOnlyWhatItIsTold) {
  test::FakeSource source;
  source.reflected = {brighter_beyond(0)};
  const probes::ProbeSet old = baked(source);
  source.reflected = {brighter_beyond(0.25f)};
  const probes::ProbeSet full = baked(source);
  BakeParams params = row_bake();
  params.only = {{1, 3}};
  BakeReport report;
  const probes::ProbeSet part = bake(source, old, params, {}, report);
  for (const std::size_t i : {0, 1, 2, 4}) EXPECT_EQ(part.probes[i], old.probes[i]) << i;
  EXPECT_EQ(part.probes[3], full.probes[3]);
  EXPECT_NE(part.probes[3], old.probes[3]);
  EXPECT_EQ(report.rays, 2u * 6 * 4 * 4);
  params.only = {{5}};
  EXPECT_THROW(bake(source, old, params, {}, report), Error);
}

TEST(Update, AScopeNamesTheProbesThatAreBaked) {
  test::FakeSource source;
  source.reflected = {brighter_beyond(0)};
  const probes::ProbeSet set = baked(source);
  source.reflected = {brighter_beyond(0.25f)};
  const UpdatePlan plan = plan_update(source, set, {}, {.probes = {{1, 3}}, .groups = {}});
  EXPECT_THAT(plan.probes, ElementsAre(1, 3)) << "whatever has changed";
  EXPECT_THAT(plan.changed, ElementsAre(0, 0, 0, testing::FloatEq(0.2f), 0)) << "4 is not compared";
  EXPECT_EQ(plan.trials[4], set.baseline->trials[4]);
  EXPECT_NE(plan.trials[3], set.baseline->trials[3]);
}

TEST(Update, AScopeNamesTheGroupsWhoseLightIsComparedAndBaked) {
  test::FakeSource source;
  source.groups = {"lamp", "sky"};
  source.reflected = {brighter_beyond(0), brighter_beyond(0)};
  const probes::ProbeSet old = baked(source);
  source.reflected = {brighter_beyond(0.25f), brighter_beyond(0)};
  EXPECT_THAT(plan_update(source, old, {}, {.probes = {}, .groups = {{1}}}).probes, IsEmpty());
  source.reflected = {brighter_beyond(0.25f), brighter_beyond(1)};
  const UpdatePlan plan = plan_update(source, old, {}, {.probes = {}, .groups = {{0}}});
  EXPECT_THAT(plan.probes, ElementsAre(3, 4));
  BakeParams params = row_bake();
  params.only = plan.probes;
  params.only_groups = {{0}};
  BakeReport report;
  probes::ProbeSet part = bake(source, old, params, {}, report);
  renew_trials(part, plan);
  const probes::ProbeSet full = baked(source);
  for (const std::size_t i : {3, 4}) {
    EXPECT_EQ(part.probes[i].groups[0], full.probes[i].groups[0]) << i;
    EXPECT_NE(part.probes[i].groups[0], old.probes[i].groups[0]) << i;
    EXPECT_EQ(part.probes[i].groups[1], old.probes[i].groups[1]) << i;
    EXPECT_NE(full.probes[i].groups[1], old.probes[i].groups[1]) << i;
  }
  EXPECT_THAT(plan_update(source, part, {}, {.probes = {}, .groups = {{0}}}).probes, IsEmpty());
  EXPECT_THAT(plan_update(source, part, {}).probes, ElementsAre(3, 4)) << "the sky is still to be baked";
  params.only_groups = {{2}};
  EXPECT_THROW(bake(source, old, params, {}, report), Error);
}

TEST(Update, SmallChangesAddUpUntilTheyCount) {
  test::FakeSource source;
  source.reflected = {brighter_beyond(0)};
  probes::ProbeSet set = baked(source);
  int baked_again = 0;
  for (int step = 1; step <= 4; ++step) {
    source.reflected = {brighter_beyond(0.004f * static_cast<float>(step))};
    const UpdatePlan plan = plan_update(source, set, {});
    baked_again += !plan.probes.empty();
    EXPECT_EQ(plan.probes.empty(), step != 3) << "1.2 % are more than 1 %, and the next step is 0.4 % of it";
    renew_trials(set, plan);
  }
  EXPECT_EQ(baked_again, 1);
}

TEST(Update, RenewsTheTrialsOfWhatWasBaked) {
  test::FakeSource source;
  source.reflected = {brighter_beyond(0)};
  probes::ProbeSet set = baked(source);
  const probes::Baseline before = *set.baseline;
  source.reflected = {brighter_beyond(0.25f)};
  const UpdatePlan plan = plan_update(source, set, {});
  renew_trials(set, plan);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(set.baseline->trials[i] == before.trials[i], i < 3) << i;
    EXPECT_EQ(set.baseline->trials[i], plan.trials[i]) << i;
  }
}

TEST(Update, RenewsNoTrialsOfOtherProbes) {
  probes::ProbeSet set = lit_row();
  set.baseline.reset();
  const std::string said = "update: the plan is of other probes";
  EXPECT_EQ(ssphh::test::message_of([&] { renew_trials(set, {}); }), said);
  set.baseline.emplace().trials.resize(4);
  UpdatePlan plan;
  plan.trials.resize(5);
  EXPECT_EQ(ssphh::test::message_of([&] { renew_trials(set, plan); }), said);
}

TEST(Update, LightGroupsKeepTheirLightByName) {
  test::FakeSource source;
  source.groups = {"lamp", "sky", "fire"};
  source.reflected = {brighter_beyond(0), test::constant(vec3(2)), test::constant(vec3(3))};
  probes::ProbeSet set = baked(source);
  set.light_groups[1].scale = vec3(0.5f);
  const probes::PackedRecordLight dim{1, {1}}, bright{2, {2}};
  set.surface = {{{vec3(0), vec3(0, 1, 0)}}, {{dim}, {bright}, {{}}}, {}};
  const probes::ProbeSet old = set;
  adopt_groups(set, source.groups);
  EXPECT_EQ(set, old);
  const std::vector<std::string> now = {"sky", "window", "lamp"};
  adopt_groups(set, now);
  ASSERT_EQ(set.light_groups.size(), 3u);
  EXPECT_EQ(set.light_groups[0], old.light_groups[1]);
  EXPECT_EQ(set.light_groups[1], (probes::LightGroup{"window", vec3(1)}));
  EXPECT_EQ(set.light_groups[2], old.light_groups[0]);
  EXPECT_THAT(set.surface->groups,
              ElementsAre(ElementsAre(bright), ElementsAre(probes::PackedRecordLight{}), ElementsAre(dim)));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(set.probes[i].groups[0], old.probes[i].groups[1]);
    EXPECT_EQ(set.probes[i].groups[1], (probes::GroupLight{{}, sh::RadianceSh(2)}));
    EXPECT_EQ(set.probes[i].groups[2], old.probes[i].groups[0]);
    for (std::size_t half = 0; half < 2; ++half) {
      const auto& trial = set.baseline->trials[i].halves[half];
      EXPECT_EQ(trial[0], old.baseline->trials[i].halves[half][1]);
      EXPECT_EQ(trial[1], sh::RadianceSh(probes::trial_degree));
      EXPECT_EQ(trial[2], old.baseline->trials[i].halves[half][0]);
    }
  }
}

TEST(Update, RefusesWhatCannotBeCompared) {
  test::FakeSource source;
  probes::ProbeSet set = baked(source);
  EXPECT_THROW(plan_update(source, set, -0.1f), Error);
  EXPECT_THROW(plan_update(source, set, std::nanf("")), Error);
  source.groups = {"sky", "lamp"};
  EXPECT_THROW(plan_update(source, set, {}), Error);
  source.groups = {"sky"};
  set.baseline->trials.clear();
  EXPECT_THROW(plan_update(source, set, {}), Error) << "of light by transport";
  set.baseline.reset();
  EXPECT_THROW(plan_update(source, set, {}), Error);
  EXPECT_EQ(test::message_of([] {
              changed_share(trial_of({1}, {1}), trial_of({1, 2}, {1, 2}));
            }),
            "trial: it is of another number of light groups");
}

TEST(Update, ProgressIsToldByProbes) {
  test::FakeSource source;
  const probes::ProbeSet set = baked(source);
  test::ProgressRecorder progress;
  make_trials(source, set, {&progress, nullptr});
  plan_update(source, set, {}, {}, {&progress, nullptr});
  EXPECT_THAT(progress.finished(), ElementsAre("trials: 5 probes", "comparing: 5 probes"));
}

}  // namespace
}  // namespace ssphh::bake
