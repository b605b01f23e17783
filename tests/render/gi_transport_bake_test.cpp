/// Sets whose light surfel transport found, through Embree, against closed forms and against the session.

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/solve.h>

#include "error_message.h"
#include "transport_baked.h"
#include "transport_fixtures.h"

namespace ssphh {
namespace {

using test::transport_baked;
using test::TransportBaked;

TEST(GiTransportBake, TheClosedBoxHoldsTheWholeGeometricSeries) {
  // Emission 1 and albedo 1/2 everywhere: 1 is seen directly, 1/2 + 1/4 + ... = 1 is reflected.
  bake::TransportBakeParams params;
  params.solve.tolerance = 1e-5f;
  const TransportBaked baked = transport_baked(scene::make_builtin("box"), 3, params);
  for (const probes::Probe& probe : baked.set.probes) {
    ASSERT_EQ(probe.groups.size(), 1u);
    EXPECT_NEAR(double(sh::mean(probe.groups[0].emitted).y), 1, 2e-3);  // emissions are kept to 1 in 512
    // Rows of links add up to 1 to float's precision; direct light of an emissive mesh is an estimate.
    EXPECT_NEAR(double(sh::mean(probe.groups[0].reflected).y), 1, 1e-2) << probe.name;
    // A constant has no other band; 384 directions find that to a share of their spacing.
    for (std::size_t k = 1; k < probe.self.values.size(); ++k)
      EXPECT_NEAR(double(probe.self.values[k].y), 0, 0.02 * double(probe.self.values[0].y)) << k;
  }
  EXPECT_NEAR(baked.report.contraction, 0.5, 1e-3) << "one bounce keeps the albedo's share";
  EXPECT_GT(baked.report.iterations, 2);
  EXPECT_GT(baked.report.surfels, 100u);
  EXPECT_GT(baked.report.links, baked.report.surfels);
  EXPECT_LE(baked.report.links, baked.report.surfels * static_cast<std::size_t>(params.transport.link_rays));
  EXPECT_EQ(baked.report.finest_surfel, baked.set.generator.surfel_size);
  EXPECT_GE(baked.report.coarsest_surfel, baked.report.finest_surfel);
  EXPECT_EQ(baked.report.lost, 0) << "every ray in a closed box ends at a surfel";
  EXPECT_GT(baked.report.rays, 384u * baked.set.probes.size());
  EXPECT_THAT(baked.report.warnings, testing::IsEmpty());
}

TEST(GiTransportBake, TheSetTellsHowItWasMade) {
  bake::TransportBakeParams params;
  params.transport.directions = 200;
  params.transport.link_rays = 32;
  params.transport.surfels_per_radius = 8;
  const scene::Scene scene = scene::make_builtin("box");
  const probes::GeneratorInfo g = transport_baked(scene, 2, params).set.generator;
  EXPECT_EQ(g.op, probes::LightOperator::surfel);
  EXPECT_EQ(g.directions, 200);
  EXPECT_EQ(g.link_rays, 32);
  EXPECT_GT(g.surfel_size, 0) << "as resolved, not 0 for automatic";
  EXPECT_EQ(g.scene_hash, scene::light_hash(scene));
}

TEST(GiTransportBake, GroupsAddUpToTheLightOfAll) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  bake::TransportBakeParams params;
  params.transport.link_rays = 32, params.transport.surfel_size = 0.3f;
  params.solve.tolerance = 1e-5f;
  const probes::ProbeSet set = transport_baked(scene, 2, params).set;
  ASSERT_GT(set.light_groups.size(), 1u);

  const trace::TransportScene source(scene);
  std::vector<scene::ProbePlace> places;
  for (const probes::Probe& probe : set.probes) places.push_back({probe.name, probe.position, probe.radius});
  transport::RelightParams relight{params.transport, params.solve};
  relight.degree = 2;
  relight.transport.surfel_size = set.generator.surfel_size;
  test::LitSession session(source, places, relight);
  session.update();
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const sh::RadianceSh emitted = session.emitted(static_cast<int>(i));
    const double level = double(set.probes[i].self.values[0].y);
    for (std::size_t k = 0; k < emitted.values.size(); ++k) {
      // Each solution is right to the tolerance, divided by 1 - contraction.
      EXPECT_NEAR(double(set.probes[i].reflected.values[k].y), double(session.reflected()[i].values[k].y),
                  1e-3 * level);
      EXPECT_NEAR(double(set.probes[i].self.values[k].y),
                  double((session.reflected()[i].values[k] + emitted.values[k]).y), 1e-3 * level);
    }
  }
}

/// By a session of the set's parameters, lit as the scene is.
probes::FittedPoints fitted_by_session(const scene::Scene& scene, const probes::ProbeSet& set,
                                       const transport::FitParams& params) {
  const trace::TransportScene source(scene);
  std::vector<scene::ProbePlace> places;
  for (const probes::Probe& probe : set.probes) places.push_back({probe.name, probe.position, probe.radius});
  transport::RelightParams same;
  same.transport.directions = set.generator.directions;
  same.transport.surfel_size = set.generator.surfel_size;
  same.transport.link_rays = set.generator.link_rays;
  test::LitSession session(source, places, same);
  session.update();
  const transport::TransportNetwork& network = session.network();
  return transport::fit_weights(network, source, transport::surfel_points(network), params,
                                session.direct_by_group());
}

TEST(GiTransportBake, FittedPointsAreThoseOfASessionOfTheSameParameters) {
  const scene::Scene scene = scene::make_builtin("box");
  bake::TransportBakeParams params;
  params.fit = true;
  params.fit_params.probes = 3;
  params.transport.surfel_size = 0.2f;
  const probes::ProbeSet set = transport_baked(scene, 2, params).set;
  ASSERT_TRUE(set.fitted);

  EXPECT_EQ(*set.fitted, fitted_by_session(scene, set, params.fit_params));
  int most = 0;
  for (const probes::PointWeights& weights : set.fitted->weights) most = std::max(most, weights.count);
  EXPECT_EQ(most, 3);
}

TEST(GiTransportBake, ItsRaysAreThoseThatItHasTracedItself) {
  set_log_level(LogLevel::error);  // that rays are few
  const scene::Scene scene = scene::make_builtin("box");
  bake::TransportBakeParams params;
  params.viz = true;
  params.transport.surfel_size = 0.5f, params.transport.directions = 32, params.transport.link_rays = 8;
  const trace::TransportScene source(scene);
  probes::ProbeSet set = place::init_from_scene(scene, 1);
  std::uint64_t traced = 0;
  bake::TransportBakeReport report;
  const auto expect_new_rays = [&](const char* by) {
    EXPECT_EQ(report.rays, source.rays_traced() - traced) << by;
    EXPECT_GT(report.rays, 0u) << by;
    traced = source.rays_traced();
  };
  for (int time = 0; time < 2; ++time) {
    set = bake::bake_transport(source, set, params, report);
    expect_new_rays("bake");
    bake::add_transport(source, set, params, report);
    expect_new_rays("what is added");
    bake::update_transport(source, set, params, {}, 0, report);
    expect_new_rays("update");
  }
}

TEST(GiTransportBake, WeightsFitBesidePathTracedLight) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  probes::ProbeSet set = place::init_from_scene(scene, 1);
  bake::TransportBakeReport report;
  bake::TransportBakeParams params;
  params.fit = true;
  params.transport.surfel_size = 0.25f;
  ASSERT_FALSE(params.viz);
  bake::add_transport(source, set, params, report);
  for (const probes::Probe& probe : set.probes) EXPECT_TRUE(probe.edges.empty()) << "nobody asked for VIZ";
  ASSERT_TRUE(set.fitted);
  EXPECT_EQ(*set.fitted, fitted_by_session(scene, set, params.fit_params))
      << "to the scene's own lights, too";
  EXPECT_EQ(set.generator.op, probes::LightOperator::path);
  EXPECT_GT(set.generator.directions, 0);
  bake::BakeParams paths;
  paths.face_size = 4;
  paths.path.spp = 1;
  paths.viz = false;
  bake::BakeReport path_report;
  const trace::PathTracer tracer(scene);
  const probes::ProbeSet baked = bake::bake(tracer, set, paths, {}, path_report);
  EXPECT_EQ(baked.fitted, set.fitted);
}

TEST(GiTransportBake, VizStandsBesideTheLightAndKeepsIt) {
  const scene::Scene scene = scene::make_builtin("box");
  bake::TransportBakeParams params;
  params.transport.surfel_size = 0.4f;
  const probes::ProbeSet lit = transport_baked(scene, 2, params).set;
  bake::BakeParams viz;
  viz.keep_light = true;
  viz.face_size = 4;
  viz.path.spp = 2;
  bake::BakeReport report;
  const trace::PathTracer tracer(scene);
  probes::ProbeSet both = bake::bake(tracer, lit, viz, {}, report);
  EXPECT_GT(probes::edge_count(both), 0u);
  EXPECT_EQ(both.generator.op, probes::LightOperator::surfel);
  for (std::size_t i = 0; i < both.probes.size(); ++i) EXPECT_EQ(both.probes[i].groups, lit.probes[i].groups);

  probes::ProbeSet other = lit;
  other.light_groups[0].name = "another lamp";
  EXPECT_THROW(bake::bake(tracer, other, viz, {}, report), Error);
}

TEST(GiTransportBake, WhatIsWrongIsNamed) {
  const scene::Scene scene = scene::make_builtin("box");
  set_log_level(LogLevel::error);  // that the room behind the shut door is dark
  const trace::TransportScene source(scene);
  bake::TransportBakeReport report;
  EXPECT_THROW(bake::bake_transport(source, {}, {}, report), Error);
  bake::TransportBakeParams params;
  params.transport.directions = 0;
  EXPECT_THROW(bake::bake_transport(source, place::init_from_scene(scene, 1), params, report), Error);

  const scene::Scene cornell = scene::make_builtin("cornell");
  probes::ProbeSet buried = place::init_from_scene(cornell, 1);
  buried.probes[1].position = {0.33f, 0.2f, 0.3f};  // in the shorter block
  buried.probes[1].name = "buried";
  buried.probes[2].position = {-3, 1, 0};  // outside, where few directions meet the wall's back
  params.transport.directions = 64, params.transport.link_rays = 16, params.transport.surfel_size = 0.2f;
  bake::bake_transport(trace::TransportScene(cornell), buried, params, report);
  EXPECT_THAT(report.warnings,
              testing::Contains(testing::AllOf(testing::HasSubstr("1 probe seems to lie inside a body"),
                                               testing::EndsWith(": \"buried\""))));
}

bake::TransportBakeReport report_of(const scene::Scene& scene, bake::TransportBakeParams params) {
  set_log_level(LogLevel::error);  // that the room behind the shut door is dark
  params.transport.directions = 64, params.transport.link_rays = 16;
  if (params.transport.surfel_size == 0) params.transport.surfel_size = 0.4f;
  return transport_baked(scene, 1, params).report;
}

TEST(GiTransportBake, WarningsCountTheProbesAndNameTheFirstFive) {
  scene::Scene dark = test::coloured_room(vec3(0));
  const std::string four = "4 probes receive no light at all: \"middle\", \"low\", \"corner\", \"wall\"";
  EXPECT_THAT(report_of(dark, {}).warnings, testing::ElementsAre(four));
  test::add_sphl(dark, "fifth", {0.2f, 0, 0});
  EXPECT_THAT(report_of(dark, {}).warnings, testing::ElementsAre("5" + four.substr(1) + ", \"fifth\""));
  test::add_sphl(dark, "sixth", {0.4f, 0, 0});
  EXPECT_THAT(report_of(dark, {}).warnings, testing::ElementsAre("6" + four.substr(1) + ", \"fifth\", ..."));
}

TEST(GiTransportBake, LightThatDoesNotConvergeIsAnErrorWithItsBounces) {
  bake::TransportBakeParams params;
  params.solve = {1e-9f, 2};
  const auto message = [&] {
    return test::message_of([&] { report_of(test::coloured_room(vec3(1)), params); });
  };
  EXPECT_THAT(message(), testing::StartsWith("light of surfels: did not converge in 2 bounces"));
  params.op = probes::LightOperator::bounce;
  params.bounce.max_iterations = 3, params.bounce.tolerance = 1e-9f;
  EXPECT_THAT(message(), testing::StartsWith("light between the probes: did not converge in 3 bounces"));
  params.bounce = {};
  const double kept = report_of(test::coloured_room(vec3(1)), params).contraction;
  EXPECT_GT(kept, 0.1);
  EXPECT_LT(kept, 0.8) << "of the brightest wall";
}

TEST(GiTransportBake, WhiteRoomsHaveTheLightOfAllBounces) {
  // Emission 1 everywhere: Σ ρᵏ = ρ / (1 − ρ) is reflected; no surface reflects more than 0.999.
  for (const float albedo : {0.995f, 0.999f, 1.0f}) {
    scene::Scene box = scene::make_builtin("box");
    for (scene::Material& material : box.materials) material.base_color = vec3(albedo);
    bake::TransportBakeParams params;
    params.transport.directions = 64, params.transport.surfel_size = 0.4f;
    const TransportBaked baked = transport_baked(box, 1, params);
    const double kept = double(std::min(albedo, transport::most_albedo)), all = kept / (1 - kept);
    for (const probes::Probe& probe : baked.set.probes)
      EXPECT_NEAR(double(sh::mean(probe.groups[0].reflected).y), all, 2e-2 * all)
          << albedo << " " << probe.name;
    EXPECT_LE(baked.report.error, 1e-3f);
    EXPECT_LT(baked.report.iterations, 1500);
  }
}

/// A body whose slats stand closer to each other than light is looked for before a surface of it.
TEST(GiTransportBake, LostLightIsToldInPercentOfTheRays) {
  scene::Scene room = test::coloured_room(vec3(0.5f));
  for (int i = 0; i < 20; ++i) {
    const vec3 foot(0.04f * static_cast<float>(i) - 0.9f, -0.9f, -0.8f);
    test::add_body(room, "slat", scene::make_quad(foot, {0, 0, 1.6f}, {0.085f, 0.085f, 0}), vec3(0.5f));
    if (i > 0) room.instances.back().node = room.instances[room.instances.size() - 2].node;
  }
  room.animations.push_back({"still",
                             {{room.instances.back().node,
                               scene::AnimationPath::translation,
                               scene::Interpolation::linear,
                               {0, 1},
                               {vec4(0), vec4(0)}}}});
  scene::validate(room);
  const bake::TransportBakeReport report = report_of(room, {});
  ASSERT_GT(report.lost, 0.01);
  ASSERT_LT(report.lost, 0.5);
  EXPECT_THAT(report.warnings,
              testing::ElementsAre(testing::StartsWith(
                  fmt::format("{:.1f} % of the surfels' rays end where no surfel is", 100 * report.lost))));
}

TEST(GiTransportBake, SurfelsAreAThirtySecondOfTheRadiusAndAtMostHalfAMetre) {
  // A room of ±1 m has the radius √3 m.
  const auto size_of = [](float scale) {
    scene::Scene room = test::coloured_room(vec3(1));
    for (scene::Mesh& mesh : room.meshes)
      for (vec3& p : mesh.positions) p *= scale;
    const trace::TransportScene source(room);
    probes::ProbeSet set = place::init_from_scene(room, 0);
    set.probes.resize(1);
    bake::TransportBakeParams params;
    params.transport.directions = 16, params.transport.link_rays = 4, params.transport.samples = 1;
    params.viz = true;
    bake::TransportBakeReport report;
    bake::add_transport(source, set, params, report);
    return set.generator.surfel_size;
  };
  EXPECT_FLOAT_EQ(size_of(0.01f), 0.01f * std::sqrt(3.0f) / 32);
  EXPECT_FLOAT_EQ(size_of(1), std::sqrt(3.0f) / 32);
  EXPECT_EQ(size_of(9.5f), 0.5f);
  EXPECT_EQ(size_of(1000), 0.5f) << "one probe";
  // A session's own are a twentieth.
  const auto session_size = [](float scale, float apart = 0) {
    scene::Scene room = test::coloured_room(vec3(1));
    for (scene::Mesh& mesh : room.meshes)
      for (vec3& p : mesh.positions) p *= scale;
    const trace::TransportScene source(room);
    transport::TransportParams params;
    params.directions = 16, params.link_rays = 4, params.samples = 1;
    std::vector<vec3> places{vec3(0)};
    if (apart > 0) places.emplace_back(apart, 0, 0);
    return transport::TransportNetwork(source, places, params).params().surfel_size;
  };
  EXPECT_FLOAT_EQ(session_size(0.01f), 0.01f * std::sqrt(3.0f) / 20);
  EXPECT_FLOAT_EQ(session_size(1), std::sqrt(3.0f) / 20);
  EXPECT_EQ(session_size(6), 0.5f);
  // As the probes stand dense: a quarter of their distance up to half a metre, then an eighth less that.
  EXPECT_EQ(session_size(1000, 1), 0.25f);
  EXPECT_EQ(session_size(1000, 7), 0.5f);
  EXPECT_EQ(session_size(1000, 40), 4.5f);
  EXPECT_FLOAT_EQ(session_size(1000, 900), 1000 * std::sqrt(3.0f) / 20) << "a twentieth is less";
}

TEST(GiTransportBake, TheNumberOfThreadsChangesNoBit) {
  set_log_level(LogLevel::error);  // that the room behind the shut door is dark
  const scene::Scene scene = scene::make_builtin("two-rooms");
  bake::TransportBakeParams params;
  params.transport.link_rays = 16;
  params.transport.surfel_size = 0.5f;
  params.fit = true;
  set_thread_count(1);
  const auto one = probes::probes_to_binary(transport_baked(scene, 3, params).set);
  set_thread_count(0);
  EXPECT_EQ(probes::probes_to_binary(transport_baked(scene, 3, params).set), one);
}

}  // namespace
}  // namespace ssphh
