#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/gi/bake.h>
#include <ssphh/gi/hier.h>
#include <ssphh/gi/init.h>
#include <ssphh/gi/probe_file.h>
#include <ssphh/sh/reconstruct.h>

#include "fake_source.h"
#include "random_set.h"
#include "temp_dir.h"

namespace ssphh::gi {
namespace {

using test::constant;
using test::FakeSource;
using testing::HasSubstr;

constexpr float root_4pi = 3.5449077018110318f;

ProbeSet places(const std::vector<vec3>& positions, float radius, int degree) {
  ProbeSet set;
  set.degree = degree;
  for (const vec3& position : positions) {
    Probe probe;
    probe.name = "SPHL" + std::to_string(set.probes.size());
    probe.position = position;
    probe.radius = radius;
    set.probes.push_back(probe);
  }
  return set;
}

BakeParams small(int face = 16, int spp = 4) {
  BakeParams params;
  params.face_size = face;
  params.path.spp = spp;
  return params;
}

ProbeSet bake_now(const scene::RadianceSource& source, const ProbeSet& set, const BakeParams& params) {
  BakeReport report;
  return bake(source, set, params, {}, report);
}

TEST(Init, TakesTheEnabledSphlsOfASceneInOrder) {
  scene::Scene scene;
  scene.name = "room";
  for (int i = 0; i < 3; ++i) {
    scene::Node node;
    node.local.translation = vec3(static_cast<float>(i), 1, 2);
    scene.nodes.push_back(node);
    scene.sphls.push_back({"SPHL" + std::to_string(i), i, 0.2f, i != 1});
  }
  const ProbeSet set = init_from_scene(scene, 5);
  ASSERT_EQ(set.probes.size(), 2u);
  EXPECT_EQ(set.probes[1].name, "SPHL2");
  EXPECT_EQ(set.probes[1].position, vec3(2, 1, 2));
  EXPECT_EQ(set.probes[1].radius, 0.2f);
  EXPECT_EQ(set.degree, 5);
  EXPECT_EQ(set.generator.scene, "room");
  EXPECT_EQ(set.generator.scene_hash, scene::light_hash(scene));
}

TEST(Init, ASceneWithoutSphlsSaysHowToAddSome) {
  try {
    init_from_scene(scene::Scene(), 9);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("extras"));
  }
  EXPECT_THROW(init_from_scene(scene::Scene(), 11), Error);
  EXPECT_THROW(init_from_scene(scene::Scene(), -1), Error);
}

TEST(Gen, AConstantFieldHasOnlyBandZero) {
  FakeSource source;
  source.reflected = {constant({1, 2, 0.5f})};
  const ProbeSet set = bake_now(source, places({{1, 2, 3}}, 0.1f, 9), small(64));
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
  const ProbeSet set = bake_now(source, places({{0, 0, 0}}, 0.1f, 2), small(64));
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
  ProbeSet set = bake_now(source, places({{0, 0, 0}}, 0.1f, 1), small());
  const Probe& probe = set.probes[0];
  ASSERT_EQ(set.light_groups.size(), 2u);
  EXPECT_EQ(set.light_groups[1].name, "lamp");
  EXPECT_TRUE(probe.groups[1].emitted.empty()) << "zero is stored as nothing";
  EXPECT_NEAR(probe.reflected[0].x, 3 * root_4pi, 1e-4f);
  EXPECT_NEAR(probe.self[0].x, 8 * root_4pi, 1e-4f);
  relight(set, "sun", vec3(0));
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
  const ProbeSet start = places({{0, 1, 0}, {2, 0.5f, 0}}, 0.1f, 4);
  ProbeSet set = bake_now(two, start, small());
  const auto expect_same = [&](const ProbeSet& other) {
    for (std::size_t i = 0; i < 2; ++i) {
      for (int k = 0; k < 25; ++k) {
        // The order of a float sum is all that differs.
        EXPECT_LT(glm::length(set.probes[i].self[k] - other.probes[i].self[k]), 2e-5f) << i << " " << k;
      }
    }
  };
  expect_same(bake_now(all, start, small()));
  relight(set, "warm", vec3(0.25f));
  relight(set, "cold", {1, 0, 2});
  expect_same(bake_now(dimmed, start, small()));
}

TEST(Gen, LocalMeansDepthOne) {
  FakeSource source;
  BakeParams params = small();
  params.path.max_depth = 7;
  params.gen = GenMode::local;
  EXPECT_EQ(bake_now(source, places({{0, 0, 0}}, 0.1f, 1), params).generator.max_depth, 1);
}

TEST(Bake, TellsOfEveryProbeWhenItsStageIsDone) {
  const FakeSource source;
  const ProbeSet start = places({{0, 0, 0}, {1, 0, 0}}, 0.2f, 2);
  BakeParams params = small();
  std::vector<std::pair<std::size_t, bool>> told;
  params.on_probe = [&](std::size_t i, const Probe& probe) { told.emplace_back(i, probe.edges.empty()); };
  const ProbeSet set = bake_now(source, start, params);
  using testing::Pair;
  EXPECT_THAT(told, testing::ElementsAre(Pair(0, true), Pair(1, true), Pair(0, false), Pair(1, false)))
      << "GEN of all, then VIZ";
  params.on_probe = nullptr;
  EXPECT_EQ(bake_now(source, start, params), set);
}

TEST(Viz, ASphereInEmptySpaceIsSeenUnderItsSolidAngle) {
  // ∫H dω = 2π(1 − √(1 − (r/d)²)), and P is its share of the sphere.
  const float r = 0.5f, d = 2;
  const FakeSource source;
  const ProbeSet set = bake_now(source, places({{0, 0, 0}, {d, 0, 0}}, r, 4), small(32, 16));
  ASSERT_EQ(set.probes[0].edges.size(), 1u);
  const Edge& edge = set.probes[0].edges[0];
  EXPECT_EQ(edge.from, 1);
  const double omega = 2 * pi_d * (1 - std::sqrt(1 - r * r / (d * d)));
  // Only the rim's texels vary: about 60 of them with 16 jittered samples each, standard error below 0.5 %.
  EXPECT_NEAR(edge.h[0].x * root_4pi, omega, 0.02 * omega);
  EXPECT_NEAR(edge.transfer, omega / (4 * pi_d), 0.02 * omega / (4 * pi_d));
  // It is seen toward +x.
  EXPECT_GT(sh::eval(edge.h, {1, 0, 0}).x, 5 * std::abs(sh::eval(edge.h, {-1, 0, 0}).x));
}

TEST(Viz, SymmetricGeometryHasSymmetricTransfer) {
  const FakeSource source;
  const ProbeSet set = bake_now(source, places({{0, 0, 0}, {1, 1, 0}, {3, 0, -1}}, 0.3f, 2), small(32, 16));
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(set.probes[i].edges.size(), 2u);
    for (const Edge& edge : set.probes[i].edges) {
      const Probe& other = set.probes[static_cast<std::size_t>(edge.from)];
      const auto back = std::find_if(other.edges.begin(), other.edges.end(),
                                     [&](const Edge& e) { return e.from == static_cast<int>(i); });
      ASSERT_NE(back, other.edges.end());
      // The farthest sphere covers about 50 texels; 6 % is over four standard errors of its rim.
      EXPECT_NEAR(edge.transfer, back->transfer, 0.06f * back->transfer);
    }
  }
}

TEST(Viz, BehindAWallThereIsNoEdge) {
  FakeSource source;
  source.free = [](const vec3& a, const vec3& b) { return (a.x < 1) == (b.x < 1); };
  const ProbeSet set = bake_now(source, places({{0, 0, 0}, {0.5f, 1, 0}, {2, 0, 0}}, 0.2f, 2), small(32, 4));
  ASSERT_EQ(set.probes[0].edges.size(), 1u);
  EXPECT_EQ(set.probes[0].edges[0].from, 1);
  EXPECT_TRUE(set.probes[2].edges.empty());
}

TEST(Viz, MatrixOfAnIsotropicEmitterIsTheMeanOperator) {
  const FakeSource source;
  BakeParams params = small(16, 4);
  params.viz_params.matrix = true;
  ProbeSet set = bake_now(source, places({{0, 0, 0}, {1, 0, 0}}, 0.4f, 3), params);
  const Edge& edge = set.probes[0].edges[0];
  const auto count = static_cast<std::size_t>(sh::coefficient_count(3));
  for (std::size_t k = 0; k < count; ++k) {
    // T[k, 0] = H[k]·Y00. H uses the texel's centre, T the ray itself: half a texel of 16, in band 3.
    EXPECT_NEAR(edge.matrix.values[k * count].x, edge.h.values[k].x / root_4pi, 0.01f) << k;
  }
  // A torch that shines only away from probe 0 leaves it dark: emission direction −x is what arrives.
  sh::RadianceSh torch(3);
  torch[0] = vec3(root_4pi);
  torch[3] = vec3(std::sqrt(4 * pi / 3));  // 1 + x
  set.probes[1].groups[0].reflected = torch;
  merge_groups(set);
  hier(set, {HierOperator::matrix, -1, 0});
  const vec3 away = set.hierarchy->neighbor[0][0];
  set.probes[1].groups[0].reflected[3] *= -1.0f;
  merge_groups(set);
  hier(set, {HierOperator::matrix, -1, 0});
  const vec3 toward = set.hierarchy->neighbor[0][0];
  // Seen under up to 24°, so that 1 + x is up to 0.09 there and 1 − x at least 1.91.
  EXPECT_LT(away.x, 0.09f / 1.91f * toward.x);
}

TEST(Bake, InsideTheSphereOfAnotherTransferIsOne) {
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  BakeReport report;
  const ProbeSet set = bake(source, places({{0, 0, 0}, {0.1f, 0, 0}}, 1, 1), small(), {}, report);
  EXPECT_NEAR(set.probes[0].edges[0].transfer, 1, 1e-5f);
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
  bake(source, places({{0, 0, 0}}, 0.1f, 1), small(), {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("\"SPHL0\" receives no light"));
  source.backfaces = 0.9f;
  bake(source, places({{0, 0, 0}}, 0.1f, 1), small(), {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("\"SPHL0\" seems to lie inside a body"));
  EXPECT_EQ(lines.size(), 2u);
}

TEST(Bake, AnEmptySetBadParametersAndInfiniteLightAreErrors) {
  FakeSource source;
  EXPECT_THROW(bake_now(source, places({}, 1, 1), small()), Error);
  EXPECT_THROW(bake_now(source, places({{0, 0, 0}}, 1, 1), small(0)), Error);
  EXPECT_THROW(bake_now(source, places({{0, 0, 0}}, 1, 1), small(16, 0)), Error);
  source.reflected = {constant(vec3(std::numeric_limits<float>::infinity()))};
  EXPECT_THROW(bake_now(source, places({{0, 0, 0}}, 1, 1), small()), Error);
}

const std::vector<vec3> four_places = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.7f, 0}, {0.1f, 0.2f, 0.9f}};

TEST(Bake, TheNumberOfThreadsChangesNoBit) {
  const FakeSource source;
  BakeParams params = small(12, 3);
  params.viz_params.matrix = true;
  std::vector<std::vector<std::byte>> files;
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    ProbeSet set = bake_now(source, places(four_places, 0.2f, 3), params);
    hier(set, {HierOperator::matrix, 2, 0});
    files.push_back(probes_to_binary(set));
  }
  set_thread_count(0);
  EXPECT_EQ(files[1], files[0]);
  EXPECT_EQ(files[2], files[0]);
}

TEST(Bake, ResumedAfterAStopAtAnyProbeGivesTheSameBits) {
  const test::TempDir dir;
  FakeSource source;
  source.reflected = {[](const vec3& p, const vec3& d) { return vec3(2 + glm::dot(p, d), 1, 0.5f); }};
  const ProbeSet start = places(four_places, 0.2f, 3);
  const auto whole = probes_to_binary(bake_now(source, start, small()));
  const auto checkpoint = dir / "out.checkpoint";
  for (int stop = 0; stop < 8; ++stop) {
    // The work ends at cube `stop` (four of GEN, then four of VIZ), as after a kill.
    int cubes = 0;
    source.on_cube = [&] {
      if (cubes++ == stop) throw Cancelled();
    };
    BakeReport report;
    EXPECT_THROW(bake(source, start, small(), checkpoint, report), Cancelled);
    ASSERT_TRUE(std::filesystem::exists(checkpoint));
    source.on_cube = [&] { ++cubes; };
    cubes = 0;
    const ProbeSet resumed = bake(source, start, small(), checkpoint, report);
    EXPECT_EQ(cubes, 8 - stop) << "finished cubes are not traced again";
    EXPECT_EQ(report.resumed, static_cast<std::size_t>(stop));
    EXPECT_EQ(probes_to_binary(resumed), whole);
    std::filesystem::remove(checkpoint);
  }
}

TEST(Bake, ACheckpointCutOffAnywhereOrOfAnotherBakeIsNotTrusted) {
  const test::TempDir dir;
  const auto checkpoint = dir / "out.checkpoint";
  FakeSource source;
  source.reflected = {constant(vec3(1, 2, 3))};
  const ProbeSet start = places({four_places.begin(), four_places.begin() + 2}, 0.2f, 0);
  const auto whole = probes_to_binary(bake_now(source, start, small(4, 1)));
  int cubes = 0;
  const auto stop_at = [&](int stop) {
    cubes = 0;
    source.on_cube = [&cubes, stop] {
      if (cubes++ == stop) throw Cancelled();
    };
  };
  BakeReport report;
  stop_at(3);
  EXPECT_THROW(bake(source, start, small(4, 1), checkpoint, report), Cancelled);
  stop_at(-1);
  std::ifstream in(checkpoint, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  ASSERT_GT(bytes.size(), 100u);
  for (std::size_t size = 0; size < bytes.size(); size += 5) {
    std::ofstream(checkpoint, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
    EXPECT_EQ(probes_to_binary(bake(source, start, small(4, 1), checkpoint, report)), whole) << size;
  }
  // Other parameters: nothing is taken over.
  std::ofstream(checkpoint, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bake(source, start, small(4, 2), checkpoint, report);
  EXPECT_EQ(report.resumed, 0u);
}

TEST(Bake, ACheckpointThatCannotBeWrittenIsAnError) {
  const FakeSource source;
  BakeReport report;
  EXPECT_THROW(bake(source, places(four_places, 0.2f, 1), small(4, 1), "/nonexistent/folder/file", report),
               Error);
}

TEST(Bake, ProgressReachesTheTotalAndACancelStops) {
  struct Recorder final : Progress {
    std::vector<std::string> stages;
    std::uint64_t total = 0, done = 0;
    void begin(const std::string& stage, std::uint64_t t, const std::string& unit) override {
      stages.push_back(stage + " " + unit);
      total = t, done = 0;
    }
    void advance(std::uint64_t n) override { done += n; }
    void end() override {}
  } progress;
  FakeSource source;
  source.reflected = {constant(vec3(1))};
  CancelToken cancel;
  BakeReport report;
  bake(source, places(four_places, 0.2f, 1), small(), {}, report, {&progress, &cancel});
  EXPECT_THAT(progress.stages, testing::ElementsAre("GEN texels", "VIZ texels"));
  EXPECT_EQ(progress.total, 4u * 6 * 16 * 16);
  EXPECT_EQ(progress.done, progress.total);
  cancel.request();
  EXPECT_THROW(bake(source, places(four_places, 0.2f, 1), small(), {}, report, {&progress, &cancel}),
               Cancelled);
}

}  // namespace
}  // namespace ssphh::gi
