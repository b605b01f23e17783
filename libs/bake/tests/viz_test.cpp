#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/sh/reconstruct.h>

#include "bake_helpers.h"
#include "root_4pi.h"

namespace ssphh::bake {
namespace {

using test::FakeSource;

using test::root_4pi;

TEST(Viz, ASphereInEmptySpaceIsSeenUnderItsSolidAngle) {
  // ∫H dω = 2π(1 − √(1 − (r/d)²)), and P is its share of the sphere.
  const float r = 0.5f, d = 2;
  const FakeSource source;
  BakeParams params = test::small(32, 16);
  params.viz_params.source = probes::VizSource::radiance;
  const probes::ProbeSet set = test::bake_now(source, test::places({{0, 0, 0}, {d, 0, 0}}, r, 4), params);
  ASSERT_EQ(set.probes[0].edges.size(), 1u);
  const probes::Edge& edge = set.probes[0].edges[0];
  EXPECT_EQ(edge.from, 1);
  const double omega = 2 * pi_d * (1 - std::sqrt(1 - r * r / (d * d)));
  // Only the rim's texels vary: about 60 of them with 16 jittered samples each, standard error below 0.5 %.
  EXPECT_NEAR(edge.h[0].x * root_4pi, omega, 0.02 * omega);
  EXPECT_NEAR(edge.transfer, omega / (4 * pi_d), 0.02 * omega / (4 * pi_d));
  // It is seen toward +x.
  EXPECT_GT(sh::eval(edge.h, {1, 0, 0}).x, 5 * std::abs(sh::eval(edge.h, {-1, 0, 0}).x));
}

TEST(Viz, ASphereOfIntensityOneHasPOfOneOver4PiD2WhateverItsRadius) {
  // I/d² = 1/d² is its irradiance across a small distance; over all directions 1/(4π d²). Closer up the disc
  // counts 1 + (r/2d)² of that.
  const float d = 2;
  const FakeSource source;
  for (const float r : {0.4f, 0.2f}) {
    const probes::ProbeSet set =
        test::bake_now(source, test::places({{0, 0, 0}, {d, 0, 0}}, r, 2), test::small(64, 64));
    const double p = 1 / (4 * pi_d * d * d) * (1 + std::pow(r / (2 * d), 2));
    // About 900 texels of 24576 lie along the smaller rim's cube, 64 jittered samples each: below 0.5 %.
    EXPECT_NEAR(set.probes[0].edges[0].transfer, p, 0.02 * p) << r;
  }
}

TEST(Viz, SymmetricGeometryHasSymmetricTransfer) {
  const FakeSource source;
  const probes::ProbeSet set =
      test::bake_now(source, test::places({{0, 0, 0}, {1, 1, 0}, {3, 0, -1}}, 0.3f, 2), test::small(32, 16));
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(set.probes[i].edges.size(), 2u);
    for (const probes::Edge& edge : set.probes[i].edges) {
      const probes::Probe& other = set.probes[edge.from];
      const auto back = std::find_if(other.edges.begin(), other.edges.end(),
                                     [&](const probes::Edge& e) { return e.from == static_cast<int>(i); });
      ASSERT_NE(back, other.edges.end());
      // The farthest sphere covers about 50 texels; 6 % is over four standard errors of its rim.
      EXPECT_NEAR(edge.transfer, back->transfer, 0.06f * back->transfer);
    }
  }
}

TEST(Viz, BehindAWallThereIsNoEdge) {
  FakeSource source;
  source.free = [](const vec3& a, const vec3& b) { return (a.x < 1) == (b.x < 1); };
  const probes::ProbeSet set =
      test::bake_now(source, test::places({{0, 0, 0}, {0.5f, 1, 0}, {2, 0, 0}}, 0.2f, 2), test::small(32, 4));
  ASSERT_EQ(set.probes[0].edges.size(), 1u);
  EXPECT_EQ(set.probes[0].edges[0].from, 1);
  EXPECT_TRUE(set.probes[2].edges.empty());
}

TEST(Viz, MatrixOfAnIsotropicEmitterIsTheMeanOperator) {
  const FakeSource source;
  BakeParams params = test::small(16, 4);
  params.viz_params.matrix = true;
  params.viz_params.source = probes::VizSource::radiance;
  probes::ProbeSet set = test::bake_now(source, test::places({{0, 0, 0}, {1, 0, 0}}, 0.4f, 3), params);
  const probes::Edge& edge = set.probes[0].edges[0];
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
  probes::merge_groups(set);
  probes::hier(set, {probes::HierOperator::matrix, -1, 0});
  const vec3 away = set.hierarchy->neighbor[0][0];
  set.probes[1].groups[0].reflected[3] *= -1.0f;
  probes::merge_groups(set);
  probes::hier(set, {probes::HierOperator::matrix, -1, 0});
  const vec3 toward = set.hierarchy->neighbor[0][0];
  // Seen under up to 24°, so that 1 + x is up to 0.09 there and 1 − x at least 1.91.
  EXPECT_LT(away.x, 0.09f / 1.91f * toward.x);
}

}  // namespace
}  // namespace ssphh::bake
