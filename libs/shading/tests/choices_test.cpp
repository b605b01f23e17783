/// How likely each light is chosen. No estimate's mean depends on it, but its noise does: densities against
/// what the importance of each light says.

#include <tuple>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/shading/mesh_view.h>

#include "light_scenes.h"
#include "lights/distribution.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;

/// Probability with which sample() chooses the light of a group whose samples are deltas; 0: never.
float probability(const LightSet& lights, const vec3& from, int group) {
  for (int i = 0; i < 1000; ++i) {
    const auto s = lights.sample(0, from, (static_cast<float>(i) + 0.5f) / 1000, vec2(0.5f));
    if (s && s->group == group) return s->pdf;
  }
  return 0;
}

/// Its share of a fifth divided evenly among `active` lights and of the rest by importance.
double chance(double importance, double all, int active) {
  return 0.2 / active + 0.8 * importance / all;
}

// A probe lamp 1 m away, of luminance 1; the other light is weighed against it.
struct Choices : testing::Test {
  scene::Light& add_probe_lamp() { return add_light(scene, LightType::point, {0, 0, 1}); }
  void expect_importance(double other, const char* what) {
    const LightSet lights = make_lights(scene);
    EXPECT_NEAR(static_cast<double>(probability(lights, vec3(0), 0)), chance(1, 1 + other, other > 0 ? 2 : 1),
                1e-5)
        << what;
  }
  scene::Scene scene;
};

TEST_F(Choices, OfAPointLightGoByItsIrradiance) {
  add_probe_lamp();
  add_light(scene, LightType::point, {0, 0, -2}).intensity = 12;
  expect_importance(3, "12 / 2²");
  scene.lights[1].range = 4;
  expect_importance(3 * (1 - 1.0 / 16), "range");
  scene.lights[1].range = 2;
  expect_importance(0, "out of range");
  scene.lights[1].range = 0;
  scene.lights[1].color = vec3(0, 1, 0);
  expect_importance(3 * 0.7152, "luminance of green");
}

TEST_F(Choices, OfASpotGoByItsCone) {
  add_probe_lamp();
  scene::Light& spot = add_light(scene, LightType::spot, {0, 0, -2}, {std::sin(0.3f), 0, std::cos(0.3f)});
  spot.intensity = 12, spot.inner_cone = 0.1f, spot.outer_cone = 0.5f;
  const double share = (std::cos(0.3) - std::cos(0.5)) / (std::cos(0.1) - std::cos(0.5));
  expect_importance(3 * share * share, "between its cones");
  spot.outer_cone = 0.25f;
  expect_importance(0, "outside");
  spot.inner_cone = 0.35f, spot.outer_cone = 0.4f;
  expect_importance(3, "inside");
}

TEST_F(Choices, OfASphereGoByTheSolidAngleOfItsDisc) {
  add_probe_lamp();
  scene::Light& sphere = add_light(scene, LightType::sphere, {0, 0, -2});
  sphere.intensity = 3, sphere.radius = 0.5f;
  expect_importance(3 * pi_d * 0.25 / 4, "outside");
  sphere.radius = 3;
  expect_importance(3 * pi_d, "from inside");
}

// The panel is 1 m² and faces −y; its corners lie √½ from its centre.
TEST_F(Choices, OfAPanelGoByItsSizeAndTheSideThatIsSeen) {
  const double extent2 = 0.5;
  add_probe_lamp();
  add_panel(scene, glowing(vec3(2)), {{0, 2, 0}, quat(1, 0, 0, 0), vec3(1)});
  expect_importance(2 / (4 + extent2), "in front");
  scene.nodes.back().local.translation = {2, 2, 0};
  expect_importance(2 * (0.1 + 0.9 / std::sqrt(2.0)) / (8 + extent2), "at 45°");
  scene.nodes.back().local.translation = {2, 0, 0};
  expect_importance(2 * 0.1 / (4 + extent2), "in its plane");
  scene.nodes.back().local.translation = {2, -6e-5f, 0};
  expect_importance(2 * 0.1 / (4 + extent2), "behind it by rounding");
  scene.nodes.back().local.translation = {2, -9e-5f, 0};
  expect_importance(0, "behind it");
  scene.materials.back().double_sided = true;
  scene.nodes.back().local.translation = {0, -2, 0};
  expect_importance(2 / (4 + extent2), "both sides");
  scene.materials.back().double_sided = false;
  scene.meshes.back().positions[3].y = -0.01f;
  scene.nodes.back().local.translation = {0, -2, 0};
  const LightSet bent = make_lights(scene);
  EXPECT_LT(probability(bent, vec3(0), 0), 0.95f) << "no plane has a back";
}

TEST_F(Choices, OfTrianglesGoByTheLightTheySend) {
  // The first triangle looks up a black texel, the second a white one of as much area.
  scene::Material material = glowing(vec3(4));
  material.emission_texture.texture = 0, material.emission_texture.nearest = true;
  scene.textures.push_back({"halves", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}});
  const int panel = add_panel(scene, material, {{0, 2, 0}, quat(1, 0, 0, 0), vec3(1)});
  scene::Mesh& mesh = scene.meshes[0];
  mesh.positions.push_back(mesh.positions[0]), mesh.positions.push_back(mesh.positions[2]);
  mesh.triangles[1] = {4, 5, 3};
  mesh.uvs[0] = {vec2(0.2f, 0.5f), vec2(0.2f, 0.5f), vec2(0.2f, 0.5f),
                 vec2(0.8f, 0.5f), vec2(0.8f, 0.5f), vec2(0.8f, 0.5f)};
  const auto density = [&](std::uint32_t triangle) {
    // At 2 m, seen along the normal, of ½ m².
    return make_lights(scene).pdf_triangle(vec3(0), panel, triangle, 2, 1) * 0.5f / 4;
  };
  EXPECT_NEAR(density(0), 0.05f / 1.05f, 1e-5f) << "a twentieth of what it would send without its texture";
  EXPECT_NEAR(density(1), 1 / 1.05f, 1e-5f);
  // One of a half that is bright, which it looks up at sixteen points.
  mesh.uvs[0] = {vec2(0.2f, 0.5f), vec2(0.8f, 0.5f), vec2(0.2f, 0.5f),
                 vec2(0.8f, 0.5f), vec2(0.8f, 0.5f), vec2(0.8f, 0.5f)};
  const float ratio = density(0) / density(1);
  // Its second corner weighs over ½ in a quarter of its area; two of the points may fall elsewhere.
  EXPECT_NEAR((ratio - 0.05f) / 0.95f, 0.25f, 2.0f / 16);
  material.emission_texture = {};
  scene.materials[0] = material;
  EXPECT_FLOAT_EQ(density(0), 0.5f);
}

// Seventeen are divided at x = 8.
TEST_F(Choices, OfMoreThanSixteenLightsGoByBoxesOfThemFirst) {
  for (int i = 0; i < 16; ++i)
    add_light(scene, LightType::point, {static_cast<float>(i), 0, 1}).intensity = 1 + static_cast<float>(i);
  const float near = probability(make_lights(scene), vec3(0), 0);
  double all = 0;
  for (int i = 0; i < 16; ++i) all += (1.0 + i) / (1.0 + i * i);
  EXPECT_NEAR(static_cast<double>(near), chance(1, all, 16), 1e-5);
  add_light(scene, LightType::point, {16, 0, 1}).intensity = 17;
  const double left = 36 / (3.5 * 3.5 + 1), right = 117 / (12.0 * 12 + 1);
  double beside = 0;
  for (int i = 0; i < 8; ++i) beside += (1.0 + i) / (1.0 + i * i);
  EXPECT_NEAR(static_cast<double>(probability(make_lights(scene), vec3(0), 0)),
              (0.05 + 0.9 * left / (left + right)) * chance(1, beside, 8), 1e-5);
}

// By power alone the estimate's variance would be 28 times its square.
TEST_F(Choices, UnderARowOfLampsGoToTheNearOnes) {
  const int lamps = 29;
  for (int i = 0; i < lamps; ++i)
    add_light(scene, LightType::point, {0, 4, 30 * static_cast<float>(i)}).color = vec3(1, 0.6f, 0.2f);
  const LightSet lights = make_lights(scene);
  for (const float z : {0.0f, 60.0f, 419.0f, 840.0f}) {
    const vec3 from(1, 0, z);
    vec3 sum(0), squares(0), exact(0);
    const int count = 4096;
    for (int i = 0; i < count; ++i) {
      const auto s =
          lights.sample(0, from, (static_cast<float>(i) + 0.5f) / static_cast<float>(count), vec2(0.5f));
      ASSERT_TRUE(s);
      const vec3 estimate = s->radiance / s->pdf / static_cast<float>(count);
      sum += estimate, squares += estimate * estimate * static_cast<float>(count);
    }
    for (int i = 0; i < lamps; ++i) exact += lights.sample_emitter(i, from, vec2(0.5f))->radiance;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c], exact[c], 0.01f * exact[c]) << z;
      EXPECT_LT(squares[c] / (exact[c] * exact[c]) - 1, 1.5f) << z;  // the most where boxes meet
    }
  }
}

TEST_F(Choices, OfLampsAndOfWhatIsDistantAreNone) {
  EXPECT_EQ(make_lights(scene).sample_count(), 0);
  add_probe_lamp();
  EXPECT_EQ(make_lights(scene).sample_count(), 1);
  add_light(scene, LightType::directional, vec3(0)).intensity = 1000;
  const LightSet lights = make_lights(scene);
  ASSERT_EQ(lights.sample_count(), 2);
  for (int i = 0; i < 2; ++i) {
    const auto s = lights.sample(i, vec3(0), 0.5f, vec2(0.5f));
    ASSERT_TRUE(s);
    EXPECT_EQ(s->group, i);
    EXPECT_EQ(s->pdf, 1);
  }
  scene.lights[0].intensity = 0;
  ASSERT_EQ(make_lights(scene).sample_count(), 1);
  EXPECT_EQ(make_lights(scene).sample(0, vec3(0), 0.5f, vec2(0.5f))->group, 1);
}

// By the irradiance each gives on a facing plane, and a tenth shared out evenly.
TEST_F(Choices, AmongDistantLightsGoByIrradiance) {
  add_light(scene, LightType::directional, vec3(0)).intensity = 3;
  add_light(scene, LightType::directional, vec3(0)).intensity = 1;
  scene.environment = scene::Environment{};
  scene.environment->color = vec3(2);
  scene.environment->name = "sky";
  const double all = 4 + 2 * pi_d;
  const LightSet lights = make_lights(scene);
  EXPECT_NEAR(static_cast<double>(probability(lights, vec3(0), 0)), (3 / all + 0.1 / 3) / 1.1, 1e-5);
  EXPECT_NEAR(static_cast<double>(probability(lights, vec3(0), 1)), (1 / all + 0.1 / 3) / 1.1, 1e-5);
  EXPECT_NEAR(static_cast<double>(probability(lights, vec3(0), 2)),
              (2 * pi_d / all + 0.1 / 3) / 1.1 / (4 * pi_d), 1e-6);
}

// A box is seen from one side of each of its faces at most: half of the samples by area would be for nothing.
TEST_F(Choices, OfABodysTrianglesGoByTheSideThatIsSeen) {
  for (const bool double_sided : {false, true}) {
    scene::Scene scene;
    scene::Mesh box = scene::make_box({-0.5f, 2, -0.5f}, {0.5f, 2.1f, 0.5f});
    box.material = 0;
    scene.meshes.push_back(box);
    scene.materials.push_back(glowing(vec3(2)));
    scene.materials[0].double_sided = double_sided;
    scene.instances.push_back({0, -1, -1, {}});
    const LightSet lights = make_lights(scene);
    for (const vec3& from : {vec3(0), vec3(0.3f, 0, 0.1f), vec3(3, 1.8f, 0), vec3(1, 4, 2)}) {
      int none = 0;
      Pcg32 random(4);
      for (int n = 0; n < 1000; ++n) {
        const float u = random.uniform();
        const auto s = lights.sample(0, from, u, random.uniform2());
        none += s ? 0 : 1;
        if (!s) continue;
        // The triangle that the sample lies on says the same density
        const vec3 at = from + s->distance * s->wi;
        int found = 0;
        for (std::uint32_t t = 0; t < 12; ++t) {
          const uvec3 index = box.triangles[t];
          const vec3 a = box.positions[index.x], b = box.positions[index.y], c = box.positions[index.z];
          const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
          const float cosine = std::abs(glm::dot(normal, s->wi));
          const float pdf = lights.pdf_triangle(from, 0, t, s->distance, cosine);
          if (std::abs(glm::dot(normal, at - a)) < 1e-4f && std::abs(pdf / s->pdf - 1) < 1e-3f) ++found;
        }
        EXPECT_GE(found, 1) << n;
      }
      EXPECT_EQ(none, 0) << "back faces";
      const vec3 up = glm::normalize(vec3(0, 2.05f, 0) - from);
      EXPECT_TRUE(ssphh::test::mean_is(irradiance(lights, from, up),
                                       static_cast<double>(lights.view_mesh(0, from, up)->irradiance().x)));
    }
  }
}

TEST(DistributionChoices, ByWeightsAreThoseOfTheirShares) {
  const float weights[] = {0, 1, 3, 0};
  for (const auto& [u, index, place] : {std::tuple(0.0f, 1u, 0.0f),
                                        {0.2f, 1u, 0.8f},
                                        {0.25f, 2u, 0.0f},
                                        {0.625f, 2u, 0.5f},
                                        {0x1.fffffep-1f, 2u, 1.0f}}) {
    const Distribution::Choice choice = choose_weighted(weights, 4, u);
    EXPECT_EQ(choice.index, index) << u;
    EXPECT_NEAR(choice.u, place, 1e-6f) << u;
    EXPECT_LT(choice.u, 1) << u;
    EXPECT_EQ(choice.probability, index == 1 ? 0.25f : 0.75f) << u;
  }
  // The weights' sum may be a little less than what is said
  EXPECT_EQ(choose_weighted(weights, 4.001f, 0x1.fffffep-1f).index, 2u);
}

TEST(DistributionChoices, EndWhereTheLastWeightDoes) {
  const float weights[] = {1, 3, 0};
  const Distribution d(weights);
  EXPECT_EQ(d.size(), 3u);
  EXPECT_FALSE(d.empty());
  EXPECT_TRUE(Distribution().empty());
  EXPECT_EQ(Distribution().size(), 0u);
  const auto last = d.sample(0x1.fffffep-1f);
  EXPECT_EQ(last.index, 1u);
  EXPECT_EQ(last.probability, 0.75f);
  EXPECT_LT(last.u, 1);
  EXPECT_EQ(d.sample(0.25f).u, 0);
  EXPECT_NEAR(d.sample(0.7f).u, 0.6f, 1e-6f);
  const float broken[] = {std::numeric_limits<float>::infinity(), 2, std::numeric_limits<float>::quiet_NaN(),
                          2};
  EXPECT_EQ(Distribution(broken).probability(1), 0.5f);
  EXPECT_EQ(Distribution(broken).probability(0) + Distribution(broken).probability(2), 0);
}

}  // namespace
}  // namespace ssphh::shading::test
