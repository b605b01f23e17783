/// `bounce` and blended poses over Embree, where the answer is known.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/relight_session.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

TEST(Bounce, AClosedBoxOfEqualWallsReachesTheGeometricSeries) {
  for (const float rho : {0.3f, 0.8f, 0.95f}) {
    GlowingBox box(rho);
    transport::BounceParams params;
    params.tolerance = 1e-5f;
    params.max_iterations = 400;
    transport::BounceOperator bounce(box.session.network(), box.source, 2, params);
    std::vector<sh::RadianceSh> reflected;
    const transport::BounceReport report = bounce.solve(box.session.patch_direct(), reflected);
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.contraction, double(rho), 0.01 * double(rho));
    EXPECT_GT(report.edges, reflected.size());
    // In a constant field every lookup is exact but for bands 1 and 2, which 256 directions leave at 1e-3,
    // the albedo's 10 bits, and what the iteration leaves. The last two are amplified by 1/(1 − ρ).
    const float left = 4e-3f + (5e-4f / rho + 1e-5f) / (1 - rho);
    for (const sh::RadianceSh& s : reflected)
      EXPECT_NEAR(s[0].y / (root_4pi * rho / (1 - rho)), 1, left) << rho;
  }
}

TEST(Bounce, OneApplicationAddsOneBounceToDirectLight) {
  GlowingBox box(0.5f);
  transport::BounceParams params;
  params.applications = 1;
  transport::BounceOperator bounce(box.session.network(), box.source, 2, params);
  std::vector<sh::RadianceSh> reflected;
  EXPECT_EQ(bounce.solve(box.session.patch_direct(), reflected).iterations, 1);
  // D = Le ρ, and one bounce more Le ρ².
  for (const sh::RadianceSh& s : reflected) EXPECT_NEAR(s[0].y / root_4pi, 0.75f, 3e-3f);
}

TEST(Bounce, LooksUpAnewOnlyWhereAPartMayComeBetween) {
  GlowingBox box(0.5f);
  EXPECT_EQ(transport::BounceOperator(box.session.network(), box.source, 2).update_pose(), 0u);
  // Of a door between two rooms hang the weights of what lies around it, whether it has moved or not.
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = small_network();
  params.degree = 1;
  const LitSession session(source, places_of(scene), params);
  const std::size_t rays = session.network().seen().size();
  transport::BounceOperator bounce(session.network(), source, 1);
  const std::size_t around = bounce.update_pose();
  EXPECT_GT(around, rays / 100);
  EXPECT_LT(around, rays / 2);
  EXPECT_EQ(bounce.update_pose(), around);
}

transport::RelightParams bounce_session() {
  transport::RelightParams params;
  params.transport = small_network();
  params.degree = 2;
  params.op = probes::LightOperator::bounce;
  params.warm_start = false;
  return params;
}

TEST(BounceSession, EqualsTheOperatorAndTheGeometricSeries) {
  GlowingBox box(0.5f);
  LitSession session(box.source, places_of(box.scene), bounce_session());
  const transport::RelightReport report = session.update();
  EXPECT_TRUE(report.solve.converged);
  EXPECT_GT(report.solve.iterations, 2);
  std::vector<sh::RadianceSh> reflected;
  transport::BounceOperator(session.network(), box.source, 2).solve(session.patch_direct(), reflected);
  EXPECT_EQ(session.reflected(), reflected);
  ASSERT_EQ(session.reflected_by_group().size(), 1u);
  EXPECT_EQ(session.reflected_by_group()[0], reflected);
  for (const sh::RadianceSh& s : reflected) EXPECT_NEAR(s[0].y / root_4pi, 1, 5e-3f);
  EXPECT_TRUE(session.update().changed_probes.empty()) << "nothing was set";
}

TEST(BounceSession, ADoorThatMovedEqualsASessionBuiltThere) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  LitSession moved(source, places_of(scene), bounce_session());
  moved.update();
  const std::vector<sh::RadianceSh> shut = moved.reflected();
  for (const float time : {0.6f, 1.0f, 0.25f}) {
    moved.state.time = time;
    moved.update();
    LitSession built(source, places_of(scene), bounce_session(), time);
    built.update();
    EXPECT_EQ(moved.reflected(), built.reflected()) << time;
    EXPECT_NE(moved.reflected(), shut) << time;
  }
}

TEST(BounceSession, AWarmStartComesToTheSameLightSooner) {
  GlowingBox box(0.8f);
  transport::RelightParams params = bounce_session();
  params.bounce.tolerance = 1e-5f;
  LitSession cold(box.source, places_of(box.scene), params);
  params.warm_start = true;
  LitSession warm(box.source, places_of(box.scene), params);
  warm.update();
  cold.state.group_scales[0] = vec3(1.05f);
  warm.state.group_scales[0] = vec3(1.05f);
  const int from_darkness = cold.update().solve.iterations;
  EXPECT_LT(warm.update().solve.iterations, from_darkness);
  // Both stop when a bounce changes 1e-5; what is left is that over 1 - 0.8.
  for (std::size_t i = 0; i < cold.reflected().size(); ++i)
    EXPECT_NEAR(warm.reflected()[i][0].y / cold.reflected()[i][0].y, 1, 1e-4f);
}

TEST(BounceSession, WhatItCannotDoIsRefused) {
  GlowingBox box(0.5f);
  transport::RelightParams params = bounce_session();
  LitSession session(box.source, places_of(box.scene), params);
  EXPECT_THROW(session.emission_profile(vec3(0), 0.1f, 1), Error);
  params.poses = 4;
  EXPECT_THROW(transport::RelightSession(box.source, places_of(box.scene), params), Error);
  params.poses = 0;
  params.op = probes::LightOperator::path;
  EXPECT_THROW(transport::RelightSession(box.source, places_of(box.scene), params), Error);
}

/// Root mean square difference of band 0 in room B, relative.
double difference_in_room_b(const transport::RelightSession& a, const transport::RelightSession& b) {
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < a.places().size(); ++i) {
    if (a.places()[i].position.x < 0.2f) continue;
    const double x = double(a.reflected()[i][0].y), y = double(b.reflected()[i][0].y);
    difference += (x - y) * (x - y);
    sum += x * x;
  }
  return std::sqrt(difference / sum);
}

TEST(BlendedPoses, EqualExactOnesAtThePreparedTimesAndComeCloserWithMore) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = small_network();
  params.degree = 1;
  params.warm_start = false;
  LitSession exact(source, places_of(scene), params);
  std::vector<double> errors;
  for (const int poses : {2, 5, 17}) {
    transport::RelightParams blended = params;
    blended.poses = poses;
    LitSession session(source, places_of(scene), blended);
    for (const float at_pose : {0.0f, 1.0f}) {
      session.state.time = at_pose;
      exact.state.time = at_pose;
      session.update();
      exact.update();
      EXPECT_EQ(session.reflected(), exact.reflected()) << poses << " at " << at_pose;
    }
    double worst = 0;
    for (const float between : {0.33f, 0.52f, 0.71f, 0.9f}) {
      session.state.time = between;
      exact.state.time = between;
      session.update();
      exact.update();
      worst = std::max(worst, difference_in_room_b(exact, session));
    }
    EXPECT_GT(session.network().pose_bytes(), 0u);
    errors.push_back(worst);
  }
  EXPECT_LT(errors[2], 0.7 * errors[1]);
  EXPECT_LT(errors[1], errors[0]);
}

TEST(BlendedPoses, OnePoseIsRefused) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = small_network();
  params.poses = 1;
  EXPECT_THROW(transport::RelightSession(source, places_of(scene), params), Error);
}

}  // namespace
}  // namespace ssphh::test
