#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

#include "light_scenes.h"
#include "lights/punctual_lights.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using ssphh::test::mean_is;
using ssphh::test::Samples;

TEST(PointLight, GivesIntensityTimesCosineOverDistanceSquared) {
  scene::Scene scene;
  add_light(scene, LightType::point, {0, 3, 0}).intensity = 50;
  const LightSet lights = make_lights(scene);
  for (const vec3 x : {vec3(0), vec3(4, 0, 0), vec3(1, -2, 2)}) {
    const auto s = lights.sample(0, x, 0.3f, vec2(0.5f));
    ASSERT_TRUE(s);
    const vec3 d = vec3(0, 3, 0) - x;
    const float distance = glm::length(d);
    EXPECT_TRUE(s->delta);
    EXPECT_EQ(s->pdf, 1);
    EXPECT_FLOAT_EQ(s->distance, distance);
    EXPECT_FLOAT_EQ(s->radiance.x * glm::dot(s->wi, up), 50 * d.y / distance / (distance * distance));
  }
}

TEST(PointLight, FadesTowardsItsRangeAsKhrLightsPunctualSays) {
  scene::Scene scene;
  auto& light = add_light(scene, LightType::point, vec3(0));
  light.intensity = 8, light.range = 4;
  const LightSet lights = make_lights(scene);
  const auto near = lights.sample(0, {2, 0, 0}, 0, vec2(0));
  ASSERT_TRUE(near);
  EXPECT_FLOAT_EQ(near->radiance.x, 8.0f / 4 * (1 - std::pow(2.0f / 4, 4.0f)));
  EXPECT_FALSE(lights.sample(0, {4.01f, 0, 0}, 0, vec2(0)));
}

TEST(SpotLight, IsFullInsideNoneOutsideAndSquaredLinearBetweenItsCones) {
  scene::Scene scene;
  auto& light = add_light(scene, LightType::spot, {0, 2, 0}, {0, -1, 0});
  light.intensity = 10, light.inner_cone = 0.3f, light.outer_cone = 0.6f;
  const LightSet lights = make_lights(scene);
  const auto at_angle = [&](float angle) {
    return vec3(0, 2, 0) + vec3(std::sin(angle), -std::cos(angle), 0);
  };
  const auto inside = lights.sample(0, at_angle(0.29f), 0, vec2(0));
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->radiance.x, 10, 1e-4f);
  const auto between = lights.sample(0, at_angle(0.45f), 0, vec2(0));
  ASSERT_TRUE(between);
  const float t = (std::cos(0.45f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
  EXPECT_NEAR(between->radiance.x, 10 * t * t, 1e-3f);
  EXPECT_FALSE(lights.sample(0, at_angle(0.61f), 0, vec2(0)));
}

TEST(SphereLight, IrradianceIsThatOfItsDiscSeenFromOutside) {
  scene::Scene scene;
  auto& light = add_light(scene, LightType::sphere, {0, 5, 0});
  light.intensity = 100, light.radius = 1.5f;
  const LightSet lights = make_lights(scene);
  // π L (r/d)² cos θ for a sphere wholly above the plane
  EXPECT_TRUE(mean_is(irradiance(lights, vec3(0), up), 100 * pi_d * 1.5 * 1.5 / 25));
  const vec3 tilted = glm::normalize(vec3(1, 2, 0));
  EXPECT_TRUE(mean_is(irradiance(lights, vec3(0), tilted), 100 * pi_d * 1.5 * 1.5 / 25 * 2 / std::sqrt(5.0)));
  // From inside: radiance from everywhere
  EXPECT_TRUE(mean_is(irradiance(lights, {0.3f, 5.9f, -0.2f}, up), 100 * pi_d));
}

TEST(SphereLight, RaysMeetItWhereSamplesSayItIs) {
  const SphereLight light{{1, 2, 3}, 0.7f, vec3(2), 0};
  Pcg32 random(4);
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    const vec3 from =
        light.center + (random.uniform() < 0.5f ? 0.6f : 20.0f) * sample_uniform_sphere(random.uniform2());
    const auto s = light.sample(from, random.uniform2());
    ASSERT_TRUE(s);
    // At the silhouette a rounding of the direction moves the hit by the root of it
    EXPECT_NEAR(glm::length(from + s->distance * s->wi - light.center), light.radius, 2e-3f);
    EXPECT_FLOAT_EQ(s->pdf, light.pdf(from));
    const auto t = light.intersect(from, s->wi, 100);
    if (!t) continue;
    ++met;
    EXPECT_NEAR(*t, s->distance, 2e-2f);
  }
  EXPECT_GT(met, 1990) << "all but rounding at the silhouette";
}

TEST(SphereLight, IsMissedBesideBehindAndBeyondTheRay) {
  const SphereLight light{{0, 0, 10}, 1, vec3(1), 0};
  const vec3 z(0, 0, 1);
  ASSERT_TRUE(light.intersect(vec3(0), z, 100));
  EXPECT_FLOAT_EQ(*light.intersect(vec3(0), z, 100), 9);
  EXPECT_FALSE(light.intersect(vec3(0), z, 8.9f)) << "something stands before it";
  EXPECT_FALSE(light.intersect(vec3(0), -z, 100));
  EXPECT_FALSE(light.intersect({0, 1.01f, 0}, z, 100));
  EXPECT_TRUE(light.intersect({0, 0.99f, 0}, z, 100));
  EXPECT_FALSE(light.intersect({0, 0, 12}, z, 100));
}

/// Irradiance / (π L) at a point whose normal meets the corner of an a×b rectangle in a parallel plane at
/// distance 1 (Modest, Radiative Heat Transfer, view factor 11).
double corner_form_factor(double a, double b) {
  const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * pi_d);
}

TEST(AreaLight, RectangleGivesItsFormFactor) {
  scene::Scene scene;
  // 2 × 3 m, 2 m above the floor
  add_panel(scene, glowing(vec3(7)), {{0, 2, 0}, quat(1, 0, 0, 0), {2, 1, 3}});
  const LightSet lights = make_lights(scene);
  EXPECT_TRUE(mean_is(irradiance(lights, vec3(0), up), 7 * pi_d * 4 * corner_form_factor(0.5, 0.75)));
  EXPECT_TRUE(mean_is(irradiance(lights, {1, 0, 1.5f}, up), 7 * pi_d * corner_form_factor(1, 1.5)));
}

TEST(AreaLight, MeanInverseDensityIsItsSolidAngle) {
  scene::Scene scene;
  add_panel(scene, glowing(vec3(1)), {{0, 2, 0}, quat(1, 0, 0, 0), {2, 1, 3}});
  const LightSet lights = make_lights(scene);
  Pcg32 random(2);
  Samples samples;
  for (int n = 0; n < 20000; ++n) {
    const float u = random.uniform();
    const auto s = lights.sample(0, vec3(0), u, random.uniform2());
    ASSERT_TRUE(s);
    samples.add(1 / static_cast<double>(s->pdf));
  }
  // Of a rectangle seen from above its centre: 4 asin(ab/√((1+a²)(1+b²))) with a, b half sides over distance
  const double a = 0.5, b = 0.75;
  EXPECT_TRUE(mean_is(samples, 4 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)))));
}

TEST(AreaLight, EmitsFromTheFrontOnlyUnlessDoubleSided) {
  for (const bool mirrored : {false, true}) {
    for (const bool double_sided : {false, true}) {
      scene::Scene scene;
      scene::Material material = glowing(vec3(1));
      material.double_sided = double_sided;
      // A mirroring instance keeps its front in front
      const int panel =
          add_panel(scene, material, {{0, 2, 0}, quat(1, 0, 0, 0), {mirrored ? -1.0f : 1.0f, 1, 1}});
      const LightSet lights = make_lights(scene);
      const Samples below = irradiance(lights, vec3(0), up, 2000),
                    above = irradiance(lights, {0, 4, 0}, -up, 2000);
      EXPECT_TRUE(mean_is(below, 4 * pi_d * corner_form_factor(0.25, 0.25)));
      EXPECT_EQ(above.mean() > 0, double_sided) << mirrored;
      EXPECT_EQ(lights.pdf_triangle({0, 4, 0}, panel, 0, 2, 1) > 0, double_sided);
    }
  }
}

TEST(AreaLight, TextureAndCoverageScaleTheEmission) {
  scene::Scene scene;
  scene::Material material = glowing(vec3(4));
  material.emission_texture.texture = 0;
  material.emission_texture.nearest = true;
  material.alpha = 0.5f;
  material.alpha_mode = scene::AlphaMode::blend;
  // Left half black, right half white
  scene.textures.push_back({"halves", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}});
  add_panel(scene, material, {{0, 2, 0}, quat(1, 0, 0, 0), {4, 1, 4}});
  // Below the corner of the white half, whose far corner is 2 m by 2 m away: 4 · ½ of a corner form factor
  EXPECT_TRUE(
      mean_is(irradiance(make_lights(scene), {0, 0, 0}, up), 4 * 0.5 * pi_d * 2 * corner_form_factor(1, 1)));
}

TEST(AreaLight, DensityOfAHitIsThatOfTheSample) {
  scene::Scene scene;
  add_light(scene, LightType::point, {1, 1, 1});
  scene.environment = scene::Environment{};
  const int panel =
      add_panel(scene, glowing(vec3(7)), {{0, 2, 0}, glm::angleAxis(0.4f, vec3(0, 0, 1)), {2, 1, 3}});
  const LightSet lights = make_lights(scene);
  Pcg32 random(9);
  const vec3 from(2, 0, 0.5f);
  const mat4 world = scene::world_matrices(scene)[scene.instances[0].node];
  const vec3 normal = glm::normalize(vec3(glm::transpose(glm::inverse(world)) * vec4(0, -1, 0, 0)));
  int compared = 0;
  for (int n = 0; n < 500; ++n) {
    const float u = random.uniform();
    const auto s = lights.sample(0, from, u, random.uniform2());
    if (!s || s->delta || std::isinf(s->distance)) continue;
    ++compared;
    // Both triangles have one area and one emission: the index does not matter
    const float cos_light = std::abs(glm::dot(s->wi, normal));
    EXPECT_NEAR(lights.pdf_triangle(from, panel, 1, s->distance, cos_light) / s->pdf, 1, 1e-4f);
    EXPECT_EQ(lights.pdf_triangle(from, panel, 1, s->distance, 0), 0) << "seen edge on";
  }
  EXPECT_GT(compared, 50);
}

TEST(LocalLights, NoNumberBreaksAtPointsOnALight) {
  scene::Scene scene;
  add_light(scene, LightType::point, vec3(0));
  add_light(scene, LightType::spot, vec3(0));
  add_light(scene, LightType::sphere, vec3(0)).radius = 1;
  add_panel(scene, glowing(vec3(1)), {});
  const LightSet lights = make_lights(scene);
  Pcg32 random(6);
  for (const vec3 x : {vec3(0), vec3(1, 0, 0), vec3(0.25f, 0, 0.25f), vec3(0.5f, 0, 0.5f), vec3(1e-8f)}) {
    for (int n = 0; n < 500; ++n) {
      const float u = random.uniform();
      const auto s = lights.sample(0, x, u, random.uniform2());
      if (!s) continue;
      EXPECT_TRUE(is_finite(s->radiance) && is_finite(s->wi) && std::isfinite(s->pdf) && s->pdf > 0);
      EXPECT_TRUE(std::isfinite(s->distance) && s->distance >= 0);
    }
    const float pdf = lights.pdf_triangle(x, 0, 0, 0.5f, 0.5f);
    EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0);
  }
}

}  // namespace
}  // namespace ssphh::shading::test
