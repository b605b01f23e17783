/// Direct light that is kept: against closed forms, and against light that is not.

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

/// A scene's direct light in its pose at time 0.
struct KeptLight {
  explicit KeptLight(scene::Scene scene_in) : scene(std::move(scene_in)), source(scene) {
    std::vector<mat4> poses;
    for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, 0));
    light = source.direct_light(source.lights(0), poses);
  }
  rays::IrradianceByNormal at(const rays::SurfacePoint& point, int group = 0, int samples = 1024) const {
    return light->irradiance_by_normal(group, point, samples);
  }

  scene::Scene scene;
  trace::TransportScene source;
  std::unique_ptr<rays::DirectLight> light;
};

scene::Scene floor_under_sky(const vec3& radiance) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_constant_sky(scene, radiance);
  return scene;
}

void expect_near(const vec3& value, const vec3& truth, float share) {
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(value[c], truth[c], share * std::abs(truth[c])) << c;
}

TEST(KeptLight, OfAnOpenSkyIsPiTimesItsRadianceAndTurnsWithNothing) {
  const vec3 radiance(1, 2, 4);
  const KeptLight sky(floor_under_sky(radiance));
  const rays::IrradianceByNormal light = sky.at({});
  expect_near(light[3], pi * radiance, 1e-5f);
  // Slopes of 1024 stratified directions cancel but for what grazes.
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(max_component(glm::abs(light[c])), 0.01f * light[3].z);
}

TEST(KeptLight, BesideAWallIsHalfASkyAndTurnsAwayFromIt) {
  // Of the upper half sphere a high wall at x = 0 leaves the side of positive x: E = π L/2, and along x
  // ∫ ω_x dω = π/2, of which the bound of grazing cosines at 0.1 takes ∫ 2 √(1 − z²) (1 − z/0.1) dz = 0.1.
  const vec3 radiance(0.5f, 1, 3);
  scene::Scene scene = floor_under_sky(radiance);
  add_object(scene, scene::make_quad({0, -1, 1e5f}, {0, 2e5f, 0}, {0, 0, -2e5f}), lambertian(vec3(0)),
             "wall");
  const KeptLight sky(std::move(scene));
  const rays::IrradianceByNormal light = sky.at({vec3(0.5f, 0, 0)}, 0, 1 << 14);
  expect_near(light[3], 0.5f * pi * radiance, 0.005f);
  expect_near(light[0], (0.5f * pi - 0.1f) * radiance, 0.02f);
  EXPECT_LT(max_component(glm::abs(light[2])), 0.02f * light[0].z);
  EXPECT_LT(max_component(glm::abs(light[1])), 1e-5f * light[0].z) << "the tangent plane has no height";
}

TEST(KeptLight, OfASkyBehindASmallWindowHasLittleNoise) {
  // A window in a wall at x = 0, from floor to ceiling 0.4 m wide: of a strip as high as the room each point
  // sees a polygon; its irradiance by Lambert's formula.
  const vec3 radiance(1, 2, 4);
  scene::Scene scene = floor_under_sky(radiance);
  const auto wall = [&](float from, float to) {
    add_object(scene, scene::make_quad({0, -1, to}, {0, 1001, 0}, {0, 0, from - to}), lambertian(vec3(0)),
               "wall");
  };
  wall(-1000, -0.2f), wall(0.2f, 1000);
  add_object(scene, scene::make_quad({0, 1.5f, -1000}, {0, 1000, 0}, {0, 0, 2000}), lambertian(vec3(0)),
             "lintel");
  add_object(scene, scene::make_quad({-1, 3, -1000}, {1001, 0, 0}, {0, 0, 2000}), lambertian(vec3(0)),
             "ceiling");
  add_object(scene, scene::make_quad({0, -1, -0.2f}, {0, 2, 0}, {0, 0, 0.4f}), lambertian(vec3(0)), "sill");
  const KeptLight sky(std::move(scene));
  double square = 0, sum = 0;
  constexpr int count = 64;
  for (int i = 0; i < count; ++i) {
    const vec3 x(1.5f + 0.02f * static_cast<float>(i), 0, 0.03f * static_cast<float>(i) - 1);
    const std::array<vec3, 4> corners = {vec3(0, 1, -0.2f), vec3(0, 1, 0.2f), vec3(0, 1.5f, 0.2f),
                                         vec3(0, 1.5f, -0.2f)};
    float lambert = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const vec3 a = glm::normalize(corners[k] - x), b = glm::normalize(corners[(k + 1) % 4] - x);
      lambert += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).y;
    }
    const vec3 truth = 0.5f * std::abs(lambert) * radiance, found = sky.at({x})[3];
    EXPECT_NEAR(found.x / truth.x, found.z / truth.z, 1e-4f);
    sum += found.y / truth.y;
    square += static_cast<double>((found.y / truth.y - 1) * (found.y / truth.y - 1));
  }
  // The window takes half a per cent of the hemisphere, five of 1024 directions, which alone leave 24 %.
  EXPECT_NEAR(sum / count, 1, 0.02);
  EXPECT_LT(std::sqrt(square / count), 0.07);
}

TEST(KeptLight, OfAnImageWithASunEqualsLightThatIsNotKept) {
  // What is thousands of times as bright as the mean is drawn by the image, the rest by the hemisphere; half
  // of both lies behind a shelf.
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_object(scene, scene::make_quad({0.2f, 1, -50}, {50, 0, 0}, {0, 0, 100}), lambertian(vec3(0)), "shelf");
  scene::Environment sky;
  sky.equirect = image::Image(64, 32, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) sky.equirect.at(x, y)[c] = static_cast<float>(1 + c);
  for (const int x : {5, 21, 37, 53})
    for (int c = 0; c < 3; ++c) sky.equirect.at(x, 6)[c] = 9000.0f / static_cast<float>(1 + c);
  scene.environment = sky;
  const trace::TransportScene exact(scene, {.light_samples = 1, .environment_samples = 1 << 17});
  const auto light = exact.direct_light(exact.lights(0), std::vector<mat4>(1, mat4(1)));
  const KeptLight kept(scene);
  const std::vector<rays::SurfacePoint> points = {{vec3(0)}, {vec3(0.4f, 0, 0.4f)}, {vec3(-3, 0, 2)}};
  std::vector<vec3> truth(points.size());
  light->irradiance(0, points, truth);
  for (std::size_t p = 0; p < points.size(); ++p) expect_near(kept.at(points[p])[3], truth[p], 0.05f);
}

TEST(KeptLight, OfAPointFollowsTheCosine) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_light(scene, scene::LightType::point, 7, vec3(3, 4, 0)).color = vec3(1, 0.5f, 0.25f);
  const KeptLight lamp(std::move(scene));
  const rays::IrradianceByNormal light = lamp.at({});
  // E(n) = 7/25 n·(3/5, 4/5, 0)
  expect_near(light[3], 7.0f / 25 * 0.8f * vec3(1, 0.5f, 0.25f), 1e-5f);
  expect_near(light[0], 7.0f / 25 * 0.6f * vec3(1, 0.5f, 0.25f), 1e-5f);
}

/// Panels above a floor, one half hidden; a ball; a sky with its sun.
scene::Scene lamps_of_all_kinds() {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_object(scene, scene::make_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}), lambertian(vec3(0), vec3(3, 2, 1)),
             "panel");
  add_object(scene, scene::make_quad({-0.3f, 1, -5}, {5, 0, 0}, {0, 0, 10}), lambertian(vec3(0.2f)), "shelf");
  scene::Light& ball = add_light(scene, scene::LightType::sphere, 5, vec3(-2, 1.5f, 1));
  ball.name = "ball";
  ball.radius = 0.3f;
  scene::add_sun_sky(scene, {});
  return scene;
}

TEST(KeptLight, EqualsLightThatIsNotKept) {
  const scene::Scene scene = lamps_of_all_kinds();
  const trace::TransportScene exact(scene, {.light_samples = 1 << 14, .environment_samples = 1 << 16});
  const auto light = exact.direct_light(exact.lights(0), std::vector<mat4>(1, mat4(1)));
  const KeptLight kept(scene);
  const std::vector<rays::SurfacePoint> points = {{vec3(0)}, {vec3(0.7f, 0, 0.4f)}, {vec3(-3, 0, 2)}};
  for (int group = 0; group < static_cast<int>(exact.light_groups().size()); ++group) {
    std::vector<vec3> truth(points.size());
    light->irradiance(group, points, truth);
    for (std::size_t p = 0; p < points.size(); ++p) {
      SCOPED_TRACE(exact.light_groups()[group] + std::to_string(p));
      // Both have noise; that of 1024 samples is what one sees in records.
      for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(kept.at(points[p], group)[3][c], truth[p][c], 0.015f * truth[p][c] + 1e-6f);
    }
  }
}

TEST(KeptLight, DerivativesAreThoseOfTheLightAsTheSurfaceTurns) {
  // What lies above both horizons: the derivative is exact there.
  scene::Scene scene;
  add_object(scene, scene::make_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}), lambertian(vec3(0), vec3(3, 2, 1)),
             "panel");
  const KeptLight panel(std::move(scene));
  const rays::IrradianceByNormal light = panel.at({vec3(0.5f, 0, 0.2f)}, 0, 1 << 12);
  for (const vec3& turned : {vec3(0.3f, 1, 0), vec3(-0.2f, 1, 0.2f), vec3(0, 1, -0.3f)}) {
    const vec3 n = glm::normalize(turned);
    // The record's normal n₀ keeps its share: E(n) = E₀ (n·n₀) + …, of which the last column has E₀ alone.
    const vec3 along = light * vec4(n, 0);
    const vec3 predicted = along + light[3] * n.y;
    expect_near(predicted, panel.at({vec3(0.5f, 0, 0.2f), n}, 0, 1 << 12)[3], 0.003f);
  }
}

TEST(KeptLight, InTheOpenSumsUpToWhatIsThere) {
  const vec3 radiance(1, 2, 4);
  scene::Scene scene;
  add_constant_sky(scene, radiance);
  add_light(scene, scene::LightType::point, 9, vec3(0, 3, 0)).name = "lamp";
  scene::Light& ball = add_light(scene, scene::LightType::sphere, 2, vec3(2, 0, 0));
  ball.name = "ball";
  ball.radius = 0.5f;
  const KeptLight light(std::move(scene));
  const auto sum = [&](const std::string& group) {
    vec3 total(0);
    const int g = scene::light_group_index(light.source.light_groups(), group);
    for (const rays::ArrivingLight& part : light.light->arriving(g, vec3(0), 4096)) total += part.irradiance;
    return total;
  };
  expect_near(sum("environment"), 4 * pi * radiance, 1e-4f);
  expect_near(sum("lamp"), vec3(1), 1e-5f);  // 9 W/sr at 3 m
  // ∫ L dω of a ball: 2π (1 − cos θ) L with sin θ = 1/4
  expect_near(sum("ball"), vec3(2 * pi * (1 - std::sqrt(15.0f) / 4) * 2), 1e-4f);
}

TEST(KeptLight, InTheOpenIsShadowed) {
  scene::Scene scene;
  add_object(scene, scene::make_quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), lambertian(vec3(0.5f)), "roof");
  add_light(scene, scene::LightType::point, 9, vec3(0, 3, 0));
  const KeptLight light(std::move(scene));
  EXPECT_TRUE(light.light->arriving(0, vec3(0), 16).empty());
  EXPECT_EQ(light.light->arriving(0, vec3(3, 0, 0), 16).size(), 1u);
}

TEST(KeptLight, RefusesToSampleNothing) {
  const KeptLight sky(floor_under_sky(vec3(1)));
  EXPECT_THROW(sky.at({}, 0, 0), Error);
  EXPECT_THROW(sky.light->arriving(0, vec3(0), 0), Error);
  EXPECT_THROW(sky.at({}, 1), Error) << "there is one group";
}

}  // namespace
}  // namespace ssphh::test
