#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

#include "light_scenes.h"
#include "lights/distribution.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using ssphh::test::mean_is;
using ssphh::test::means_agree;
using ssphh::test::Samples;

/// One light of every kind; `points` point lights.
scene::Scene everything(int points) {
  scene::Scene scene;
  for (int i = 0; i < points; ++i) {
    add_light(scene, LightType::point, {static_cast<float>(i % 5) - 2, 2, static_cast<float>(i) / 5})
        .intensity = 1 + static_cast<float>(i % 3);
  }
  auto& spot = add_light(scene, LightType::spot, {-1, 3, 0}, {0.2f, -1, 0});
  spot.intensity = 5;
  auto& sun = add_light(scene, LightType::directional, vec3(0), {0.3f, -1, 0.2f});
  sun.angular_radius = 0.2f;
  add_light(scene, LightType::directional, vec3(0), {-1, -1, 0}).intensity = 0.5f;
  auto& sphere = add_light(scene, LightType::sphere, {1, 2, -1});
  sphere.radius = 0.5f, sphere.intensity = 3;
  add_light(scene, LightType::rectangle, {0.5f, 2, 1}, {-0.2f, -1, 0}).size = {0.7f, 0.3f};
  add_light(scene, LightType::disc, {-1, 1.5f, 1}).radius = 0.4f;
  add_panel(scene, glowing(vec3(2)), {{0, 2.5f, 1}, quat(1, 0, 0, 0), vec3(1)});
  scene.environment = scene::Environment{};
  scene.environment->color = vec3(0.2f);
  return scene;
}

/// The same scene with one light only; −1: the panel, −2: the environment.
scene::Scene only(scene::Scene scene, int light) {
  if (light >= 0) {
    scene.lights = {scene.lights[light]};
  } else {
    scene.lights.clear();
  }
  if (light != -1) scene.instances.clear();
  if (light != -2) scene.environment.reset();
  return scene;
}

TEST(LightSet, IrradianceOfAllLightsIsTheSumOfEach) {
  for (const int points : {1, 30}) {  // few lights are weighed at each point, many chosen by power
    const scene::Scene scene = everything(points);
    const vec3 x(0.2f, 0, 0.1f);
    double sum = 0, variance = 0;
    for (int light = -2; light < static_cast<int>(scene.lights.size()); ++light) {
      const Samples one = irradiance(make_lights(only(scene, light)), x, up, 20000, 77);
      sum += one.mean(), variance += one.variance_of_mean();
    }
    const Samples all = irradiance(make_lights(scene), x, up, 60000);
    EXPECT_TRUE(
        ssphh::test::difference_is_noise(all.mean() - sum, all.variance_of_mean() + variance, {}, 1e-4))
        << points << " point lights: " << all.mean() << " and " << sum;
  }
}

TEST(LightSet, HitsReportTheDensityOfTheirSamples) {
  for (const int points : {1, 30}) {
    const scene::Scene scene = everything(points);
    const LightSet lights = make_lights(scene);
    const vec3 x(0.2f, 0, 0.1f);
    Pcg32 random(2);
    int spheres = 0, distant = 0;
    for (int n = 0; n < 4000; ++n) {
      const float u = random.uniform();
      const auto s = lights.sample(n % 2, x, u, random.uniform2());
      if (!s) continue;
      EXPECT_NEAR(glm::length(s->wi), 1, 1e-5f);
      if (s->delta) continue;
      const auto compare = [&](int& count) {
        return [&](const EmitterHit& hit) {
          if (hit.group != s->group) return;
          ++count;
          EXPECT_NEAR(hit.pdf, s->pdf, 1e-4f * s->pdf);
          EXPECT_EQ(hit.radiance, s->radiance);
        };
      };
      lights.intersect_lamps(x, s->wi, 1e9f, compare(spheres));
      if (std::isinf(s->distance)) lights.escaped(s->wi, compare(distant));
    }
    EXPECT_GT(spheres, 10);
    EXPECT_GT(distant, 100);
  }
}

TEST(LightSet, RaysFindWhatSamplingFinds) {
  // Sphere, disc and environment, nothing blocking: uniform directions must see the same irradiance
  scene::Scene scene = everything(0);
  scene.lights = {scene.lights[1], scene.lights[3]};
  scene.instances.clear();
  const LightSet lights = make_lights(scene);
  Pcg32 random(12);
  Samples by_rays;
  for (int n = 0; n < 100000; ++n) {
    const vec3 d = sample_uniform_sphere(random.uniform2());
    double sum = 0;
    const auto add = [&](const EmitterHit& hit) {
      sum += static_cast<double>(hit.radiance.x * glm::max(d.y, 0.0f) * 4 * pi);
    };
    lights.intersect_lamps(vec3(0), d, 1e9f, add);
    lights.escaped(d, add);
    by_rays.add(sum);
  }
  EXPECT_TRUE(means_agree(by_rays, irradiance(lights, vec3(0), up)));
}

TEST(LightSet, ReportsGroupsOfLightsAndInstances) {
  scene::Scene scene;
  add_light(scene, LightType::point, {0, 1, 0}).group = "lamps";
  add_light(scene, LightType::point, {0, 2, 0}).name = "spare";
  const int panel = add_panel(scene, glowing(vec3(1)), {}, "ceiling");
  scene::Material sign;
  sign.unlit = true;
  const int unlit = add_panel(scene, sign, {}, "sign");
  const int plain = add_panel(scene, scene::Material{}, {}, "floor");
  const LightSet lights = make_lights(scene);
  EXPECT_EQ(lights.groups(), (std::vector<std::string>{"lamps", "spare", "ceiling", "sign"}));
  EXPECT_EQ(lights.instance_group(panel), 2);
  EXPECT_EQ(lights.instance_group(unlit), 3);
  EXPECT_EQ(lights.instance_group(plain), -1);
  EXPECT_EQ(lights.pdf_triangle({0, -1, 0}, unlit, 0, 1, 1), 0) << "unlit surfaces light nothing";
  EXPECT_EQ(lights.pdf_triangle({0, -1, 0}, plain, 0, 1, 1), 0);
  EXPECT_GT(lights.pdf_triangle({0, -1, 0}, panel, 0, 1, 1), 0);
  const auto s = lights.sample(0, {0, 0.9f, 0}, 0, vec2(0));
  ASSERT_TRUE(s);
  EXPECT_EQ(s->group, 0);
}

TEST(LightSet, WithoutLightsGivesNoSamples) {
  scene::Scene scene;
  EXPECT_TRUE(make_lights(scene).empty());
  EXPECT_EQ(make_lights(scene).sample_count(), 0);
  add_light(scene, LightType::point, vec3(1)).intensity = 0;
  add_light(scene, LightType::sphere, vec3(1)).radius = 0;
  EXPECT_TRUE(make_lights(scene).empty());
}

TEST(LightSet, PowerHeuristicsOfTwoStrategiesAddToOne) {
  EXPECT_FLOAT_EQ(power_heuristic(3, 4), 9.0f / 25);
  EXPECT_FLOAT_EQ(power_heuristic(1e30f, 1e25f) + power_heuristic(1e25f, 1e30f), 1);
  EXPECT_EQ(power_heuristic(0, 1), 0);
  EXPECT_EQ(power_heuristic(2, 0), 1);
}

TEST(Distribution, ChoosesInProportionAndRescalesTheNumber) {
  const float weights[] = {0, 1, 0, 3, 0};
  const Distribution d(weights);
  EXPECT_EQ(d.probability(1), 0.25f);
  EXPECT_EQ(d.probability(3), 0.75f);
  EXPECT_EQ(d.probability(0) + d.probability(2) + d.probability(4), 0);
  EXPECT_EQ(d.sample(0).index, 1u);
  EXPECT_EQ(d.sample(0.25f).index, 3u);
  EXPECT_EQ(d.sample(0x1.fffffep-1f).index, 3u);
  EXPECT_FLOAT_EQ(d.sample(0.625f).u, 0.5f);
  const float none[] = {0, -1, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_TRUE(Distribution(none).empty());
}

TEST(LightSet, WithoutSomeGroupsIsTheSetOfAllOthers) {
  for (const int points : {1, 30}) {
    scene::Scene scene = everything(points);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) scene.lights[i].group = i % 2 == 0 ? "even" : "odd";
    scene.instances[0].light_group = "odd";
    const std::vector<mat4> world = scene::world_matrices(scene);
    const LightSet all(scene, world);
    const std::vector<std::string>& groups = all.groups();
    for (const std::vector<std::string>& names :
         std::vector<std::vector<std::string>>{{"even"}, {"odd"}, {"environment"}, {"even", "odd"}, groups}) {
      std::vector<int> indices;
      for (const std::string& name : names) indices.push_back(scene::light_group_index(groups, name));
      const LightSet rest = all.without(indices);
      const auto is_out = [&](const std::string& name) {
        return std::ranges::find(names, name) != names.end();
      };
      scene::Scene smaller = scene;
      std::erase_if(smaller.lights, [&](const scene::Light& light) { return is_out(light.group); });
      if (is_out("odd")) {
        for (scene::Material& material : smaller.materials) material.emission = vec3(0);
      }
      if (is_out("environment")) smaller.environment.reset();
      const LightSet made(smaller, world);
      ASSERT_EQ(rest.emitter_count(), made.emitter_count());
      EXPECT_EQ(rest.empty(), made.empty());
      EXPECT_EQ(rest.groups(), groups) << "indices of groups stay";
      Pcg32 random(3);
      for (int i = 0; i < 200; ++i) {
        const vec3 from = 2.0f * random.uniform3() - vec3(1, 0, 1);
        const float u = random.uniform();
        const vec2 at(random.uniform(), random.uniform());
        ASSERT_EQ(rest.sample_count(), made.sample_count());
        if (rest.empty()) continue;
        const int which = i % rest.sample_count();
        const auto a = rest.sample(which, from, u, at), b = made.sample(which, from, u, at);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_EQ(a->wi, b->wi);
        EXPECT_EQ(a->radiance, b->radiance);
        EXPECT_EQ(a->pdf, b->pdf);
        EXPECT_FALSE(is_out(groups[a->group]));
      }
      for (std::size_t i = 0; i < scene.instances.size(); ++i)
        EXPECT_EQ(rest.instance_group(static_cast<int>(i)),
                  is_out("odd") ? -1 : all.instance_group(static_cast<int>(i)));
    }
  }
}

}  // namespace
}  // namespace ssphh::shading::test
