/// Light of the sky as shaders get it: turned as conventions say, in colour.

#include <gtest/gtest.h>

#include <ssphh/scene/scene.h>
#include <ssphh/sh/evaluate.h>

#include "emitter_samples.h"

namespace ssphh::realtime {
namespace {

/// One bright spot each at the image's middle, +X, red, and at u = 3/4, +Z, green; blue above, +Y.
scene::Environment three_spots(float rotation) {
  scene::Environment environment;
  environment.equirect = image::Image(64, 32, 3);
  for (int y = 15; y <= 16; ++y) {
    for (int x = 0; x < 2; ++x) {
      environment.equirect.set_rgb(31 + x, y, {50, 0, 0});
      environment.equirect.set_rgb(47 + x, y, {0, 50, 0});
    }
  }
  for (int x = 0; x < 64; ++x) environment.equirect.set_rgb(x, 0, {0, 0, 50});
  environment.color = vec3(1, 0.5f, 2);
  environment.rotation = rotation;
  return environment;
}

vec3 irradiance(const sh::IrradianceSh& sh, const vec3& n) {
  std::array<float, 25> y;
  sh::eval_basis(4, n, y);
  vec3 sum(0);
  for (std::size_t k = 0; k < 25; ++k) sum += y[k] * sh.values[k];
  return sum;
}

TEST(EnvironmentLight, TurnsCounterClockwiseSeenFromAbove) {
  struct Case {
    float rotation;
    vec3 red, green;
  };
  for (const Case& c : {Case{0, {1, 0, 0}, {0, 0, 1}}, Case{pi / 2, {0, 0, -1}, {1, 0, 0}},
                        Case{-pi / 2, {0, 0, 1}, {-1, 0, 0}}}) {
    SCOPED_TRACE(c.rotation);
    const scene::Environment environment = three_spots(c.rotation);
    const auto sh = environment_irradiance(environment);
    // A spot of solid angle ω leaves L ω on what faces it; of the cosine, bands 0 to 4 sum up to 31/32 there
    // and to -1/32 on the far side.
    const float omega = 4 * (2 * pi / 64) * (pi / 32), seen = 31.0f / 32;
    EXPECT_NEAR(irradiance(sh, c.red).r, 50 * omega * seen, 0.01f * 50 * omega);
    EXPECT_NEAR(irradiance(sh, c.green).g, 25 * omega * seen, 0.01f * 25 * omega);
    EXPECT_NEAR(irradiance(sh, -c.red).r, -50 * omega / 32, 0.01f * 50 * omega);
    EXPECT_GT(irradiance(sh, {0, 1, 0}).b, 10 * irradiance(sh, {0, -1, 0}).b);
    // Directions with their shares add up to the same light.
    vec3 red(0), green(0), all(0);
    for (const EnvironmentSample& s : environment_directions(environment, 4096)) {
      red += glm::max(glm::dot(s.direction, c.red), 0.0f) * s.weight;
      green += glm::max(glm::dot(s.direction, c.green), 0.0f) * s.weight;
      all += s.weight;
    }
    EXPECT_NEAR(red.r, 50 * omega, 0.05f * 50 * omega);
    EXPECT_NEAR(green.g, 25 * omega, 0.05f * 25 * omega);
    EXPECT_GT(all.b, 0);
  }
}

TEST(EmitterSamples, AMaterialsMeanEmissionIsThatOfItsTexelsInLinearLight) {
  scene::Scene scene;
  scene::Texture& texture = scene.textures.emplace_back();
  texture.width = 2, texture.height = 1;
  texture.rgba = {255, 0, 188, 255, 0, 0, 188, 0};
  scene::Material material;
  material.emission = vec3(4, 6, 10);
  EXPECT_EQ(mean_emission(scene, material), vec3(4, 6, 10));
  material.emission_texture.texture = 0;
  const vec3 mean = mean_emission(scene, material);
  EXPECT_NEAR(mean.r, 2, 1e-4f);
  EXPECT_EQ(mean.g, 0);
  EXPECT_NEAR(mean.b, 5.03f, 0.01f) << "188 of 255 is half the light: 0.5029";
}

}  // namespace
}  // namespace ssphh::realtime
