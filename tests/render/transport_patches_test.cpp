/// Light and colour that differ within a surfel: its patches tell them apart, whatever its size.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/gather_light.h>
#include <ssphh/transport/network.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

/// Nothing is glossy here.
class NoGloss final : public rays::IndirectLight {
 public:
  vec3 irradiance(const rays::SurfacePoint&) const override { return vec3(0); }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return vec3(0); }
};

/// What the points get of light that was reflected, by surfels of `size` and by path tracing.
struct Beside {
  vec3 ours{0}, truth{0}, variance{0};  ///< of the truth

  /// `rays` of a point for ours, a quarter as many paths for the truth.
  Beside(const scene::Scene& scene, std::span<const rays::SurfacePoint> points, float size, int rays = 4096) {
    const trace::TransportScene source(scene);
    transport::RelightParams params;
    params.transport = {.directions = 1024, .surfel_size = size, .link_rays = 256};
    LitSession session(source, places_of(scene), params);
    session.update();
    const transport::GatherLight light(session, rays, std::make_shared<const NoGloss>());
    for (const rays::SurfacePoint& point : points) ours += light.irradiance(point);
    for (const rays::IrradianceEstimate& e : trace::PathTracer(scene).surface_irradiance(
             points, {.max_depth = 24, .passes = 1, .spp = rays / 4}, {}))
      truth += e.indirect, variance += e.indirect_variance;
  }
};

std::vector<rays::SurfacePoint> on_floor(float y) {
  std::vector<rays::SurfacePoint> points;
  for (const float x : {-0.7f, -0.2f, 0.3f, 0.8f}) {
    for (const float z : {-0.6f, 0.1f, 0.7f}) points.push_back({{x, y, z}, {0, 1, 0}});
  }
  return points;
}

TEST(TransportPatches, ALampCloseUnderTheCeilingLightsTheRoomAsBrightAsItDoes) {
  // Nine tenths of what the lamp sends up falls on a disc of 0.24 m, a fifth of a surfel's area.
  double sum = 0, truth = 0;
  vec3 variance(0);
  for (int i = 0; i < 64; ++i) {
    const vec2 at = 1.4f * vec2(glm::fract(0.7549f * static_cast<float>(i)),
                                glm::fract(0.5698f * static_cast<float>(i))) -
                    0.7f;
    const vec3 place(at.x, 0.92f, at.y);
    scene::Scene scene = coloured_room(vec3(0));
    scene::Light lamp;
    lamp.intensity = 10;
    scene.nodes.emplace_back().local.translation = place;
    lamp.node = static_cast<int>(scene.nodes.size()) - 1;
    scene.lights.push_back(lamp);
    scene::validate(scene);
    const Beside beside(scene, on_floor(-1), 0.5f, 2048);
    sum += double(luminance(beside.ours)), truth += double(luminance(beside.truth));
    variance += beside.variance;
  }
  EXPECT_LT(double(luminance(glm::sqrt(variance))), 0.01 * truth)
      << "a quarter of what is asked for is the truth's own noise";
  EXPECT_NEAR(sum / truth, 1, 0.04);
}

TEST(TransportPatches, WhatALampThrowsOnTheRoofJustAboveItReturnsThoughSurfelsAreLarge) {
  // Most of it lies within a hand's breadth of the lamp, and surfels may be wider than the lamp, as large
  // halls have them. Where their points happen to lie, they find 0.96 to 1.09 of the light of small ones;
  // where they stand wherever rays arrive, 1.00 to 1.20, 1.077 in the mean.
  scene::Scene scene;
  scene.nodes.emplace_back();
  add_body(scene, "hall", scene::flipped(scene::make_box({-3, 0, -8}, {3, 4, 8})), vec3(0.5f));
  add_body(scene, "lamp", scene::make_box({-0.5f, 3.85f, -0.5f}, {0.5f, 3.95f, 0.5f}), vec3(0), vec3(10));
  for (const float z : {-6.0f, -2.0f, 2.0f, 6.0f}) add_sphl(scene, fmt::format("at {}", z), {0.5f, 1.5f, z});
  const trace::TransportScene source(scene);
  std::vector<rays::SurfacePoint> floor;
  for (int i = 0; i < 24; ++i)
    floor.push_back(
        {{static_cast<float>(i % 4) - 1.5f, 0, 2.5f * static_cast<float>(i / 4) - 6.3f}, {0, 1, 0}});
  const auto light_of = [&](float size) {
    transport::RelightParams params;
    params.transport = small_network();
    params.transport.surfel_size = size;
    LitSession session(source, places_of(scene), params);
    session.update();
    const std::vector<transport::Irradiance4> total = session.patch_irradiance();
    float sum = 0;
    for (const std::int32_t patch : session.network().gather(floor, 2048))
      if (patch != transport::no_patch)
        sum += session.network().albedo()[static_cast<std::size_t>(patch)].y *
               total[static_cast<std::size_t>(patch)].y;
    return sum;
  };
  const float fine = light_of(0.25f);
  float mean = 0;
  for (int i = 0; i < 12; ++i) {
    const float size = 1.2f + 0.1f * static_cast<float>(i), ratio = light_of(size) / fine;
    EXPECT_NEAR(ratio, 1, 0.12f) << size;
    mean += ratio / 12;
  }
  EXPECT_NEAR(mean, 1, 0.04f);
}

TEST(TransportPatches, AWallOfTwoColoursGlowsInEachWhereItIs) {
  // The floor's halves meet within a row of surfels; a shelf close above each half sees little else.
  scene::Scene scene = coloured_room(vec3(1));
  add_body(scene, "half", scene::make_quad({-0.13f, -0.999f, 1}, {1.13f, 0, 0}, {0, 0, -2}),
           {0.9f, 0.05f, 0.05f});
  scene::validate(scene);
  for (const float x : {-0.53f, -0.43f, -0.33f, -0.23f, 0.07f, 0.17f, 0.27f}) {
    std::vector<rays::SurfacePoint> points;
    for (const float z : {-0.6f, -0.1f, 0.4f, 0.7f}) points.push_back({{x, -0.93f, z}, {0, -1, 0}});
    const Beside beside(scene, points, 0.4f);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(beside.ours[c] / beside.truth[c], 1, 0.1f) << "channel " << c << " at x = " << x;
  }
}

}  // namespace
}  // namespace ssphh::test
