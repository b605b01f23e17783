/// `bounce`, blended poses and fitted lookups over Embree, where the answer is known.

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/gi/fitted_weights.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/gi/transport/bounce.h>
#include <ssphh/trace/path_tracer.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

constexpr float root_4pi = 3.5449077018110318f;

/// builtin:box, every wall with this albedo and Le = 1, lit.
struct GlowingBox {
  explicit GlowingBox(float rho)
      : scene(painted(rho)), source(scene), session(source, places_of(scene), params()) {
    session.update();
  }
  static scene::Scene painted(float rho) {
    scene::Scene box = scene::make_builtin("box");
    for (scene::Material& material : box.materials) material.base_color = vec3(rho);
    return box;
  }
  static gi::RelightParams params() {
    gi::RelightParams p;
    p.transport = small_network();
    p.degree = 2;
    return p;
  }

  scene::Scene scene;
  trace::TransportScene source;
  gi::RelightSession session;
};

TEST(Bounce, AClosedBoxOfEqualWallsReachesTheGeometricSeries) {
  for (const float rho : {0.3f, 0.8f}) {
    GlowingBox box(rho);
    gi::BounceParams params;
    params.tolerance = 1e-5f;
    const gi::BounceOperator bounce(box.session.network(), box.source, 2, params);
    std::vector<sh::RadianceSh> reflected;
    const gi::BounceReport report = bounce.solve(box.session.surfel_direct(), reflected);
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.contraction, double(rho), 0.01 * double(rho));
    EXPECT_GT(report.edges, reflected.size());
    // In a constant field every lookup is exact but for bands 1 and 2, which 256 directions leave at 1e-3.
    for (const sh::RadianceSh& s : reflected)
      EXPECT_NEAR(s[0].y / (root_4pi * rho / (1 - rho)), 1, 5e-3f) << rho;
  }
}

TEST(Bounce, OneApplicationAddsOneBounceToDirectLight) {
  GlowingBox box(0.5f);
  gi::BounceParams params;
  params.applications = 1;
  const gi::BounceOperator bounce(box.session.network(), box.source, 2, params);
  std::vector<sh::RadianceSh> reflected;
  EXPECT_EQ(bounce.solve(box.session.surfel_direct(), reflected).iterations, 1);
  // D = Le ρ, and one bounce more Le ρ².
  for (const sh::RadianceSh& s : reflected) EXPECT_NEAR(s[0].y / root_4pi, 0.75f, 3e-3f);
}

TEST(FittedLookup, ReproducesAConstantFieldEverywhere) {
  GlowingBox box(0.5f);
  const gi::FittedPoints fitted =
      gi::fit_weights(box.session.network(), box.source, gi::surfel_points(box.session.network()), {});
  gi::ProbeSet set;
  set.degree = 2;
  set.light_groups.push_back({"walls", vec3(1)});
  for (std::size_t i = 0; i < box.session.places().size(); ++i) {
    gi::Probe probe;
    probe.position = box.session.places()[i].position;
    probe.groups.push_back({{}, sh::RadianceSh(2)});
    probe.groups[0].reflected[0] = vec3(root_4pi);
    set.probes.push_back(probe);
  }
  gi::merge_groups(set);
  const trace::PathTracer tracer(box.scene);
  const gi::FittedLookup lookup(set, fitted, tracer);
  const scene::Bounds bounds = scene::world_bounds(box.scene, scene::world_matrices(box.scene));
  const Walls walls{bounds.min, bounds.max};
  Pcg32 rng(3);
  // Few probes cannot reproduce the training lights, so the weights' sums float: between these values E does.
  float low = 10, high = 0;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    float sum = 0;
    for (const gi::ProbeWeight& w : fitted.weights[i].used()) sum += w.weight;
    low = std::min(low, sum), high = std::max(high, sum);
  }
  for (int i = 0; i < 300; ++i) {
    const scene::SurfacePoint p = walls.at(i % 6, rng.uniform2());
    const float e = lookup.irradiance(p.position, p.normal).y / pi;
    EXPECT_GE(e, low * 0.999f);
    EXPECT_LE(e, high * 1.001f);
  }
  gi::FittedPoints wrong = fitted;
  wrong.weights[0].entries[0].probe = 99;
  wrong.weights[0].count = 1;
  EXPECT_THROW(gi::FittedLookup(set, wrong, tracer), Error);
}

/// Root mean square difference of band 0 in room B, relative.
double difference_in_room_b(const gi::RelightSession& a, const gi::RelightSession& b) {
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
  gi::RelightParams params;
  params.transport = small_network();
  params.degree = 1;
  params.warm_start = false;
  gi::RelightSession exact(source, places_of(scene), params);
  std::vector<double> errors;
  for (const int poses : {2, 5, 17}) {
    gi::RelightParams blended = params;
    blended.poses = poses;
    gi::RelightSession session(source, places_of(scene), blended);
    for (const float at_pose : {0.0f, 1.0f}) {
      session.set_time(at_pose);
      exact.set_time(at_pose);
      session.update();
      exact.update();
      EXPECT_EQ(session.reflected(), exact.reflected()) << poses << " at " << at_pose;
    }
    double worst = 0;
    for (const float between : {0.33f, 0.52f, 0.71f, 0.9f}) {
      session.set_time(between);
      exact.set_time(between);
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
  gi::RelightParams params;
  params.transport = small_network();
  params.poses = 1;
  EXPECT_THROW(gi::RelightSession(source, places_of(scene), params), Error);
}

}  // namespace
}  // namespace ssphh::test
