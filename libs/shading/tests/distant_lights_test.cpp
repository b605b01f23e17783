#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>

#include "chi2.h"
#include "light_scenes.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using ssphh::test::mean_is;
using ssphh::test::Samples;

/// The only EmitterHit in a direction, or none.
std::optional<EmitterHit> hit(const LightSet& lights, const vec3& direction) {
  std::optional<EmitterHit> found;
  lights.escaped(direction, [&](const EmitterHit& h) { found = h; });
  return found;
}

/// A small image with a bright pixel, a dark half and a gradient.
image::Image uneven_sky() {
  image::Image sky(16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      sky.set_rgb(x, y, x < 8 ? vec3(0) : vec3(0.1f + 0.2f * static_cast<float>(y), 0.5f, 0.3f));
    }
  }
  sky.set_rgb(3, 2, vec3(40, 30, 20));
  return sky;
}

TEST(DirectionalLight, GivesItsIrradianceOnAFacingPlane) {
  scene::Scene scene;
  add_light(scene, LightType::directional, {0, 9, 0}, {1, -2, 0}).intensity = 3;
  const LightSet lights = make_lights(scene);
  const auto s = lights.sample(0, {5, 5, 5}, 0.5f, vec2(0.5f));
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->delta && std::isinf(s->distance));
  EXPECT_FLOAT_EQ(s->radiance.x / s->pdf, 3);
  EXPECT_NEAR(glm::dot(s->wi, glm::normalize(vec3(-1, 2, 0))), 1, 1e-6f);
  EXPECT_FALSE(hit(lights, s->wi)) << "rays cannot find it";
}

TEST(DirectionalLight, OfAScaledNodeIsTheSame) {
  for (const float angular_radius : {0.0f, 0.3f}) {
    scene::Scene plain;
    add_light(plain, LightType::directional, vec3(0), {1, -2, 3}).angular_radius = angular_radius;
    scene::Scene scaled = plain;
    scaled.nodes[scaled.lights[0].node].local.scale = {2, 0.5f, 4};
    const auto a = make_lights(plain).sample(0, vec3(0), 0.5f, vec2(0.3f, 0.6f)),
               b = make_lights(scaled).sample(0, vec3(0), 0.5f, vec2(0.3f, 0.6f));
    ASSERT_TRUE(a && b);
    EXPECT_LE(glm::distance(a->wi, b->wi), 1e-6f) << "a direction has the length 1";
    EXPECT_FLOAT_EQ(a->pdf, b->pdf);
    EXPECT_FLOAT_EQ(a->radiance.x, b->radiance.x);
  }
}

TEST(DirectionalLight, DiscGivesTheSameIrradiance) {
  for (const float angular_radius : {0.00465f, 0.3f, 1.2f}) {
    scene::Scene scene;
    auto& light = add_light(scene, LightType::directional, vec3(0), {1, -2, 0});
    light.intensity = 3, light.angular_radius = angular_radius;
    const LightSet lights = make_lights(scene);
    const vec3 to_light = glm::normalize(vec3(-1, 2, 0));
    EXPECT_TRUE(mean_is(irradiance(lights, vec3(0), to_light), 3, {}, 1e-4)) << angular_radius;
  }
}

TEST(DirectionalLight, DiscIsFoundByRaysWithinItsRadiusAndItsSamplesFollowTheDensity) {
  scene::Scene scene;
  auto& light = add_light(scene, LightType::directional, vec3(0), {0, -1, 0});
  light.angular_radius = 0.2f;
  const LightSet lights = make_lights(scene);
  const auto at_angle = [](float a) { return vec3(std::sin(a), std::cos(a), 0); };
  ASSERT_TRUE(hit(lights, at_angle(0.199f)));
  EXPECT_FALSE(hit(lights, at_angle(0.201f)));
  const auto s = lights.sample(0, vec3(0), 0.5f, vec2(0.2f, 0.9f));
  ASSERT_TRUE(s);
  EXPECT_FLOAT_EQ(hit(lights, s->wi)->pdf, s->pdf);
  EXPECT_EQ(hit(lights, s->wi)->radiance, s->radiance);
  EXPECT_NEAR(s->pdf * 2 * pi * (1 - std::cos(0.2f)), 1, 1e-5f);
  ssphh::test::DirectionCells cells;
  cells.axis = {0, 1, 0}, cells.cos_min = std::cos(0.2), cells.polar = 8, cells.azimuth = 12;
  const auto draw = [&](Pcg32& random) {
    const float u = random.uniform();
    return std::optional(lights.sample(0, vec3(0), u, random.uniform2())->wi);
  };
  EXPECT_TRUE(ssphh::test::directions_follow(draw, [&](const vec3&) { return s->pdf; }, cells, 1, {0.01}));
}

TEST(EnvironmentLight, ConstantGivesPiTimesItsRadianceEverywhere) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->color = vec3(2);
  const LightSet lights = make_lights(scene);
  EXPECT_TRUE(mean_is(irradiance(lights, {1, 2, 3}, glm::normalize(vec3(1, 1, 0))), 2 * pi_d));
  ASSERT_TRUE(hit(lights, {0, 1, 0}));
  EXPECT_EQ(hit(lights, {0, 1, 0})->radiance, vec3(2));
  EXPECT_FLOAT_EQ(hit(lights, {0, 1, 0})->pdf, 1 / (4 * pi));
}

TEST(EnvironmentLight, ImageIrradianceIsTheSumOverItsDirections) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->equirect = uneven_sky();
  scene.environment->color = vec3(0.5f);
  for (const float rotation : {0.0f, 1.0f}) {
    scene.environment->rotation = rotation;
    const LightSet lights = make_lights(scene);
    for (const vec3 normal : {vec3(0, 1, 0), vec3(0, -1, 0), glm::normalize(vec3(1, 1, -1))}) {
      double sum = 0;
      constexpr int directions = 200000;
      for (int i = 0; i < directions; ++i) {
        const vec3 d = spherical_fibonacci(i, directions);
        sum += static_cast<double>(hit(lights, d)->radiance.x * glm::max(glm::dot(d, normal), 0.0f));
      }
      const double expected = sum * 4 * pi_d / directions;
      // The sum over 2e5 directions is good to 1e-3 of the result
      EXPECT_TRUE(mean_is(irradiance(lights, vec3(0), normal), expected, {}, 1e-3 * expected)) << rotation;
    }
  }
}

TEST(EnvironmentLight, SamplesFollowTheirDensityAndCarryTheRadianceSeenThere) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->equirect = uneven_sky();
  scene.environment->rotation = 0.7f;
  const LightSet lights = make_lights(scene);
  ssphh::test::DirectionCells cells;
  cells.axis = {0, 1, 0}, cells.quadrature = 16;
  const auto draw = [&](Pcg32& random) -> std::optional<vec3> {
    const float u = random.uniform();
    const auto s = lights.sample(0, vec3(0), u, random.uniform2());
    if (!s) return std::nullopt;
    return s->wi;
  };
  const auto pdf = [&](const vec3& d) { return hit(lights, d)->pdf; };
  EXPECT_TRUE(ssphh::test::directions_follow(draw, pdf, cells, 5, {0.01}));

  Pcg32 random(8);
  int equal = 0;
  for (int n = 0; n < 1000; ++n) {
    const float u = random.uniform();
    const auto s = lights.sample(0, vec3(0), u, random.uniform2());
    ASSERT_TRUE(s);
    const auto h = hit(lights, s->wi);
    EXPECT_NEAR(glm::length(h->radiance - s->radiance), 0, 1e-3f * (1 + s->radiance.x));
    equal += std::abs(h->pdf - s->pdf) <= 1e-4f * s->pdf ? 1 : 0;
  }
  EXPECT_GT(equal, 995) << "all but directions that rounding moves to the next pixel";
}

TEST(EnvironmentLight, UniformImageIsSampledUniformlyOverTheSphere) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->equirect = image::Image(32, 16);
  for (float& p : scene.environment->equirect.pixels) p = 3;
  const LightSet lights = make_lights(scene);
  for (int i = 0; i < 500; ++i) {
    // Rounding of the cumulative sums: 1e-4 of a row's share
    EXPECT_NEAR(hit(lights, spherical_fibonacci(i, 500))->pdf * 4 * pi, 1, 1e-3f);
  }
}

TEST(EnvironmentLight, RotatesCounterClockwiseSeenFromAbove) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->equirect = image::Image(64, 32);
  const auto uv = image::equirect_uv({1, 0, 0});
  scene.environment->equirect.set_rgb(static_cast<int>(uv.x * 64), 16, vec3(100));
  scene.environment->equirect.set_rgb(static_cast<int>(uv.x * 64), 15, vec3(100));
  scene.environment->rotation = pi / 2;
  const LightSet lights = make_lights(scene);
  // Seen from above with x to the right, z points down the page: a quarter turn brings +x to −z
  EXPECT_GT(hit(lights, {0.05f, 0, -1})->radiance.x + hit(lights, {-0.05f, 0, -1})->radiance.x, 50);
  EXPECT_EQ(hit(lights, {1, 0, 0})->radiance, vec3(0));
}

TEST(EnvironmentLight, BlackOrBrokenImagesAreNeverSampled) {
  scene::Scene scene;
  scene.environment = scene::Environment{};
  scene.environment->equirect = image::Image(4, 2);
  EXPECT_EQ(make_lights(scene).sample_count(), 0);
  for (float& p : scene.environment->equirect.pixels) p = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(make_lights(scene).sample_count(), 0);
}

}  // namespace
}  // namespace ssphh::shading::test
