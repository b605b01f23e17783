/// Lamps with photometric profiles: what arrives from them, and where their photons go.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

#include "chi2.h"
#include "light_scenes.h"
#include "lights/profile_intensity.h"
#include "lights/punctual_lights.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using scene::Photometry;
using ssphh::test::directions_follow;
using ssphh::test::Significance;

scene::LampProfile profile(const scene::PhotometricTable& table) {
  return {"p", std::make_shared<const scene::PhotometricTable>(table)};
}

/// I(θ) = 1 − θ/90° below the horizon.
const scene::PhotometricTable ramp{Photometry::c, {0, 90}, {0}, {50, 0}};
/// A narrow beam aside, dark parts, a coarse and a fine cell.
const scene::PhotometricTable uneven{
    Photometry::c, {0, 20, 22, 100, 180}, {0, 40, 45, 300, 360}, {1, 2, 9, 0, 0, 1, 7, 80, 0, 0, 1, 0, 0,
                                                                  0, 3, 1, 5, 0, 0, 0, 1,  2, 9, 0, 0}};
const scene::PhotometricTable flood{
    Photometry::b, {45, 90, 100, 135}, {-30, 0, 60}, {0, 3, 4, 0, 1, 9, 0, 2, 0, 1, 1, 0}};

// At height 3, x beside the foot: I(θ) cos θ / d² with tan θ = x / 3.
TEST(ProfileLight, GivesAPlaneItsShareOfTheIntensityTimesCosineOverDistanceSquared) {
  scene::Scene scene;
  scene::Light& light = add_light(scene, LightType::point, {0, 3, 0}, {0, -1, 0});
  light.profile = profile(ramp), light.color = {1, 0.5f, 0.25f}, light.intensity = 40;
  const LightSet lights = make_lights(scene);
  for (const float aside : {0.0f, 0.5f, 1.0f, 3.0f, 20.0f}) {
    const auto s = lights.sample(0, {aside, 0, 0}, 0.3f, vec2(0.5f));
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->delta);
    const double d2 = 9 + static_cast<double>(aside) * static_cast<double>(aside), d = std::sqrt(d2),
                 angle = std::atan2(static_cast<double>(aside), 3.0);
    const vec3 e = s->radiance * glm::dot(s->wi, up);
    EXPECT_NEAR(static_cast<double>(e.x), 40 * (1 - angle / (pi_d / 2)) * 3 / d / d2, 1e-5 * 40 / 9);
    EXPECT_FLOAT_EQ(e.y, 0.5f * e.x);
    EXPECT_FLOAT_EQ(e.z, 0.25f * e.x);
    EXPECT_FLOAT_EQ(s->distance, static_cast<float>(d));
  }
  EXPECT_FALSE(lights.sample(0, {0, 4, 0}, 0, vec2(0))) << "dark above it";
}

TEST(ProfileLight, OfASpotIsNarrowedByItsCones) {
  scene::Scene scene;
  scene::Light& light = add_light(scene, LightType::spot, {0, 2, 0}, {0, -1, 0});
  light.profile = profile(ramp), light.inner_cone = 0.2f, light.outer_cone = 0.5f;
  const LightSet lights = make_lights(scene);
  const auto at = [&](float angle) {
    const auto s = lights.sample(0, {2 * std::tan(angle), 0, 0}, 0, vec2(0));
    return s ? s->radiance.x * 4 / (std::cos(angle) * std::cos(angle)) : 0;
  };
  const float ramp_share = (std::cos(0.4f) - std::cos(0.5f)) / (std::cos(0.2f) - std::cos(0.5f));
  EXPECT_NEAR(at(0.1f), 1 - 0.1f / (pi / 2), 1e-5f);
  EXPECT_NEAR(at(0.4f), ramp_share * ramp_share * (1 - 0.4f / (pi / 2)), 1e-5f);
  EXPECT_EQ(at(0.6f), 0);
}

TEST(ProfileLight, IsDimmedAndMovedByItsState) {
  scene::Scene scene;
  add_light(scene, LightType::point, {0, 3, 0}, {0, -1, 0}).profile = profile(ramp);
  const auto world = scene::world_matrices(scene);
  const LightSet base(scene, world);
  std::vector<scene::LightState> states = scene::lighting_at(scene, 0).lights;
  states[0].intensity = 7;
  states[0].world[3].y = 2;
  const auto s = LightSet(base, world, states).sample(0, vec3(0), 0, vec2(0));
  ASSERT_TRUE(s);
  EXPECT_FLOAT_EQ(s->radiance.x, 7 / 4.0f);
}

TEST(ProfileIntensity, SamplesAreAsOftenAsTheirDensitySays) {
  const mat4 turned(glm::mat4_cast(pointing({1, 3, -2})));
  for (const scene::PhotometricTable& table : {ramp, uneven, flood}) {
    scene::Light light;
    light.profile = profile(table);
    const ProfileIntensity shape(std::make_shared<const ProfileTable>(light), turned);
    const ssphh::test::DirectionCells cells{.axis = glm::normalize(vec3(1, 1, 1)), .quadrature = 40};
    EXPECT_TRUE(directions_follow(
        [&](Pcg32& random) { return std::optional(shape.sample(random.uniform2()).direction); },
        [&](const vec3& d) { return shape.pdf(d); }, cells, 7, Significance{}));
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
      const auto chosen = shape.sample(random.uniform2());
      EXPECT_NEAR(glm::length(chosen.direction), 1, 1e-5f);
      EXPECT_NEAR(shape.pdf(chosen.direction), chosen.pdf, 0.01f * chosen.pdf)
          << "but for directions at the edge of a cell";
    }
  }
}

// ∫ I dω by photons, by the mean, and by a sum over the sphere.
TEST(ProfileIntensity, PhotonsCarryItsFlux) {
  for (const scene::PhotometricTable& table : {ramp, uneven, flood}) {
    for (const bool spot : {false, true}) {
      PosedLight posed;
      posed.light.type = spot ? LightType::spot : LightType::point;
      posed.light.inner_cone = 0.2f, posed.light.outer_cone = 0.9f;
      posed.light.profile = profile(table), posed.light.color = {1, 0.5f, 0.1f}, posed.light.range = 4;
      posed.profile = std::make_shared<const ProfileTable>(posed.light);
      const PointLight light = make_profile_light(posed, 0);
      double flux = 0;
      constexpr int n = 1000;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j)
          flux += static_cast<double>(
              light.shape
                  ->toward(sample_uniform_sphere(
                      vec2((static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n)))
                  .x);
      }
      flux *= 4 * pi_d / n / n;
      ssphh::test::Samples samples;
      Pcg32 random(5);
      for (int i = 0; i < 20000; ++i) {
        const rays::Photon photon = light.emit(random.uniform2());
        EXPECT_EQ(photon.origin, vec3(0));
        EXPECT_EQ(photon.range, 4);
        EXPECT_FLOAT_EQ(photon.power.y, 0.5f * photon.power.x);
        samples.add(static_cast<double>(photon.power.x));
      }
      EXPECT_TRUE(ssphh::test::mean_is(samples, flux)) << spot;
      // Sums of a thousand steps a side err most at the edges of what shines
      EXPECT_NEAR(static_cast<double>(light.shape->mean().x) * 4 * pi_d / flux, 1, 0.01) << spot;
    }
  }
}

TEST(ProfileIntensity, IsDarkWhereConesAndProfileDoNotMeet) {
  PosedLight posed;
  posed.light.type = LightType::spot, posed.light.inner_cone = 0.1f, posed.light.outer_cone = 0.2f;
  posed.light.profile = profile({Photometry::c, {90, 180}, {0}, {1, 1}});
  posed.profile = std::make_shared<const ProfileTable>(posed.light);
  const PointLight light = make_profile_light(posed, 0);
  EXPECT_EQ(light.power(), 0);
  EXPECT_EQ(light.importance({0, 0, -1}), 0);
  EXPECT_EQ(light.emit(vec2(0.5f)).power, vec3(0));
  EXPECT_FALSE(light.sample({0, 0, -1}));
}

}  // namespace
}  // namespace ssphh::shading::test
