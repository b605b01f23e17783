// A sky that changes while the scene stays: as bright everywhere as in a scene that was loaded with it.

#include <gtest/gtest.h>

#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/turn_surroundings.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "hand_made.h"

namespace ssphh::test {
namespace {

/// A floor with a wall on it.
scene::Scene court(const scene::SunSkyParams& sky, float rotation = 0) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_object(scene, scene::make_quad({1, 0, 3}, {0, 2, 0}, {0, 0, -6}), lambertian(vec3(0.3f)), "wall");
  scene::add_sun_sky(scene, sky);
  scene.environment->rotation = rotation;
  return scene;
}

const std::vector<rays::SurfacePoint> points = {{vec3(0)}, {vec3(0.7f, 0, 0.4f)}, {vec3(-1, 0, 2)}};

/// Of sky and sun.
std::vector<vec3> direct_light(const trace::TransportScene& source, const scene::LightingState& state) {
  const auto light = source.direct_light(state.lights, std::vector<mat4>(1, mat4(1)), state.environment());
  std::vector<vec3> sum(points.size(), vec3(0));
  for (std::size_t g = 0; g < source.light_groups().size(); ++g) {
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += light->irradiance_by_normal(static_cast<int>(g), points[i], 4096)[3];
  }
  return sum;
}

void expect_alike(const std::vector<vec3>& a, const std::vector<vec3>& b) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (glm::length_t c = 0; c < 3; ++c)
      EXPECT_NEAR(a[i][c], b[i][c], 1e-3f * std::abs(b[i][c]) + 1e-9f) << i;
  }
}

const scene::SunSkyParams morning{
    .elevation = 0.3f, .azimuth = 0.4f, .width = 128, .model = scene::SkyModel::physical};

class LiveSky : public testing::TestWithParam<scene::SunSkyParams> {};

TEST_P(LiveSky, LightsAsALoadedOneDoes) {
  const scene::SunSkyParams later = GetParam();
  const scene::Scene scene = court(morning), expected = court(later);
  const trace::TransportScene source(scene), loaded(expected);
  scene::LightingState state = rays::lighting_at(source);
  scene::set_sun_sky(state, scene, scene::make_sun_sky(later));
  const std::vector<vec3> wanted = direct_light(loaded, rays::lighting_at(loaded));
  expect_alike(direct_light(source, state), wanted);
  EXPECT_NE(direct_light(source, state), direct_light(source, rays::lighting_at(source)));

  // A path tracer of the same state, and one that has the scene
  const scene::Scene lit = scene::with_lighting(scene, state);
  const trace::PathTracer here(lit), there(expected);
  const auto lights = [&](const trace::PathTracer& tracer) {
    return tracer.surface_irradiance(points, {.max_depth = 2, .passes = 1, .spp = 4096, .seed = 3}, {});
  };
  const auto one = lights(here), other = lights(there);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(luminance(one[i].direct), luminance(other[i].direct), 0.02f * luminance(other[i].direct))
        << i;
}

INSTANTIATE_TEST_SUITE_P(
    Skies, LiveSky,
    testing::Values(
        scene::SunSkyParams{.elevation = 1, .azimuth = 2, .width = 128, .model = scene::SkyModel::physical},
        scene::SunSkyParams{
            .elevation = -0.06f, .azimuth = -1, .width = 128, .model = scene::SkyModel::physical},
        scene::SunSkyParams{.elevation = 0.8f, .azimuth = 3, .width = 128}));

TEST(LiveSkyTurned, TurnsWithTheScenesEnvironment) {
  const scene::Scene scene = court(morning, 0.5f);
  const trace::TransportScene source(scene);
  scene::LightingState state = rays::lighting_at(source);
  scene::set_sun_sky(state, scene, scene::make_sun_sky(morning));
  // Turned counter-clockwise seen from above, by which azimuths shrink
  scene::SunSkyParams turned = morning;
  turned.azimuth -= 0.5f;
  const vec3 shines(state.lights[0].world * vec4(0, 0, -1, 0));
  EXPECT_LT(glm::distance(shines, -scene::sun_direction(turned)), 1e-5f);
  scene::turn_surroundings(state, scene, 0.25f);
  turned.azimuth -= 0.25f;
  const scene::Scene expected = court(turned);
  const trace::TransportScene loaded(expected);
  const std::vector<vec3> one = direct_light(source, state),
                          other = direct_light(loaded, rays::lighting_at(loaded));
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(luminance(one[i]), luminance(other[i]), 0.01f * luminance(other[i]))
        << i;  // pixels between pixels
}

TEST(LiveSkyOfNone, IsRefused) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_constant_sky(scene, vec3(1));
  scene::LightingState state = scene::lighting_at(scene);
  EXPECT_EQ(message_of([&] { scene::set_sun_sky(state, scene, scene::make_sun_sky(morning)); }),
            "sky: the scene's environment is no computed sky (give --sky physical)");
}

TEST(LiveSkyTwice, HasOneSun) {
  scene::Scene scene = court(morning);
  scene::SunSkyParams later = morning;
  later.elevation = 1;
  scene::add_sun_sky(scene, later);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_LT(glm::distance(vec3(scene::lighting_at(scene).lights[0].world * vec4(0, 0, -1, 0)),
                          -scene::sun_direction(later)),
            1e-5f);
}

}  // namespace
}  // namespace ssphh::test
