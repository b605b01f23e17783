/// RelightSession over Embree: closed boxes, what changes and what does not, shut doors, errors, threads.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/relight_session.h>

#include "transport_fixtures.h"
#include "unruly_source.h"

namespace ssphh::test {
namespace {

using transport::RelightParams;
using transport::RelightReport;
using transport::RelightSession;

RelightParams small_session(bool warm_start = true) {
  RelightParams params;
  params.transport = small_network();
  params.degree = 2;
  params.warm_start = warm_start;
  return params;
}

struct TwoRooms {
  scene::Scene scene = scene::make_builtin("two-rooms");
  trace::TransportScene source{scene};
  std::vector<scene::ProbePlace> places = places_of(scene);
};

TEST(RelightSession, AClosedBoxOfEqualWallsReachesTheGeometricSeries) {
  for (const float rho : {0.2f, 0.5f, 0.8f, 0.95f}) {
    scene::Scene scene = scene::make_builtin("box");
    for (scene::Material& material : scene.materials) material.base_color = vec3(rho);
    const trace::TransportScene source(scene);
    RelightParams params = small_session();
    params.solve.tolerance = 1e-4f;
    LitSession session(source, places_of(scene), params);
    EXPECT_TRUE(session.update().solve.converged);
    // What the solver leaves: its tolerance over one minus the contraction, which here is ρ.
    // Probes keep albedo in 10 bits: an error of 5e-4 changes ρ/(1 − ρ) by that over ρ(1 − ρ).
    const float left = 1e-4f / (1 - rho) + 5e-4f / (rho * (1 - rho));
    const float indirect = pi * rho / (1 - rho);
    for (std::size_t p = 0; p < session.patch_direct().size(); ++p) {
      const std::size_t s = session.network().surfel_of(p);
      for (glm::length_t c = 0; c < 3; ++c) {
        // All directions are as bright: sampling adds rounding alone.
        EXPECT_NEAR(session.patch_direct()[p][c], pi, 1e-4f);
        EXPECT_NEAR(session.surfel_irradiance()[s][c] / indirect, 1, left) << rho;
      }
    }
    // A probe sees Le itself, and Le ρ/(1 − ρ) by reflection: emission is not in both.
    for (int i = 0; i < static_cast<int>(session.places().size()); ++i) {
      const auto probe = static_cast<std::size_t>(i);
      EXPECT_NEAR(session.reflected()[probe][0].y / (root_4pi * rho / (1 - rho)), 1, left + 5e-4f / rho);
      EXPECT_NEAR(session.emitted(i)[0].y / root_4pi, 1, 1e-5f);
    }
  }
}

/// Both rooms: largest irradiance on the walls of each, and largest L0 of its probes.
struct RoomLight {
  double walls[2] = {}, probes[2] = {};

  explicit RoomLight(const transport::RelightSession& session) {
    const transport::TransportNetwork& network = session.network();
    const std::vector<transport::Irradiance4> irradiance = session.patch_irradiance();
    for (std::size_t s = 0; s < network.patch_count(); ++s) {
      if (!network.sample_used()[s]) continue;
      const rays::SurfacePoint& p = network.samples()[s];
      const vec3 x = p.position + 1e-3f * p.normal;
      if (!(x.y > 0) || !(x.y < 3) || !(std::abs(x.z) < 2)) continue;
      // The shut leaf stands at 0.075 < x < 0.115.
      const int room = x.x < -0.075f && x.x > -4.075f ? 0 : x.x > 0.115f && x.x < 4.075f ? 1 : -1;
      if (room < 0) continue;
      const vec3 e(irradiance[s]);
      walls[room] = std::max(walls[room], double(max_component(e)));
    }
    for (std::size_t i = 0; i < session.places().size(); ++i) {
      double& largest = probes[session.places()[i].position.x < 0 ? 0 : 1];
      largest = std::max(largest, double(max_component(session.reflected()[i][0])));
    }
  }
};

TEST(RelightSession, NoLightPassesAShutDoor) {
  const TwoRooms rooms;
  for (const float size : {0.25f, 0.5f}) {
    RelightParams params = small_session(false);
    params.transport.surfel_size = size;
    LitSession session(rooms.source, rooms.places, params, 1);
    session.update();
    const RoomLight open(session);
    EXPECT_GT(open.walls[1], 0.05 * open.walls[0] / 4) << "door open";
    EXPECT_GT(open.probes[1], 0.01 * open.probes[0]);
    session.state.time = 0;
    session.update();
    const RoomLight shut(session);
    EXPECT_GT(shut.walls[0], 0.5 * open.walls[0]);
    // From darkness, with no link across: not a single bit of light.
    EXPECT_EQ(shut.walls[1], 0) << "surfels of " << size << " m";
    EXPECT_EQ(shut.probes[1], 0);
  }
}

TEST(RelightSession, WhatAWarmStartLeavesBehindAShutDoorIsBelowItsTolerance) {
  const TwoRooms rooms;
  LitSession session(rooms.source, rooms.places, small_session(), 1);
  session.update();
  session.state.time = 0;
  session.update();
  const RoomLight shut(session);
  EXPECT_LT(shut.walls[1], 1e-5 * shut.walls[0]);
  EXPECT_LT(shut.probes[1], 1e-5 * shut.probes[0]);
}

TEST(RelightSession, AWarmStartEndsWhereAColdOneDoes) {
  const TwoRooms rooms;
  RelightParams warm = small_session(), cold = small_session(false);
  warm.solve.tolerance = cold.solve.tolerance = 1e-4f;
  LitSession a(rooms.source, rooms.places, warm, 0.4f), b(rooms.source, rooms.places, cold, 0.4f);
  a.update();
  b.update();
  scene::LightState lamp = a.state.lights[0];
  int warm_iterations = 0, cold_iterations = 0;
  for (int frame = 0; frame < 5; ++frame) {
    lamp.world[3].x += 0.06f;
    for (LitSession* session : {&a, &b}) {
      session->state.lights[0] = lamp;
      session->state.time = 0.4f + 0.03f * static_cast<float>(frame);
    }
    warm_iterations += a.update().solve.iterations;
    cold_iterations += b.update().solve.iterations;
  }
  EXPECT_LT(warm_iterations, cold_iterations);
  // A residual of at most 1.001 · tolerance · the largest E leaves that over 1 − (largest albedo 0.8), since
  // rows sum to 1; twice, for two answers.
  float largest = 0, difference = 0;
  for (std::size_t s = 0; s < a.surfel_irradiance().size(); ++s) {
    const vec3 e(a.surfel_irradiance()[s]), f(b.surfel_irradiance()[s]);
    largest = std::max(largest, max_component(f));
    difference = std::max(difference, max_component(glm::abs(e - f)));
  }
  EXPECT_LT(difference, 2 * 1.001f * 1e-4f * largest / (1 - 0.8f));
  EXPECT_GT(difference, 0) << "otherwise nothing was warm";
}

TEST(RelightSession, ColdBitsTellNothingOfThePast) {
  const TwoRooms rooms;
  const RelightParams params = small_session(false);
  sh::RadianceSh glow(1);
  glow[0] = vec3(3), glow[3] = vec3(1);
  const auto set_up = [&](LitSession& session) {
    scene::LightState lamp = session.state.lights[0];
    lamp.world[3] = vec4(-1.5f, 2, -0.7f, 1);
    lamp.intensity = 5;
    session.state.lights[0] = lamp;
    session.state.group_scales[0] = vec3(0.7f, 1, 1.2f);
    session.shine(1, {});
    session.shine(3, glow);
  };
  LitSession walked(rooms.source, rooms.places, params, 1);
  walked.update();
  for (const float time : {0.2f, 0.0f, 0.9f}) {
    walked.state.time = time;
    scene::LightState lamp = walked.state.lights[0];
    lamp.world[3].z -= 0.1f;
    walked.state.lights[0] = lamp;
    walked.shine(1, time > 0.5f ? glow : sh::RadianceSh());
    walked.update();
  }
  set_up(walked);
  walked.update();
  // Last the door alone: light is found anew only where it may have changed.
  walked.state.time = 0.45f;
  walked.update();

  LitSession fresh(rooms.source, rooms.places, params, 0.45f);
  set_up(fresh);
  fresh.update();
  EXPECT_TRUE(walked.patch_direct() == fresh.patch_direct());
  EXPECT_TRUE(walked.surfel_irradiance() == fresh.surfel_irradiance());
  EXPECT_TRUE(walked.reflected() == fresh.reflected());
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(walked.emitted(i) == fresh.emitted(i)) << i;
}

TEST(RelightSession, NothingChangedCostsNothing) {
  const TwoRooms rooms;
  LitSession session(rooms.source, rooms.places, small_session(), 0.5f);
  EXPECT_EQ(session.update().changed_probes.size(), rooms.places.size()) << "the first update lights all";
  session.state.lights[0] = session.state.lights[0];
  session.state.time = 0.5f;
  session.state.group_scales[0] = vec3(1);
  session.shine(2, {});
  const std::uint64_t before = rooms.source.rays_traced();
  const RelightReport still = session.update();
  EXPECT_EQ(rooms.source.rays_traced(), before);
  EXPECT_EQ(still.total_ms(), 0);
  EXPECT_EQ(still.solve.iterations, 0);
  EXPECT_EQ(still.hits_changed, 0u);
  EXPECT_TRUE(still.changed_probes.empty());
}

TEST(RelightSession, DimmingScalesWithoutARay) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  const trace::TransportScene source(scene);
  RelightParams params = small_session(false);
  params.transport.surfel_size = 0.7f;
  LitSession session(source, places_of(scene), params);
  session.update();
  const std::vector<sh::RadianceSh> full = session.reflected();
  const std::size_t groups = source.light_groups().size();
  ASSERT_GE(groups, 2u);

  // A quarter of everything: a power of two scales to the bit.
  const std::uint64_t before = source.rays_traced();
  for (std::size_t g = 0; g < groups; ++g) session.state.group_scales[g] = vec3(0.25f);
  const RelightReport report = session.update();
  EXPECT_EQ(source.rays_traced(), before);
  EXPECT_EQ(report.changed_probes.size(), full.size());
  for (std::size_t i = 0; i < full.size(); ++i) {
    sh::RadianceSh quarter = full[i];
    quarter *= vec3(0.25f);
    EXPECT_TRUE(session.reflected()[i] == quarter) << i;
  }

  // Any scales: the sum over groups, but for the tolerance of each solve (1e-3 / (1 − 0.78), see above).
  std::vector<vec3> scales;
  for (std::size_t g = 0; g < groups; ++g) {
    scales.push_back(vec3(0.3f + 0.5f * static_cast<float>(g), 1, 0.2f));
    session.state.group_scales[g] = scales[g];
  }
  session.update();
  const auto by_group = session.reflected_by_group();
  ASSERT_EQ(by_group.size(), groups);
  for (std::size_t i = 0; i < full.size(); ++i) {
    sh::RadianceSh sum(2);
    for (std::size_t g = 0; g < groups; ++g) {
      sh::RadianceSh part = by_group[g][i];
      part *= scales[g];
      sum += part;
    }
    for (int k = 0; k < 9; ++k) {
      for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(session.reflected()[i][k][c], sum[k][c], 5e-3f * sum[0][c]) << i << " " << k;
    }
  }

  for (std::size_t g = 0; g < groups; ++g) session.state.group_scales[g] = vec3(0);
  session.update();
  for (const sh::RadianceSh& dark : session.reflected()) EXPECT_TRUE(dark == sh::RadianceSh(2));
}

TEST(RelightSession, SameBitsForAnyNumberOfThreads) {
  const TwoRooms rooms;
  std::vector<std::vector<sh::RadianceSh>> results;
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    LitSession session(rooms.source, rooms.places, small_session(), 1);
    session.update();
    session.state.time = 0.6f;
    scene::LightState lamp = session.state.lights[0];
    lamp.world[3].x -= 0.3f;
    session.state.lights[0] = lamp;
    session.update();
    results.push_back(session.reflected());
    for (int i = 0; i < 6; ++i) results.back().push_back(session.emitted(i));
  }
  set_thread_count(0);
  EXPECT_TRUE(results[0] == results[1]);
}

TEST(RelightSession, ErrorsSayWhatIsWrong) {
  const TwoRooms rooms;
  EXPECT_THROW(RelightSession(rooms.source, {}), Error);
  RelightParams few = small_session();
  few.transport.directions = 4;
  EXPECT_THROW(RelightSession(rooms.source, rooms.places, few), Error);

  LitSession session(rooms.source, rooms.places, small_session());
  session.update();
  const std::vector<sh::RadianceSh> before = session.reflected();
  const auto refuses = [&](const auto& spoil) {
    scene::LightingState state = session.lighting();
    spoil(state);
    EXPECT_THROW(session.update(state), Error);
  };
  refuses([](auto& s) { s.lights.clear(); });
  refuses([](auto& s) { s.lights.resize(2); });
  refuses([](auto& s) { s.group_scales.clear(); });
  refuses([](auto& s) { s.lights[0].world[3].y = NAN; });
  refuses([](auto& s) { s.lights[0].color.x = INFINITY; });
  refuses([](auto& s) { s.lights[0].intensity = NAN; });
  refuses([](auto& s) { s.lights[0].intensity = -1; });
  refuses([](auto& s) { s.group_scales[0] = vec3(1, -0.1f, 1); });
  refuses([](auto& s) { s.group_scales[0] = vec3(NAN); });
  refuses([](auto& s) { s.time = NAN; });
  for (const int probe : {-1, 6, 99}) refuses([&](auto& s) { s.emission = {{probe, sh::RadianceSh(0)}}; });
  sh::RadianceSh broken(1);
  broken[2] = vec3(0, INFINITY, 0);
  refuses([&](auto& s) { s.emission = {{0, broken}}; });
  // What was refused leaves no trace.
  EXPECT_TRUE(session.update().changed_probes.empty());
  EXPECT_TRUE(session.reflected() == before);
}

TEST(RelightSession, WhatIsCancelledIsDoneByTheNextUpdate) {
  const TwoRooms rooms;
  LitSession session(rooms.source, rooms.places, small_session(false)),
      other(rooms.source, rooms.places, small_session(false));
  session.update();
  const std::vector<sh::RadianceSh> before = session.reflected();
  for (LitSession* s : {&session, &other}) s->state.time = 0.7f, s->state.lights[0].intensity *= 2;
  CancelToken cancel;
  cancel.request();
  const std::uint64_t rays = rooms.source.rays_traced();
  EXPECT_THROW(session.update(session.state, {nullptr, &cancel}), Cancelled);
  EXPECT_EQ(rooms.source.rays_traced(), rays) << "it goes on with nothing, not to the end of the door's way";
  EXPECT_TRUE(session.reflected() == before);
  session.update();
  other.update();
  EXPECT_TRUE(session.reflected() == other.reflected());
}

// The first time it fails when the door has been posed, but not lit: the next one finds the door where it is
// to be.
TEST(RelightSession, LightsADoorAnewThatWasMovedInVain) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const std::vector<scene::ProbePlace> places = places_of(scene);
  UnrulySource source(scene);
  LitSession session(source, places, small_session(false)), other(source, places, small_session(false));
  session.update(), other.update();
  session.state.time = other.state.time = 0.6f;
  source.gives_direct_light = false;
  EXPECT_THROW(session.update(), Error);
  source.gives_direct_light = true;
  session.update(), other.update();
  EXPECT_TRUE(session.patch_direct() == other.patch_direct());
  EXPECT_TRUE(session.reflected() == other.reflected());
}

TEST(RelightSession, IsMovedWithItsLight) {
  const TwoRooms rooms;
  RelightSession first(rooms.source, rooms.places, small_session());
  first.update(first.lighting());
  const std::vector<sh::RadianceSh> light = first.reflected();
  RelightSession second = std::move(first);
  EXPECT_TRUE(second.reflected() == light);
  EXPECT_TRUE(second.update(second.lighting()).changed_probes.empty());
  EXPECT_THROW(first.reflected(), Error) << "it holds nothing any more";
  first = std::move(second);
  scene::LightingState open = first.lighting();
  open.time = 1;
  EXPECT_FALSE(first.update(open).changed_probes.empty());
}

TEST(RelightSession, AProbeThatSeesNothingIsDarkAmongOthersThatSee) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  std::vector<scene::ProbePlace> places = places_of(scene);
  places.push_back({"lost", {0, 1000, 0}});
  EXPECT_THROW(RelightSession(source, {places.back()}), Error) << "alone it has nothing to show";
  LitSession session(source, places, small_session());
  session.update();
  EXPECT_TRUE(session.reflected().back() == sh::RadianceSh(2));
  EXPECT_GT(session.reflected().front()[0].y, 0);
}

}  // namespace
}  // namespace ssphh::test
