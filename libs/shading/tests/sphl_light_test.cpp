/// SPHLs that shine: what arrives from them, and where their photons go.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

#include "chi2.h"
#include "light_scenes.h"
#include "lights/punctual_lights.h"
#include "lights/shaped_intensity.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using ssphh::test::directions_follow;
using ssphh::test::Significance;

scene::Light& add_sphl(scene::Scene& scene, const vec3& position, const vec3& direction, float radius) {
  scene::Light& light = add_light(scene, LightType::sphl, position, direction);
  light.radius = radius;
  return light;
}

// A lobe straight down at height h, at x beside the foot: I(θ) cos θ / d² with cos θ = h/d.
TEST(SphlLight, ALobeGivesAPlaneItsIntensityTimesCosineOverDistanceSquared) {
  scene::Scene scene;
  scene::Light& light = add_sphl(scene, {0, 3, 0}, {0, -1, 0}, 0.1f);
  light.emission.frames = {scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, 0.6f)};
  light.color = {1, 0.5f, 0.25f}, light.intensity = 40;
  const LightSet lights = make_lights(scene);
  const double kappa = std::log(2.0) / (1 - std::cos(0.6));
  for (const float aside : {0.0f, 0.5f, 1.0f, 2.0f, 4.0f}) {
    const auto s = lights.sample(0, {aside, 0, 0}, 0.3f, vec2(0.5f));
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->delta);
    const double d = std::hypot(3.0, static_cast<double>(aside)), cosine = 3 / d;
    // Degree 10 leaves out bands of weight exp(−l (l + 1) / 2κ), l > 10: below 2e-8 at κ = 3.97
    const double expected = 40 * std::exp(kappa * (cosine - 1)) * cosine / (d * d);
    const vec3 e = s->radiance * glm::dot(s->wi, up);
    EXPECT_NEAR(static_cast<double>(e.x), expected, 1e-5 * 40 / 9);
    EXPECT_FLOAT_EQ(e.y, 0.5f * e.x);
    EXPECT_FLOAT_EQ(e.z, 0.25f * e.x);
    EXPECT_FLOAT_EQ(s->distance, static_cast<float>(d) - 0.1f) << "what stands within it shadows nothing";
  }
}

TEST(SphlLight, ACosineLobeIsThatOfASmallSurface) {
  scene::Scene scene;
  add_sphl(scene, {0, 2, 0}, {0, -1, 0}, 0.01f).emission.frames = {
      scene::lobe_emission(scene::Lobe::cosine, {0, 0, -1}, 0)};
  const LightSet lights = make_lights(scene);
  for (const float aside : {0.0f, 1.0f, 2.0f}) {
    const auto s = lights.sample(0, {aside, 0, 0}, 0, vec2(0));
    ASSERT_TRUE(s);
    const float d2 = 4 + aside * aside;
    EXPECT_NEAR(s->radiance.x, 2 / std::sqrt(d2) / d2,
                0.015f * 0.25f);  // of the bands above 10, 1.0 % on the axis
  }
  const auto behind = lights.sample(0, {0, 4, 0}, 0, vec2(0));
  EXPECT_TRUE(!behind || behind->radiance.x < 0.015f * 0.25f);
}

TEST(SphlLight, IsNoBrighterWithinItsRadius) {
  scene::Scene scene;
  add_sphl(scene, vec3(0), {0, -1, 0}, 0.5f).emission.frames = {
      scene::lobe_emission(scene::Lobe::uniform, {0, 0, -1}, 0)};
  const LightSet lights = make_lights(scene);
  for (const float d : {0.5f, 0.1f, 0.001f}) {
    const auto s = lights.sample(0, {0, -d, 0}, 0, vec2(0));
    ASSERT_TRUE(s);
    EXPECT_FLOAT_EQ(s->radiance.x, 4);
    EXPECT_EQ(s->distance, 0);
  }
  EXPECT_FALSE(lights.sample(0, vec3(0), 0, vec2(0)));
}

TEST(SphlLight, TurnsWithItsNodeWhoseScaleDoesNotCount) {
  scene::Scene scene;
  scene::Light& light = add_sphl(scene, vec3(0), {1, 0, 0}, 0.1f);
  light.emission.frames = {scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, 0.5f)};
  scene.nodes[0].local.scale = {2, 7, 0.3f};
  const LightSet lights = make_lights(scene);
  const auto ahead = lights.sample(0, {2, 0, 0}, 0, vec2(0)), aside = lights.sample(0, {0, 0, 2}, 0, vec2(0));
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->radiance.x, 0.25f, 1e-4f);
  EXPECT_TRUE(!aside || aside->radiance.x < 1e-3f);
}

TEST(SphlLight, ChangesWithTimeAndWithItsState) {
  scene::Scene scene;
  scene::Light& light = add_sphl(scene, vec3(0), {0, -1, 0}, 0.1f);
  light.emission.frames = {sh::IntensitySh(0), sh::IntensitySh(0)};
  light.emission.frames[0][0] = vec3(0), light.emission.frames[1][0] = vec3(std::sqrt(4 * pi), 0, 0);
  light.emission.rate = 2;
  const auto world = scene::world_matrices(scene);
  const auto red = [](const LightSet& lights) {
    return lights.empty() ? 0 : lights.sample(0, {0, -1, 0}, 0, vec2(0))->radiance.x;
  };
  EXPECT_EQ(red(LightSet(scene, world)), 0);
  EXPECT_FLOAT_EQ(red(LightSet(scene, world, 0.125f)), 0.25f);
  const LightSet base(scene, world);
  std::vector<scene::LightState> states = scene::lighting_at(scene, 0.25f).lights;
  EXPECT_FLOAT_EQ(red(LightSet(base, world, states)), 0.5f);
  states[0].emission[0] *= vec3(8);
  EXPECT_FLOAT_EQ(red(LightSet(base, world, states)), 4);
  states[0].emission = {};
  EXPECT_EQ(red(LightSet(base, world, states)), 0) << "dark";
}

sh::IntensitySh made_up() {
  sh::IntensitySh emission = scene::lobe_emission(scene::Lobe::beam, glm::normalize(vec3(1, 2, -2)), 0.4f);
  const sh::IntensitySh other = scene::lobe_emission(scene::Lobe::cosine, glm::normalize(vec3(-1, 0, 1)), 0);
  for (std::size_t k = 0; k < emission.values.size(); ++k)
    emission.values[k] = emission.values[k] * vec3(3, 2, 1) + other.values[k] * vec3(0.2f, 0.5f, 1);
  return emission;
}

TEST(ShapedIntensity, SamplesAreAsOftenAsTheirDensitySays) {
  const mat4 turned(glm::mat4_cast(pointing({1, 3, -2})));
  const ShapedIntensity shape(made_up(), turned);
  // Cells of the test that are not those of the sampler: its density jumps within them
  const ssphh::test::DirectionCells cells{.axis = glm::normalize(vec3(1, 1, 1)), .quadrature = 40};
  EXPECT_TRUE(directions_follow(
      [&](Pcg32& random) { return std::optional(shape.sample(random.uniform2()).direction); },
      [&](const vec3& d) { return shape.pdf(d); }, cells, 7, Significance{}));
  Pcg32 random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto chosen = shape.sample(random.uniform2());
    EXPECT_NEAR(glm::length(chosen.direction), 1, 1e-5f);
    EXPECT_GT(chosen.pdf, 0);
  }
}

TEST(ShapedIntensity, SamplesAreWhereItShines) {
  // Of directions chosen by its density alone each is worth the same; even ones differ by 8.7 times the
  // square of a beam's mean, ∫ I² / (∫ I)² with I = exp(κ (cos θ − 1)), κ = 8.8. A cell's middle stands for
  // it all, and a twentieth of the mean goes to where it is dark.
  const mat4 turned(glm::mat4_cast(pointing({1, 3, -2})));
  const ShapedIntensity shape(made_up(), turned);
  Pcg32 random(11);
  constexpr int count = 20000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const auto chosen = shape.sample(random.uniform2());
    const auto worth = double(luminance(shape.toward(chosen.direction)) / chosen.pdf);
    sum += worth, squares += worth * worth;
  }
  const double spread = squares * count / (sum * sum) - 1;
  RecordProperty("spread", std::to_string(spread));
  EXPECT_LT(spread, 0.1);
}

// ∫ I dω by photons and by the mean; a beam's flux in closed form: 2π (1 − exp(−2κ)) / κ.
TEST(ShapedIntensity, PhotonsCarryItsFlux) {
  const float half_angle = 0.5f;
  PosedLight posed;
  posed.light.type = LightType::sphl, posed.light.radius = 0.3f, posed.light.color = {1, 0.5f, 0.1f};
  posed.emission = scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, half_angle);
  const PointLight light = make_sphl_light(posed, 0);
  const double kappa = std::log(2.0) / (1 - std::cos(static_cast<double>(half_angle)));
  const double flux = 2 * pi_d * (1 - std::exp(-2 * kappa)) / kappa;
  ssphh::test::Samples samples;
  Pcg32 random(5);
  for (int i = 0; i < 20000; ++i) {
    const rays::Photon photon = light.emit(random.uniform2());
    EXPECT_NEAR(glm::length(photon.origin), 0.3f, 1e-5f);
    EXPECT_FLOAT_EQ(photon.power.y, 0.5f * photon.power.x);
    samples.add(static_cast<double>(photon.power.x));
  }
  EXPECT_TRUE(ssphh::test::mean_is(samples, flux));
  EXPECT_NEAR(static_cast<double>(light.shape->mean().x) * 4 * pi_d / flux, 1, 1e-4);
}

}  // namespace
}  // namespace ssphh::shading::test
