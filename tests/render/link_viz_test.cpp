/// VIZ from links over Embree: closed forms where nothing reflects, path tracing where everything does.

#include <algorithm>

#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/path_tracer.h>

#include "root_4pi.h"
#include "transport_fixtures.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

/// The box [−4, 4]³ without any reflection.
scene::Scene black_box() {
  scene::Scene scene;
  add_body(scene, "walls", scene::flipped(scene::make_box(vec3(-4), vec3(4))), vec3(0));
  return scene;
}

probes::ProbeSet with_edges(const scene::Scene& scene, int degree, const transport::LinkVizParams& viz = {},
                            float time = 0, const transport::TransportParams& transport = small_network()) {
  set_log_level(LogLevel::error);  // Dark rooms are meant here.
  bake::TransportBakeParams params;
  params.transport = transport;
  params.viz = true;
  params.viz_params = viz;
  bake::TransportBakeReport report;
  return bake::bake_transport(trace::TransportScene(scene), place::init_from_scene(scene, degree, time),
                              params, report);
}

const probes::Edge* edge(const probes::ProbeSet& set, std::size_t i, int from) {
  for (const probes::Edge& e : set.probes[i].edges) {
    if (e.from == from) return &e;
  }
  return nullptr;
}

TEST(LinkViz, WithoutReflectionASphereIsItsDisc) {
  scene::Scene scene = black_box();
  const float r = 0.25f;
  const std::vector<vec3> places = {{0, 0, 0}, {0, 1, 0}, {0, 0, 3}, {0.1f, 0.1f, 0}};
  for (const vec3& p : places) add_sphl(scene, "SPHL", p, r);
  const probes::ProbeSet set = with_edges(scene, 2, {.source = probes::VizSource::radiance});
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(set.probes[i].edges.size(), places.size() - 1);
    for (const probes::Edge& e : set.probes[i].edges) {
      const vec3 way = places[e.from] - places[i];
      const double sine = double(r) / double(glm::length(way));
      const double share = sine >= 1 ? 1 : (1 - std::sqrt(1 - sine * sine)) / 2;
      EXPECT_NEAR(double(e.transfer), share, 1e-5 * share) << i << " " << e.from;
      // Band 1 points at it: ∫ ω dω over the disc is π sin², over the whole sphere 0.
      const double along = sine >= 1 ? 0 : 0.48860251190292 * pi_d * sine * sine;
      const vec3 band1{e.h.values[3].x, e.h.values[1].x, e.h.values[2].x};
      EXPECT_LT(glm::distance(band1, float(along) * glm::normalize(way)), 1e-5 + 1e-5 * along);
    }
  }
}

TEST(LinkViz, WhatStandsInFrontHidesAsMuchOfTheSphereAsItCovers) {
  scene::Scene scene = black_box();
  // A screen halfway whose edge, seen from the origin, runs through the sphere's centre, or beside it.
  add_body(scene, "screen", scene::make_box({-3, 0, 1.49f}, {3, 3, 1.5f}), vec3(0));
  add_sphl(scene, "origin", {0, 0, 0}, 0.2f);
  add_sphl(scene, "half", {0, 0, 3}, 0.2f);
  add_sphl(scene, "whole", {0, -0.5f, 3}, 0.2f);
  add_sphl(scene, "hidden", {0, 0.5f, 3}, 0.2f);
  const probes::ProbeSet set = with_edges(scene, 1, {.source = probes::VizSource::radiance});
  const double sine = 0.2 / 3, share = (1 - std::sqrt(1 - sine * sine)) / 2;
  ASSERT_TRUE(edge(set, 0, 1));
  EXPECT_NEAR(double(edge(set, 0, 1)->transfer), share / 2, share / 16);  // one of 16 rays
  ASSERT_TRUE(edge(set, 0, 2));
  const double away = 0.2 / std::sqrt(9.25);
  EXPECT_NEAR(double(edge(set, 0, 2)->transfer), (1 - std::sqrt(1 - away * away)) / 2, 1e-6 * share);
  EXPECT_EQ(edge(set, 0, 3), nullptr);
}

TEST(LinkViz, AgreesWithTracedPathsInAClosedRoomOfColouredWalls) {
  const scene::Scene scene = coloured_room(vec3(0));
  transport::TransportParams fine = small_network();
  fine.directions = 1536, fine.surfel_size = 0.2f, fine.link_rays = 128;
  const probes::ProbeSet links = with_edges(scene, 1, {}, 0, fine);

  const trace::PathTracer tracer(scene);
  const std::size_t n = links.probes.size();
  std::vector<Samples> transfer(n * n), red(n * n);
  bake::BakeParams paths;
  paths.keep_light = true;
  paths.face_size = 8;
  paths.path.spp = 8;
  paths.path.max_depth = 24;  // 0.75^24 of the light is left
  for (int seed = 0; seed < 32; ++seed) {
    paths.path.seed = static_cast<std::uint64_t>(seed);
    bake::BakeReport report;
    const probes::ProbeSet traced = bake::bake(tracer, links, paths, {}, report);
    for (std::size_t i = 0; i < n; ++i) {
      for (const probes::Edge& e : traced.probes[i].edges) {
        transfer[i * n + static_cast<std::size_t>(e.from)].add(double(e.transfer));
        red[i * n + static_cast<std::size_t>(e.from)].add(double(e.h[0].x) / root_4pi_d);
      }
    }
  }
  const Significance significance{1e-3, static_cast<int>(2 * n * (n - 1))};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const probes::Edge* e = edge(links, i, static_cast<int>(j));
      ASSERT_TRUE(e) << i << " " << j;
      // Surfels of a tenth of the room, spheres' shadows by one ray, solved to a hundredth: 2.5 %.
      EXPECT_TRUE(
          mean_is(transfer[i * n + j], double(e->transfer), significance, 0.025 * double(e->transfer)))
          << i << " " << j;
      const double x = double(e->h[0].x) / root_4pi_d;
      EXPECT_TRUE(mean_is(red[i * n + j], x, significance, 0.025 * x)) << i << " " << j;
    }
  }
}

TEST(LinkViz, AShutDoorLetsExactlyNothingThroughAnOpenOneAsMuchAsTracedPaths) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const auto in_b = [](const probes::Probe& probe) { return probe.position.x > 0.1f; };
  for (const float time : {0.0f, 1.0f}) {
    const probes::ProbeSet set = with_edges(scene, 1, {}, time);
    double across = 0;
    int count_across = 0, count_within = 0;
    for (const probes::Probe& probe : set.probes) {
      for (const probes::Edge& e : probe.edges) {
        const bool crosses = in_b(probe) != in_b(set.probes[e.from]);
        ++(crosses ? count_across : count_within);
        if (crosses) across += double(e.transfer);
      }
    }
    EXPECT_EQ(count_within, 3 * 2 + 3 * 2);
    EXPECT_EQ(count_across, time == 0 ? 0 : 2 * 9);
    if (time == 0) continue;

    Samples traced_across;
    const trace::PathTracer tracer(scene, time);
    bake::BakeParams paths;
    paths.keep_light = true;
    paths.face_size = 8;
    paths.path.spp = 4;
    paths.path.max_depth = 24;
    for (int seed = 0; seed < 32; ++seed) {
      paths.path.seed = static_cast<std::uint64_t>(seed);
      bake::BakeReport report;
      double sum = 0;
      for (const probes::Probe& probe : bake::bake(tracer, set, paths, {}, report).probes) {
        for (const probes::Edge& e : probe.edges) {
          if (in_b(probe) != in_b(set.probes[e.from])) sum += double(e.transfer);
        }
      }
      traced_across.add(sum);
    }
    // Through a doorway 0.9 m wide that surfels of 0.4 m and 256 directions see coarsely.
    EXPECT_TRUE(mean_is(traced_across, across, {}, 0.06 * across));
  }
}

TEST(LinkViz, KeepsTheStrongestNeighboursOverTheThreshold) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  transport::TransportParams coarse = small_network();
  coarse.surfel_size = 1;  // the edges are compared with each other alone
  const auto edges = [&](const transport::LinkVizParams& viz) {
    return with_edges(scene, 1, viz, 0, coarse);
  };
  const probes::ProbeSet all = edges({.neighbors = -1});
  const probes::ProbeSet two = edges({.neighbors = 2});
  const probes::ProbeSet none = edges({.neighbors = 0});
  const float threshold = all.probes[0].edges[0].transfer;
  const probes::ProbeSet strong = edges({.neighbors = -1, .threshold = threshold});
  EXPECT_EQ(all.generator.viz, probes::VizMethod::links);
  EXPECT_EQ(probes::edge_count(none), 0u);
  for (std::size_t i = 0; i < all.probes.size(); ++i) {
    std::vector<int> best = probes::select_neighbors(all.probes[i], {.neighbors = 2});
    std::ranges::sort(best);
    ASSERT_EQ(two.probes[i].edges.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(two.probes[i].edges[k], all.probes[i].edges[best[k]]);
    std::size_t over = 0;
    for (const probes::Edge& e : all.probes[i].edges) over += e.transfer > threshold;
    EXPECT_EQ(strong.probes[i].edges.size(), over);
    EXPECT_TRUE(std::ranges::is_sorted(all.probes[i].edges, {}, &probes::Edge::from));
  }
  EXPECT_THROW(with_edges(scene, 1, {.neighbors = -2}), Error);
  EXPECT_THROW(with_edges(scene, 1, {.threshold = -0.5f}), Error);
}

TEST(LinkViz, TracedEdgesAreCutAlike) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  const trace::PathTracer tracer(scene);
  const probes::ProbeSet places = place::init_from_scene(scene, 1);
  bake::BakeParams params;
  params.face_size = 4;
  params.path.spp = 1;
  bake::BakeReport report;
  const probes::ProbeSet all = bake::bake(tracer, places, params, {}, report);
  params.viz_params.neighbors = 2;
  const probes::ProbeSet two = bake::bake(tracer, places, params, {}, report);
  EXPECT_EQ(all.generator.viz, probes::VizMethod::path);
  for (std::size_t i = 0; i < all.probes.size(); ++i) {
    std::vector<int> best = probes::select_neighbors(all.probes[i], {.neighbors = 2});
    std::ranges::sort(best);
    ASSERT_EQ(two.probes[i].edges.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(two.probes[i].edges[k], all.probes[i].edges[best[k]]);
  }
}

TEST(LinkViz, TheNumberOfThreadsChangesNoBit) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const auto bytes = [&] { return probes::probes_to_binary(with_edges(scene, 3, {.neighbors = 2}, 1)); };
  set_thread_count(1);
  const auto one = bytes();
  set_thread_count(0);
  EXPECT_EQ(bytes(), one);
}

}  // namespace
}  // namespace ssphh::test
