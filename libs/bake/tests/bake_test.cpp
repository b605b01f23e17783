#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/sh/reconstruct.h>

#include "bake_helpers.h"
#include "progress_recorder.h"
#include "root_4pi.h"

namespace ssphh::bake {
namespace {

using test::constant;
using test::FakeSource;
using testing::HasSubstr;

using test::root_4pi;

TEST(Gen, AConstantFieldHasOnlyBandZero) {
  FakeSource source;
  source.reflected = {constant({1, 2, 0.5f})};
  const probes::ProbeSet set = test::bake_now(source, test::places({{1, 2, 3}}, 0.1f, 9), test::small(64));
  const sh::RadianceSh& s = set.probes[0].self;
  for (int k = 0; k < 100; ++k) {
    // Exact solid angles leave float rounding in band 0; the symmetry of the cube cancels the bands 1, 2, 3.
    // From band 4 on the texels' centres are a second-order quadrature: measured 0.026 at 8 texels, so 4e-4
    // at 64.
    const float bound = k < 16 ? 2e-5f : 1e-3f;
    EXPECT_NEAR(s[k].x, k == 0 ? root_4pi : 0, bound) << k;
    EXPECT_NEAR(s[k].y, k == 0 ? 2 * root_4pi : 0, 2 * bound) << k;
  }
}

TEST(Gen, ALinearSkyHasTheCoefficientsOfItsFormula) {
  // L = a + b·ω: S00 = a√4π, S1 = √(4π/3) b.
  FakeSource source;
  const vec3 b(0.3f, -0.2f, 0.5f);
  source.reflected = {[&](const vec3&, const vec3& d) { return vec3(1 + glm::dot(b, d)); }};
  const probes::ProbeSet set = test::bake_now(source, test::places({{0, 0, 0}}, 0.1f, 2), test::small(64));
  const sh::RadianceSh& s = set.probes[0].self;
  const float scale = std::sqrt(4 * pi / 3);
  // 64² texels sampled at their centres: second-order error, below 1e-3.
  EXPECT_NEAR(s[0].x, root_4pi, 1e-3f);
  EXPECT_NEAR(s[1].x, scale * b.y, 1e-3f);
  EXPECT_NEAR(s[2].x, scale * b.z, 1e-3f);
  EXPECT_NEAR(s[3].x, scale * b.x, 1e-3f);
  for (int k = 4; k < 9; ++k) EXPECT_NEAR(s[k].x, 0, 1e-3f);
}

TEST(Gen, EmittedAndReflectedLightStayApartAndSelfIsTheirSum) {
  FakeSource source;
  source.groups = {"sun", "lamp"};
  source.emitted = {constant(vec3(5)), FakeSource::Field()};
  source.reflected = {constant(vec3(1)), constant(vec3(2))};
  probes::ProbeSet set = test::bake_now(source, test::places({{0, 0, 0}}, 0.1f, 1), test::small());
  const probes::Probe& probe = set.probes[0];
  ASSERT_EQ(set.light_groups.size(), 2u);
  EXPECT_EQ(set.light_groups[1].name, "lamp");
  EXPECT_TRUE(probe.groups[1].emitted.empty()) << "zero is stored as nothing";
  EXPECT_NEAR(probe.reflected[0].x, 3 * root_4pi, 1e-4f);
  EXPECT_NEAR(probe.self[0].x, 8 * root_4pi, 1e-4f);
  probes::relight(set, "sun", vec3(0));
  EXPECT_NEAR(set.probes[0].self[0].x, 2 * root_4pi, 1e-4f);
}

TEST(Gen, GroupsAddUpToTheBakeOfAllLightsAndDimmingEqualsANewBake) {
  const FakeSource::Field warm = [](const vec3& p, const vec3& d) {
    return vec3(1, 0.5f, 0.2f) * (1.5f + d.x * p.y);
  };
  const FakeSource::Field cold = [](const vec3&, const vec3& d) {
    return vec3(0.2f, 0.5f, 1) * (2 + d.y * d.z);
  };
  FakeSource two, all, dimmed;
  two.groups = {"warm", "cold"};
  two.reflected = {warm, cold};
  all.reflected = {[&](const vec3& p, const vec3& d) { return warm(p, d) + cold(p, d); }};
  dimmed.reflected = {
      [&](const vec3& p, const vec3& d) { return 0.25f * warm(p, d) + vec3(1, 0, 2) * cold(p, d); }};
  const probes::ProbeSet start = test::places({{0, 1, 0}, {2, 0.5f, 0}}, 0.1f, 4);
  probes::ProbeSet set = test::bake_now(two, start, test::small());
  const auto expect_same = [&](const probes::ProbeSet& other) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (int k = 0; k < 25; ++k) {
        // The order of a float sum is all that differs.
        EXPECT_LT(glm::length(set.probes[i].self[k] - other.probes[i].self[k]), 2e-5f) << i << " " << k;
      }
    }
  };
  expect_same(test::bake_now(all, start, test::small()));
  probes::relight(set, "warm", vec3(0.25f));
  probes::relight(set, "cold", {1, 0, 2});
  expect_same(test::bake_now(dimmed, start, test::small()));
}

TEST(Gen, LocalMeansDepthOne) {
  FakeSource source;
  BakeParams params = test::small();
  params.path.max_depth = 7;
  params.gen = probes::GenMode::local;
  EXPECT_EQ(test::bake_now(source, test::places({{0, 0, 0}}, 0.1f, 1), params).generator.max_depth, 1);
}

TEST(Bake, TellsOfEveryProbeWhenItsStageIsDone) {
  const FakeSource source;
  const probes::ProbeSet start = test::places({{0, 0, 0}, {1, 0, 0}}, 0.2f, 2);
  const BakeParams params = test::small();
  std::vector<std::pair<std::size_t, bool>> told;
  BakeReport report;
  const probes::ProbeSet set =
      bake(source, start, params, {}, report, {}, nullptr,
           [&](std::size_t i, const probes::Probe& probe) { told.emplace_back(i, probe.edges.empty()); });
  using testing::Pair;
  EXPECT_THAT(told, testing::ElementsAre(Pair(0, true), Pair(1, true), Pair(0, false), Pair(1, false)))
      << "GEN of all, then VIZ";
  EXPECT_EQ(test::bake_now(source, start, params), set);
}

TEST(Bake, InsideTheSphereOfAnotherTransferIsItsRadiance) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  BakeReport report;
  BakeParams params = test::small();
  for (const auto& [viz, radiance] :
       {std::pair(probes::VizSource::radiance, 1.0f), std::pair(probes::VizSource::intensity, 4 / pi)}) {
    params.viz_params.source = viz;
    const probes::ProbeSet set =
        bake(source, test::places({{0, 0, 0}, {0.1f, 0, 0}}, 0.5f, 1), params, {}, report);
    EXPECT_NEAR(set.probes[0].edges[0].transfer, radiance, 1e-5f * radiance);
  }
}

/// Warnings are for people; here only BakeWarnings wants them.
const bool quiet = (set_log_level(LogLevel::error), true);

class BakeWarnings : public testing::Test {
 protected:
  BakeWarnings() { set_log_level(LogLevel::warning); }
  std::vector<std::string> lines;
  LogSink before = set_log_sink([this](LogLevel, const std::string& line) { lines.push_back(line); });
  ~BakeWarnings() override {
    set_log_sink(before);
    set_log_level(LogLevel::error);
  }
};

TEST_F(BakeWarnings, ADarkProbeAndAProbeInsideABodyAreNamed) {
  FakeSource source;
  BakeReport report;
  bake(source, test::places({{0, 0, 0}}, 0.1f, 1), test::small(), {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("\"SPHL0\" receives no light"));
  source.backfaces = 0.9f;
  bake(source, test::places({{0, 0, 0}}, 0.1f, 1), test::small(), {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("\"SPHL0\" seems to lie inside a body"));
  EXPECT_EQ(lines.size(), 2u);
}

TEST(Bake, AnEmptySetBadParametersAndInfiniteLightAreErrors) {
  FakeSource source;
  EXPECT_THROW(test::bake_now(source, test::places({}, 1, 1), test::small()), Error);
  EXPECT_THROW(test::bake_now(source, test::places({{0, 0, 0}}, 1, 1), test::small(0)), Error);
  EXPECT_THROW(test::bake_now(source, test::places({{0, 0, 0}}, 1, 1), test::small(16, 0)), Error);
  source.reflected = {constant(vec3(std::numeric_limits<float>::infinity()))};
  EXPECT_THROW(test::bake_now(source, test::places({{0, 0, 0}}, 1, 1), test::small()), Error);
}

TEST(Bake, TheNumberOfThreadsChangesNoBit) {
  const FakeSource source;
  BakeParams params = test::small(12, 3);
  params.viz_params.matrix = true;
  std::vector<std::vector<std::byte>> files;
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    probes::ProbeSet set = test::bake_now(source, test::places(test::four_places, 0.2f, 3), params);
    probes::hier(set, {probes::HierOperator::matrix, 2, 0});
    files.push_back(probes::probes_to_binary(set));
  }
  set_thread_count(0);
  EXPECT_EQ(files[1], files[0]);
  EXPECT_EQ(files[2], files[0]);
}

TEST(Bake, ProgressReachesTheTotalAndACancelStops) {
  test::ProgressRecorder progress;
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  CancelToken cancel;
  BakeReport report;
  bake(source, test::places(test::four_places, 0.2f, 1), test::small(), {}, report, {&progress, &cancel});
  const std::string texels = std::to_string(4 * 6 * 16 * 16) + " texels";
  EXPECT_THAT(progress.finished(), testing::ElementsAre("GEN: " + texels, "VIZ: " + texels));
  cancel.request();
  EXPECT_THROW(
      bake(source, test::places(test::four_places, 0.2f, 1), test::small(), {}, report, {&progress, &cancel}),
      Cancelled);
}

}  // namespace
}  // namespace ssphh::bake
