/// A scene of a millimetre or of ten kilometres is baked as that of a few metres: radiance does not know how
/// long a metre is.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/log.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_set.h>

#include "transport_baked.h"
#include "transport_fixtures.h"

namespace ssphh {
namespace {

using test::transport_baked;
using test::TransportBaked;

/// All of the scene times `factor`, about the origin.
scene::Scene scaled(scene::Scene scene, float factor) {
  for (scene::Node& node : scene.nodes) {
    if (node.parent >= 0) continue;
    node.local.scale *= factor;
    node.local.translation *= factor;
  }
  for (scene::Sphl& sphl : scene.sphls) sphl.radius *= factor;
  return scene;
}

/// Largest difference of the probes' mean radiance in any channel, as a share of the mean.
double difference(const probes::ProbeSet& a, const probes::ProbeSet& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    const vec3 x = sh::mean(a.probes[i].self), y = sh::mean(b.probes[i].self);
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(double(x[c]) / double(y[c]) - 1));
  }
  return largest;
}

TEST(TransportScale, LightIsThatOfMetresInMillimetresAndInKilometres) {
  set_log_level(LogLevel::error);
  const scene::Scene cornell = scene::make_builtin("cornell");
  bake::TransportBakeParams params;
  params.transport.surfels_per_radius = 12;
  const TransportBaked metres = transport_baked(cornell, 3, params);
  for (const float factor : {1e-3f, 1e4f}) {
    const TransportBaked other = transport_baked(scaled(cornell, factor), 3, params);
    ASSERT_EQ(other.set.probes.size(), metres.set.probes.size());
    // Other voxels, other rays: the noise of a hundred link rays stays.
    EXPECT_LT(difference(other.set, metres.set), 0.02) << "times " << factor;
    EXPECT_LT(other.report.surfels, 8 * metres.report.surfels) << "times " << factor;
    EXPECT_GT(other.report.surfels, metres.report.surfels / 4) << "times " << factor;
  }
}

TEST(TransportScale, FewerSurfelsThanOneSizeWouldMakeHoldTheSameLight) {
  set_log_level(LogLevel::error);
  const scene::Scene scene = scene::make_builtin("two-rooms");
  bake::TransportBakeParams params;
  params.transport.surfel_size = 0.14f;
  params.transport.most_surfels = 1 << 20;
  const TransportBaked fine = transport_baked(scene, 3, params);
  params.transport.most_surfels = 2000;
  const TransportBaked coarse = transport_baked(scene, 3, params);
  EXPECT_LT(coarse.report.surfels, fine.report.surfels / 4);
  EXPECT_LT(difference(coarse.set, fine.set), 0.05);
}

TEST(TransportScale, FewSurfelsAreHalfAsLargeNearLampsUpToFourTimesAsWide) {
  set_log_level(LogLevel::error);
  const scene::Scene dark = test::coloured_room(vec3(0));
  scene::Scene lit = dark;
  test::add_body(lit, "lamp",
                 scene::flipped(scene::make_quad({-0.22f, 0.99f, -0.22f}, {0.45f, 0, 0}, {0, 0, 0.45f})),
                 vec3(0.5f), vec3(10));
  const auto finest = [](const scene::Scene& scene, float size, int most) {
    const trace::TransportScene source(scene);
    transport::TransportParams params = test::small_network();
    params.surfel_size = size;
    params.most_surfels = most;
    return transport::TransportNetwork(source, scene::positions_of(test::places_of(scene)), params)
        .surfels()
        .sizes()
        .finest();
  };
  EXPECT_FLOAT_EQ(finest(lit, 0.12f, 1000), 0.06f);
  EXPECT_FLOAT_EQ(finest(dark, 0.12f, 1000), 0.12f);
  EXPECT_FLOAT_EQ(finest(lit, 0.1f, 1000), 0.1f) << "more than four times as wide";
  EXPECT_FLOAT_EQ(finest(lit, 0.12f, 100000), 0.12f) << "of one size, there only lamps that are no wider";
}

}  // namespace
}  // namespace ssphh
