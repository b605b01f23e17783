#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

/// Irradiance of the upper half of an equirectangular image on a horizontal plane.
vec3 sky_irradiance(const image::Image& image) {
  glm::dvec3 sum(0);
  for (int y = 0; y < image.height / 2; ++y) {
    const double theta = pi_d * (y + 0.5) / image.height;
    const double solid_angle = 2 * pi_d / image.width * std::sin(theta) * pi_d / image.height;
    for (int x = 0; x < image.width; ++x) sum += glm::dvec3(image.rgb(x, y)) * solid_angle * std::cos(theta);
  }
  return vec3(sum);
}

Scene sky_scene(float elevation_degrees, float turbidity = 3) {
  Scene scene;
  add_sun_sky(scene, {.elevation = glm::radians(elevation_degrees), .turbidity = turbidity, .width = 128});
  return scene;
}

TEST(SunSky, SceneIsValidAndHasTheGroupsSunAndSky) {
  Scene scene = sky_scene(45);
  EXPECT_TRUE(validate(scene).empty());
  EXPECT_EQ(light_groups(scene), (std::vector<std::string>{"sun", "sky"}));
}

TEST(SunSky, SunShinesFromWhereTheSkyIsBrightest) {
  for (const float azimuth : {0.0f, 1.0f, 3.0f, -2.0f}) {
    Scene scene;
    const SunSkyParams params{.elevation = 0.6f, .azimuth = azimuth, .width = 256};
    add_sun_sky(scene, params);
    const vec3 to_sun = sun_direction(params);
    EXPECT_NEAR(std::atan2(to_sun.z, to_sun.x), azimuth, 1e-5f);
    const vec3 shines(world_matrices(scene)[0] * vec4(0, 0, -1, 0));
    EXPECT_LT(glm::distance(shines, -to_sun), 1e-5f);  // float rounding
    const image::Image& sky = scene.environment->equirect;
    int best_x = 0, best_y = 0;
    for (int y = 0; y < sky.height / 2; ++y) {
      for (int x = 0; x < sky.width; ++x) {
        if (luminance(sky.rgb(x, y)) > luminance(sky.rgb(best_x, best_y))) best_x = x, best_y = y;
      }
    }
    const float phi = 2 * pi * ((static_cast<float>(best_x) + 0.5f) / 256 - 0.5f);
    const float theta = pi * (static_cast<float>(best_y) + 0.5f) / 128;
    const vec3 brightest(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    // Two pixels: the brightest centre is not the sun's place itself.
    EXPECT_GT(glm::dot(brightest, to_sun), std::cos(2 * 2 * pi / 256));
  }
}

/// Clear-sky illuminances at 45°: about 70–100 klx from the sun on a facing plane; 10–20 klx from the sky, of
/// which Preetham's model is known to be on the bright side (its zenith alone, 5.9 kcd/m², makes 18.6 klx).
TEST(SunSky, LevelsAreThoseOfClearDays) {
  const Scene scene = sky_scene(45, 2.5f);
  const Light& sun = scene.lights[0];
  const float sun_lux = 110 * luminance(sun.intensity * sun.color);
  EXPECT_GT(sun_lux, 70'000);
  EXPECT_LT(sun_lux, 105'000);
  const float sky_lux = 110 * luminance(sky_irradiance(scene.environment->equirect));
  EXPECT_GT(sky_lux, 7'000);
  EXPECT_LT(sky_lux, 30'000);
}

TEST(SunSky, ZenithIsBlueAndTheLowSunRed) {
  const SunSkyParams noon{.elevation = glm::radians(60.0f)}, evening{.elevation = glm::radians(4.0f)};
  const vec3 zenith = sky_radiance(noon, {0, 1, 0});
  EXPECT_GT(zenith.z, 1.5f * zenith.x);
  const vec3 high = sun_irradiance(noon), low = sun_irradiance(evening);
  EXPECT_GT(low.x / low.z, 2 * high.x / high.z);
  EXPECT_LT(luminance(low), 0.5f * luminance(high));
}

/// Preetham's tables evaluated by hand for turbidity 2, sun in the zenith: Yz = (4.0453·2 − 4.9710) tan χ −
/// 0.431 + 2.4192 with χ = (4/9 − 1/60) π.
TEST(SunSky, ZenithLuminanceMatchesThePaper) {
  const double chi = (4.0 / 9 - 2.0 / 120) * pi_d;
  const double expected = 1000 * (3.1196 * std::tan(chi) + 1.9882);
  const vec3 zenith = sky_radiance({.elevation = pi / 2, .turbidity = 2}, {0, 1, 0});
  EXPECT_NEAR(110 * luminance(zenith) / expected, 1, 1e-3);  // rounded matrices and weights of luminance
}

TEST(SunSky, GroundReflectsWhatArrives) {
  const SunSkyParams params{.elevation = 0.7f, .ground_albedo = vec3(0.4f), .width = 512};
  Scene scene;
  add_sun_sky(scene, params);
  const image::Image& image = scene.environment->equirect;
  const vec3 arrives = sky_irradiance(image) + std::sin(0.7f) * sun_irradiance(params);
  const vec3 expected = 0.4f * arrives / pi, ground = image.rgb(17, image.height - 1);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(ground[c] / expected[c], 1, 1e-3f);  // two quadratures of a smooth sky
}

TEST(SunSky, ParametersOutOfRangeAreErrors) {
  Scene scene;
  EXPECT_THROW(add_sun_sky(scene, {.elevation = -0.1f}), Error);
  EXPECT_THROW(add_sun_sky(scene, {.elevation = 2}), Error);
  EXPECT_THROW(add_sun_sky(scene, {.turbidity = 1}), Error);
  EXPECT_THROW(add_sun_sky(scene, {.turbidity = std::nanf("")}), Error);
  EXPECT_THROW(add_sun_sky(scene, {.width = 0}), Error);
  EXPECT_FALSE(scene.environment.has_value());
}

TEST(SunSky, ParametersAreTakenUpToTheirLimits) {
  const auto said = [](const SunSkyParams& params) {
    return test::message_of([&] { sky_radiance(params, {0, 1, 0}); });
  };
  for (const float good : {0.0f, pi / 2}) EXPECT_EQ(said({.elevation = good}), "no error") << good;
  for (const float bad : {-1e-6f, pi / 2 + 1e-4f})
    EXPECT_TRUE(said({.elevation = bad}).starts_with("sun and sky: elevation: ")) << bad;
  for (const float good : {1.7f, 10.0f}) EXPECT_EQ(said({.turbidity = good}), "no error") << good;
  for (const float bad : {1.6999f, 10.001f})
    EXPECT_TRUE(said({.turbidity = bad}).starts_with("sun and sky: turbidity: ")) << bad;
  for (const int good : {4, 16384}) EXPECT_EQ(said({.width = good}), "no error") << good;
  for (const int bad : {3, 16385})
    EXPECT_EQ(said({.width = bad}),
              fmt::format("sun and sky: width: {} is out of range (4 to 16384 pixels)", bad));
}

}  // namespace
}  // namespace ssphh::scene
