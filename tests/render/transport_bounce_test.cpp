/// `bounce` and blended poses over Embree, where the answer is known.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/gi/transport/bounce.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

TEST(Bounce, AClosedBoxOfEqualWallsReachesTheGeometricSeries) {
  for (const float rho : {0.3f, 0.8f, 0.95f}) {
    GlowingBox box(rho);
    gi::BounceParams params;
    params.tolerance = 1e-5f;
    params.max_iterations = 400;
    const gi::BounceOperator bounce(box.session.network(), box.source, 2, params);
    std::vector<sh::RadianceSh> reflected;
    const gi::BounceReport report = bounce.solve(box.session.surfel_direct(), reflected);
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
  gi::BounceParams params;
  params.applications = 1;
  const gi::BounceOperator bounce(box.session.network(), box.source, 2, params);
  std::vector<sh::RadianceSh> reflected;
  EXPECT_EQ(bounce.solve(box.session.surfel_direct(), reflected).iterations, 1);
  // D = Le ρ, and one bounce more Le ρ².
  for (const sh::RadianceSh& s : reflected) EXPECT_NEAR(s[0].y / root_4pi, 0.75f, 3e-3f);
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
