/// Direct light of every kind of emitter on a Lambertian floor, against closed forms.

#include <gtest/gtest.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

constexpr float albedo = 0.6f;

scene::Scene floor_scene() {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(albedo)));
  return scene;
}

/// Radiance that leaves the floor at the origin, depth 1.
Samples radiance_at_origin(const scene::Scene& scene, int spp = 16) {
  return pixels_of(render(scene, view_point(vec3(0), spp, 1)).color);
}

TEST(DirectLight, PointLightGivesIntensityCosineOverSquaredDistance) {
  scene::Scene scene = floor_scene();
  add_light(scene, scene::LightType::point, 50, vec3(3, 4, 0));
  const double d2 = 25, cosine = 4.0 / 5;
  // No random choice but the position in the 1 mm view: 1e-3/5 relative.
  EXPECT_TRUE(mean_is(radiance_at_origin(scene, 1), 50 * cosine / d2 * albedo / pi_d, {}, 2e-5));
}

TEST(DirectLight, SunGivesItsIrradianceTimesCosine) {
  scene::Scene scene = floor_scene();
  add_light(scene, scene::LightType::directional, 3, vec3(0), vec3(-1, -1, 0));
  EXPECT_TRUE(mean_is(radiance_at_origin(scene, 1), 3 * std::sqrt(0.5) * albedo / pi_d, {}, 1e-6));
}

TEST(DirectLight, SunDiscGivesTheSameIrradianceAsADeltaSun) {
  scene::Scene scene = floor_scene();
  add_light(scene, scene::LightType::directional, 3, vec3(0), vec3(-1, -1, 0)).angular_radius = 0.1f;
  EXPECT_TRUE(mean_is(radiance_at_origin(scene), 3 * std::sqrt(0.5) * albedo / pi_d, {}, 1e-5));
}

TEST(DirectLight, SpotFallsOffBetweenItsCones) {
  // KHR_lights_punctual: ((cos θ − cos outer)/(cos inner − cos outer))².
  for (const float angle : {0.05f, 0.3f, 0.45f, 0.6f}) {
    scene::Scene scene = floor_scene();
    const vec3 position(0, 2, 0);
    scene::Light& spot =
        add_light(scene, scene::LightType::spot, 20, position, vec3(std::sin(angle), -std::cos(angle), 0));
    spot.inner_cone = 0.2f, spot.outer_cone = 0.5f;
    const double c = std::cos(angle), inner = std::cos(0.2f), outer = std::cos(0.5f);
    const double falloff = std::pow(std::clamp((c - outer) / (inner - outer), 0.0, 1.0), 2);
    // The 1 mm view sees the angle vary by 2.5e-4 about its mean.
    EXPECT_TRUE(mean_is(radiance_at_origin(scene, 4), 20 * falloff / 4 * albedo / pi_d, {1e-3, 4}, 2e-4))
        << angle;
  }
}

TEST(DirectLight, ParallelSquaresExchangeTheirFormFactor) {
  // Unit squares at distance 1: F = 0.199825 (Howell, C-11). Mean radiance over the receiver is ρ Le F.
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 0, -1)), lambertian(vec3(albedo)));
  add_object(scene, scene::make_quad(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1)),
             lambertian(vec3(0), vec3(2)), "lamp");
  Samples means;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    trace::RenderParams params = view_down(vec3(0.5f, 0, 0.5f), 1, 8);
    params.path = {1, 1, 4, seed};
    means.add(mean_of(render(scene, params).color));
  }
  EXPECT_TRUE(mean_is(means, albedo * 2 * 0.199825, {}, 1e-6));
}

TEST(DirectLight, PerpendicularSquaresExchangeTheirFormFactor) {
  // Unit squares with a common edge: F = 0.200044 (Howell, C-14).
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 0, -1)), lambertian(vec3(albedo)));
  add_object(scene, scene::make_quad(vec3(0, 0, 1), vec3(0, 0, -1), vec3(0, 1, 0)),
             lambertian(vec3(0), vec3(2)), "lamp");
  Samples means;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    trace::RenderParams params = view_down(vec3(0.5f, 0, 0.5f), 1, 8);
    params.path = {1, 1, 4, seed};
    means.add(mean_of(render(scene, params).color));
  }
  EXPECT_TRUE(mean_is(means, albedo * 2 * 0.200044, {}, 1e-6));
}

TEST(DirectLight, SphereLightGivesPiLTimesSquaredSineTimesCosine) {
  scene::Scene scene = floor_scene();
  add_light(scene, scene::LightType::sphere, 7, vec3(3, 4, 0)).radius = 0.5f;
  const double sin2 = 0.25 / 25, cosine = 4.0 / 5;
  EXPECT_TRUE(mean_is(radiance_at_origin(scene), pi_d * 7 * sin2 * cosine * albedo / pi_d, {}, 1e-5));
}

TEST(DirectLight, FlatLampsGiveTheirFormFactors) {
  // Along the axis of a disc F = r²/(r² + h²); a square seen from below a corner, sides as long as it is
  // high: F = 1/(2π) · 2/√2 · atan(1/√2) (Howell, B-3). One shines down, one along the floor's normal alone.
  scene::Scene disc = floor_scene();
  add_light(disc, scene::LightType::disc, 7, vec3(0, 2, 0)).radius = 0.5f;
  EXPECT_TRUE(mean_is(radiance_at_origin(disc), 7 * 0.25 / 4.25 * albedo, {}, 1e-4));
  scene::Scene square = floor_scene();
  add_light(square, scene::LightType::rectangle, 7, vec3(1, 2, 1)).size = vec2(2);
  const double factor = std::atan(1 / std::sqrt(2.0)) * std::sqrt(2.0) / (2 * pi_d);
  EXPECT_TRUE(mean_is(radiance_at_origin(square), 7 * factor * albedo, {}, 1e-4));
}

TEST(DirectLight, FlatLampsAreSeenFromTheirFrontAndHideNothing) {
  scene::Scene scene = floor_scene();
  add_light(scene, scene::LightType::rectangle, 5, vec3(0, 0.25f, 0), vec3(0, 1, 0)).size = {1, 2};
  const auto seen_from_above = [&] { return mean_of(render(scene, view_point(vec3(0), 4, 1)).color); };
  EXPECT_NEAR(seen_from_above(), 5, 1e-6) << "the floor under it is dark: the lamp shines away";
  scene.nodes.back().local.rotation = looking(vec3(0, -1, 0));
  const double floor = seen_from_above();
  EXPECT_LT(floor, 5 * albedo) << "its back is not there";
  EXPECT_GT(floor, 0.8 * 5 * albedo * 0.9);
  scene.lights[0].intensity = 0;
  EXPECT_EQ(seen_from_above(), 0);
}

TEST(DirectLight, ConstantSkyGivesAlbedoTimesItsRadiance) {
  scene::Scene scene = floor_scene();
  add_constant_sky(scene, vec3(1, 2, 3));
  const image::Image color = render(scene, view_point(vec3(0), 16, 1)).color;
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(mean_is(pixels_of(color, c), albedo * (c + 1), {1e-3, 3}, 1e-5));
}

TEST(DirectLight, SkyImageGivesTheCosineIntegralOfItsTexels) {
  // Upper hemisphere 1 at azimuths with x > 0, else 0: half of the irradiance of a full sky.
  scene::Scene scene = floor_scene();
  scene::Environment sky;
  sky.equirect = image::Image(64, 32);
  for (int y = 0; y < 32; ++y) {
    // u = ½ looks to +x.
    for (int x = 16; x < 48; ++x) sky.equirect.set_rgb(x, y, vec3(1));
  }
  scene.environment = sky;
  // The edge between bright and dark texels is blurred by the same amount on both sides.
  EXPECT_TRUE(mean_is(radiance_at_origin(scene, 64), 0.5 * albedo, {}, 1e-4));
}

TEST(DirectLight, ClosedLidLeavesNothing) {
  scene::Scene scene = floor_scene();
  add_object(scene, scene::make_box(vec3(-1, 1, -1), vec3(1, 1.2f, 1)), lambertian(vec3(0)), "lid");
  add_light(scene, scene::LightType::point, 50, vec3(0, 4, 0));
  EXPECT_EQ(radiance_at_origin(scene).mean(), 0);
}

TEST(DirectLight, AnUnlitSurfaceIsSeenButLightsNothing) {
  scene::Scene scene = floor_scene();
  add_object(scene, scene::make_box(vec3(-1, 1, -1), vec3(1, 1.2f, 1)), lambertian(vec3(5)), "sign");
  scene.materials.back().unlit = true;
  EXPECT_EQ(radiance_at_origin(scene).mean(), 0);
  // Looked at, it has its own colour.
  EXPECT_NEAR(pixels_of(render(scene, view_point(vec3(0, 1.2f, 0), 4, 1)).color).mean(), 5, 1e-4);
}

TEST(DirectLight, BackOfAOneSidedLampIsDark) {
  scene::Scene scene = floor_scene();
  add_object(scene, scene::make_quad(vec3(-1, 2, 1), vec3(2, 0, 0), vec3(0, 0, -2)),
             lambertian(vec3(0), vec3(5)), "lamp");
  EXPECT_EQ(radiance_at_origin(scene).mean(), 0);
  scene.materials.back().double_sided = true;
  EXPECT_GT(radiance_at_origin(scene).mean(), 0.1);
}

}  // namespace
}  // namespace ssphh::test
