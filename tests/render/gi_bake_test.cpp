/// GEN, VIZ and HIER through the path tracer, on scenes with analytic answers.

#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

#include "root_4pi.h"
#include "z_test.h"

namespace ssphh {
namespace {

using test::root_4pi;

probes::ProbeSet bake(const scene::Scene& scene, int degree, const bake::BakeParams& params, float time = 0) {
  const trace::PathTracer tracer(scene, time);
  bake::BakeReport report;
  return bake::bake(tracer, place::init_from_scene(scene, degree, time), params, {}, report);
}

bake::BakeParams effort(int face, int spp, int max_depth) {
  bake::BakeParams params;
  params.face_size = face;
  params.path.spp = spp;
  params.path.max_depth = max_depth;
  return params;
}

/// A scene with SPHLs and nothing else.
scene::Scene empty_space(const std::vector<vec3>& positions, float radius) {
  scene::Scene scene;
  for (const vec3& position : positions) {
    scene::Sphl sphl;
    sphl.name = "SPHL" + std::to_string(scene.sphls.size());
    sphl.node = static_cast<int>(scene.nodes.size());
    sphl.radius = radius;
    scene.sphls.push_back(sphl);
    scene.nodes.emplace_back().local.translation = position;
  }
  return scene;
}

void silence_warnings() {
  set_log_level(LogLevel::error);
}

TEST(GiBake, ClosedBoxGivesEachDepthsRadianceInBandZeroAndNothingElse) {
  // Every wall emits Le = 1 and has albedo ½: depth 0 is 1, depths 1..3 add ½ + ¼ + ⅛, from every direction.
  const scene::Scene scene = scene::make_builtin("box");
  const trace::PathTracer tracer(scene);
  const probes::ProbeSet places = place::init_from_scene(scene, 3);
  ASSERT_GE(places.probes.size(), 4u);
  std::vector<test::Samples> reflected(16);
  for (int seed = 0; seed < 40; ++seed) {
    bake::BakeParams params = effort(4, 4, 3);
    params.viz = false;
    params.path.seed = static_cast<std::uint64_t>(seed);
    bake::BakeReport report;
    const probes::ProbeSet set = bake::bake(tracer, places, params, {}, report);
    EXPECT_NEAR(set.probes[1].self[0].y - set.probes[1].reflected[0].y, root_4pi, 1e-4f)
        << "emitters have no noise";
    for (std::size_t k = 0; k < reflected.size(); ++k)
      reflected[k].add(double(set.probes[1].reflected.values[k].y));
  }
  const test::Significance significance{1e-3, 16};
  // Float sums of 96 texels: 1e-5.
  EXPECT_TRUE(test::mean_is(reflected[0], 0.875 * double(root_4pi), significance, 1e-5));
  for (std::size_t k = 1; k < reflected.size(); ++k)
    EXPECT_TRUE(test::mean_is(reflected[k], 0, significance, 1e-5)) << k;
}

TEST(GiBake, TwoProbesInEmptySpaceSeeTheSolidAngle) {
  silence_warnings();
  for (const float d : {1.0f, 3.0f, 20.0f}) {
    const float r = 0.25f;
    bake::BakeParams params = effort(32, 16, 3);
    params.viz_params.source = probes::VizSource::radiance;
    const probes::ProbeSet set = bake(empty_space({{0, 0, 0}, {0, d, 0}}, r), 2, params);
    const double omega = 2 * pi_d * (1 - std::sqrt(1 - double(r) * r / (double(d) * d)));
    for (const probes::Probe& probe : set.probes) {
      ASSERT_EQ(probe.edges.size(), 1u);
      // A large ball is found by rays through texels: its rim is noise below 1 %; a small one is sampled
      // exactly.
      EXPECT_NEAR(double(probe.edges[0].h[0].x * root_4pi), omega, 0.01 * omega) << d;
      EXPECT_NEAR(double(probe.edges[0].transfer), omega / (4 * pi_d), 0.01 * omega / (4 * pi_d)) << d;
    }
  }
}

TEST(GiBake, AMatrixOverAllEmissionDirectionsIsTheResponse) {
  silence_warnings();
  scene::Scene scene = scene::make_builtin("cornell");
  scene.sphls.resize(3);
  bake::BakeParams params = effort(8, 4, 2);
  params.viz_params.matrix = true;
  params.viz_params.source = probes::VizSource::radiance;
  const probes::ProbeSet set = bake(scene, 2, params);
  std::size_t edges = 0;
  for (const probes::Probe& probe : set.probes) {
    for (const probes::Edge& edge : probe.edges) {
      // T[0, 0] = Y00² ∫L dω and H[0] = Y00 ∫L dω, of the same paths: only the order of the sum differs.
      EXPECT_NEAR(edge.matrix.values[0].x, edge.h[0].x / root_4pi, 1e-4f * edge.h[0].x);
      ++edges;
    }
  }
  EXPECT_EQ(edges, 6u);
}

TEST(GiBake, AShutDoorLetsNothingThroughAndAnOpenOneDoes) {
  silence_warnings();
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const auto in_b = [](const probes::Probe& probe) { return probe.position.x > 0.1f; };
  for (const float time : {0.0f, 1.0f}) {
    const probes::ProbeSet set = bake(scene, 2, effort(16, 4, 4), time);
    int across = 0, within = 0, lit_in_b = 0;
    for (const probes::Probe& probe : set.probes) {
      for (const probes::Edge& edge : probe.edges) {
        ++(in_b(probe) != in_b(set.probes[edge.from]) ? across : within);
      }
      lit_in_b += in_b(probe) && probe.self[0].x > 0;
    }
    EXPECT_EQ(within, 3 * 2 + 3 * 2);
    if (time == 0) {
      EXPECT_EQ(across, 0);
      EXPECT_EQ(lit_in_b, 0);
    } else {
      EXPECT_EQ(across, 2 * 9);
      EXPECT_EQ(lit_in_b, 3);
    }
  }
}

TEST(GiBake, DimmingALightGroupEqualsABakeWithADimmerLamp) {
  silence_warnings();
  scene::Scene scene = scene::make_builtin("two-rooms");
  bake::BakeParams params = effort(8, 4, 3);
  params.viz = false;
  probes::ProbeSet dimmed = bake(scene, 2, params, 1);
  ASSERT_EQ(dimmed.light_groups.size(), 1u);
  probes::relight(dimmed, dimmed.light_groups[0].name, vec3(0.5f));
  scene.lights[0].intensity *= 0.5f;
  const probes::ProbeSet baked = bake(scene, 2, params, 1);
  for (std::size_t i = 0; i < baked.probes.size(); ++i) {
    for (int k = 0; k < 9; ++k) {
      // The same paths with half the light; halving is exact up to the order of roundings.
      EXPECT_LT(glm::length(dimmed.probes[i].self[k] - baked.probes[i].self[k]), 1e-5f) << i << " " << k;
    }
  }
}

TEST(GiBake, GroupsAddUpToAllLights) {
  silence_warnings();
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].name = "second";
  scene.lights[1].group = "second";
  scene.lights[1].color = {0.2f, 0.4f, 1};
  scene.lights[1].node = scene.sphls[1].node;
  bake::BakeParams params = effort(8, 4, 3);
  params.viz = false;
  const probes::ProbeSet apart = bake(scene, 2, params, 1);
  scene.lights[0].group = scene.lights[1].group = "all";
  const probes::ProbeSet together = bake(scene, 2, params, 1);
  ASSERT_EQ(apart.light_groups.size(), 2u);
  ASSERT_EQ(together.light_groups.size(), 1u);
  for (std::size_t i = 0; i < together.probes.size(); ++i) {
    EXPECT_GT(glm::length(apart.probes[i].groups[1].reflected[0]), 0.0f);
    for (int k = 0; k < 9; ++k) {
      // The same paths, summed in another order.
      EXPECT_LT(glm::length(apart.probes[i].self[k] - together.probes[i].self[k]), 1e-4f) << i << " " << k;
    }
  }
}

TEST(GiBake, TheNumberOfThreadsChangesNoBit) {
  silence_warnings();
  const scene::Scene scene = scene::make_builtin("cornell");
  bake::BakeParams params = effort(8, 2, 2);
  params.viz_params.matrix = true;
  std::vector<std::vector<std::byte>> files;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    probes::ProbeSet set = bake(scene, 3, params);
    probes::hier(set, {probes::HierOperator::matrix});
    files.push_back(probes::probes_to_binary(set));
  }
  set_thread_count(0);
  EXPECT_EQ(files[0], files[1]);
}

}  // namespace
}  // namespace ssphh
