/// A LightSet's emitters one by one, and posed anew.

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "light_scenes.h"

namespace ssphh::shading::test {
namespace {

using ssphh::test::means_agree;
using ssphh::test::Samples;

/// One emitter of each kind; the sun and the lamps shine down.
scene::Scene all_kinds() {
  scene::Scene scene;
  add_light(scene, scene::LightType::point, {1, 2, 0});
  add_light(scene, scene::LightType::spot, {-1, 2, 0});
  add_light(scene, scene::LightType::sphere, {0, 3, 1}).radius = 0.4f;
  add_light(scene, scene::LightType::directional, {0, 0, 0}, {0.2f, -1, 0});
  add_light(scene, scene::LightType::directional, {0, 0, 0}, {-0.3f, -1, 0.1f}).angular_radius = 0.1f;
  add_light(scene, scene::LightType::point, {0, 1, 0}).intensity = 0;
  scene::Material glowing;
  glowing.emission = vec3(1, 2, 1);
  scene.materials.push_back(glowing);
  scene::Mesh panel = scene::make_quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1});
  panel.material = 0;
  scene.meshes.push_back(panel);
  scene.instances.push_back({0, add_node(scene, {{0.5f, 2, -1}}, "panel"), -1, {}});
  scene.environment = scene::Environment{};
  return scene;
}

double received(const std::optional<LightSample>& sample) {
  return sample && sample->wi.y > 0 && sample->pdf > 0
             ? static_cast<double>(luminance(sample->radiance) * sample->wi.y / sample->pdf)
             : 0;
}

TEST(Emitters, AddUpToTheChoiceAmongThem) {
  const scene::Scene scene = all_kinds();
  const LightSet lights(scene, scene::world_matrices(scene));
  ASSERT_EQ(lights.emitter_count(), 7) << "the lamp that is off is left out";
  Samples one_by_one, chosen;
  for (std::uint64_t batch = 0; batch < 4000; ++batch) {
    double sum = 0, mean = 0;
    for (std::uint32_t s = 0; s < 16; ++s) {
      SampleSequence random(batch, s);
      for (int i = 0; i < lights.sample_count(); ++i) {
        const float u_choice = random.next();
        mean += received(lights.sample(i, vec3(0), u_choice, random.next2())) / 16;
      }
    }
    for (int i = 0; i < lights.emitter_count(); ++i)
      sum += received(lights.sample_emitter(i, vec3(0), SampleSequence(hash_combine(batch, 77), 0).next2()));
    one_by_one.add(sum), chosen.add(mean);
  }
  EXPECT_TRUE(means_agree(one_by_one, chosen));
}

TEST(Emitters, HaveTheFluxOfTheirClosedForms) {
  scene::Scene scene;
  const vec3 color(0.2f, 0.7f, 0.4f);
  const double l = double{luminance(color)};
  const auto add = [&](scene::LightType type, float intensity) -> scene::Light& {
    scene::Light& light = add_light(scene, type, {0, 2, 0});
    light.color = color, light.intensity = intensity;
    return light;
  };
  add(scene::LightType::point, 3);
  scene::Light& spot = add(scene::LightType::spot, 5);
  spot.inner_cone = 0.3f, spot.outer_cone = 0.8f;
  add(scene::LightType::sphere, 7).radius = 0.4f;
  scene::Material panel = glowing(2.0f * color);
  add_panel(scene, panel, {{0, 1, 0}, quat(1, 0, 0, 0), {2, 1, 3}});
  panel.double_sided = true;
  add_panel(scene, panel, {{0, 1, 0}, quat(1, 0, 0, 0), {1, 1, 3}});
  add(scene::LightType::directional, 11);
  add(scene::LightType::directional, 13).angular_radius = 0.2f;
  scene.environment = scene::Environment{};
  scene.environment->color = color;
  const LightSet lights = make_lights(scene);
  // A spot's (c − c_o)²/(c_i − c_o)² integrates to a third of the cosines between its cones. A panel of
  // radiance L emits π L per square metre and side. Through a sphere of radius r goes π r² ∫ L dω: of a disc
  // that gives E = π L sin² α that is 2 E/(1 + cos α), of a sky 4π L.
  constexpr double radius = 1.5, disc = pi_d * radius * radius;
  const double cone = 1 - std::cos(0.3) + (std::cos(0.3) - std::cos(0.8)) / 3;
  const double expected[] = {
      4 * pi_d * 3,     2 * pi_d * cone * 5, 4 * pi_d * pi_d * 0.16 * 7,          pi_d * 2 * 6,
      2 * pi_d * 2 * 3, 11 * disc,           13 * disc * 2 / (1 + std::cos(0.2)), 4 * pi_d * disc};
  ASSERT_EQ(lights.emitter_count(), 8);
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(double{lights.flux(i, static_cast<float>(radius))} / (l * expected[i]), 1, 2e-6) << i;
}

TEST(Emitters, ExtentHoldsAllSamples) {
  const scene::Scene scene = all_kinds();
  const LightSet lights(scene, scene::world_matrices(scene));
  for (int i = 0; i < lights.emitter_count(); ++i) {
    const Emitter emitter = lights.emitter(i);
    for (std::uint32_t s = 0; s < 500; ++s) {
      const auto sample = lights.sample_emitter(i, vec3(0.1f, 0, 0.2f), SampleSequence(3, s).next2());
      ASSERT_TRUE(sample);
      EXPECT_EQ(sample->group, emitter.group);
      EXPECT_EQ(sample->delta, emitter.delta());
      EXPECT_TRUE(!emitter.delta() || sample->pdf == 1);
      const vec3 p = emitter.distant() ? sample->wi : vec3(0.1f, 0, 0.2f) + sample->distance * sample->wi;
      EXPECT_LE(max_component(emitter.extent.min - p), 1e-6f) << i;
      EXPECT_LE(max_component(p - emitter.extent.max), 1e-6f) << i;
      if (emitter.distant() && !emitter.delta()) {
        const auto hit = lights.distant_radiance(i, sample->wi);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->pdf, sample->pdf);
        EXPECT_EQ(hit->radiance, sample->radiance);
      }
    }
  }
}

TEST(Emitters, PosedAnewTheyAreThoseOfTheSceneThatStandsSo) {
  scene::Scene scene = all_kinds();
  const std::vector<mat4> before = scene::world_matrices(scene);
  const LightSet base(scene, before);
  scene::Scene moved = scene;
  moved.nodes.back().local.translation = vec3(1, 2.5f, 0);
  moved.lights[0].intensity = 3, moved.lights[0].color = vec3(1, 0, 2);
  moved.lights[1].intensity = 0;
  moved.lights[5].intensity = 2;
  moved.nodes[2].local.translation = vec3(2, 2, 2);
  const std::vector<mat4> after = scene::world_matrices(moved);
  const LightSet expected(moved, after);
  std::vector<scene::LightState> states;
  for (const scene::Light& light : moved.lights)
    states.push_back({after[light.node], light.color, light.intensity});
  const LightSet posed(base, after, states);
  ASSERT_EQ(posed.emitter_count(), expected.emitter_count());
  EXPECT_EQ(posed.groups(), expected.groups());
  for (int i = 0; i < posed.emitter_count(); ++i) {
    EXPECT_EQ(posed.emitter(i).kind, expected.emitter(i).kind);
    for (std::uint32_t s = 0; s < 10; ++s) {
      const vec2 u = SampleSequence(1, s).next2();
      const auto a = posed.sample_emitter(i, vec3(0), u), b = expected.sample_emitter(i, vec3(0), u);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      EXPECT_EQ(a->wi, b->wi);
      EXPECT_EQ(a->radiance, b->radiance);
      EXPECT_EQ(a->pdf, b->pdf);
      EXPECT_EQ(a->group, b->group);
    }
  }
}

TEST(Emitters, SendTheirPhotonsFromWhereTheyAre) {
  scene::Scene scene;
  add_light(scene, scene::LightType::point, {1, 2, 3});
  add_light(scene, scene::LightType::spot, {4, 5, 6});
  add_light(scene, scene::LightType::sphere, {0, 7, 0}).radius = 0.4f;
  add_light(scene, scene::LightType::sphere, {0, 8, 0}).radius = 0.2f;
  add_panel(scene, glowing(vec3(1)), {{0, 9, 0}});
  add_panel(scene, glowing(vec3(3)), {{0, 10, 0}});
  const LightSet lights = make_lights(scene);
  ASSERT_EQ(lights.emitter_count(), 6);
  for (int i = 0; i < 6; ++i) {
    const scene::Bounds extent = lights.emitter(i).extent;
    Samples power;
    for (std::uint32_t s = 0; s < 4000; ++s) {
      SampleSequence random(7, s);
      const vec2 place = random.next2(), direction = random.next2();
      const auto emitted = lights.emit(i, place, direction, vec3(0), 1);
      if (!emitted) {
        power.add(0);
        continue;
      }
      const rays::Photon& photon = emitted->photon;
      power.add(static_cast<double>(luminance(photon.power)));
      EXPECT_LE(max_component(extent.min - photon.origin), 1e-5f) << i;
      EXPECT_LE(max_component(photon.origin - extent.max), 1e-5f) << i;
      EXPECT_NEAR(glm::length(photon.direction), 1, 1e-5f);
      EXPECT_EQ(emitted->normal, i < 4 ? vec3(0) : vec3(0, -1, 0));
    }
    const auto flux = static_cast<double>(lights.flux(i, 1));
    EXPECT_TRUE(ssphh::test::mean_is(power, flux, {1e-3, 6}, 1e-4 * flux)) << i;
  }
}

// A disc of parallel rays around the scene; light of under 1 W/m² is light, too.
TEST(Emitters, DistantLampsSendPhotonsHoweverDimTheyAre) {
  for (const float strength : {0.01f, 0.5f, 4.0f}) {
    scene::Scene scene;
    add_light(scene, scene::LightType::directional, {}).intensity = strength;
    const LightSet lights = make_lights(scene);
    const auto emitted = lights.emit(0, vec2(0.3f), vec2(0.6f), vec3(0), 2);
    ASSERT_TRUE(emitted) << strength;
    EXPECT_NEAR(luminance(emitted->photon.power) / lights.flux(0, 2), 1, 1e-5f);
  }
}

}  // namespace
}  // namespace ssphh::shading::test
