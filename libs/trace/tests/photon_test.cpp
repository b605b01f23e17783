/// Photons of every type of light against the irradiance that DirectLight finds: what lands on a patch of
/// floor is what the patch receives.

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/trace/transport_scene.h>

#include "chi2.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

constexpr float half_floor = 2;  // the floor is [−2, 2]² at y = 0, front up
constexpr int cells = 6;         // along each axis of the tested part
constexpr float half_tested = 1.5f;

void add_quad(scene::Scene& scene, const vec3& corner, const vec3& u, const vec3& v, const vec3& emission,
              bool double_sided = false) {
  scene::Material material;
  material.emission = emission, material.double_sided = double_sided;
  scene.materials.push_back(material);
  scene.meshes.push_back(scene::make_quad(corner, u, v));
  scene.meshes.back().material = static_cast<int>(scene.materials.size()) - 1;
  scene::Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1, instance.node = 0;
  instance.light_group = "lamp";
  scene.instances.push_back(instance);
}

scene::Light lamp(scene::LightType type, float intensity) {
  scene::Light light;
  light.name = light.group = "lamp";
  light.type = type, light.intensity = intensity, light.color = {1, 0.7f, 0.4f}, light.node = 1;
  return light;
}

struct Case {
  const char* name;
  std::function<void(scene::Scene&)> light;
  bool equal_power = false;  ///< all photons carry the same power
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

/// The lamp's node stands at (0.3, 1.2, −0.2), turned to shine down and a little aside.
std::vector<Case> lamps_and_suns() {
  using scene::LightType;
  return {
      {"point", [](scene::Scene& s) { s.lights.push_back(lamp(LightType::point, 5)); }, true},
      {"pointOfLimitedRange",
       [](scene::Scene& s) { s.lights.push_back(lamp(LightType::point, 5)), s.lights.back().range = 1.8f; }},
      {"spot",
       [](scene::Scene& s) {
         s.lights.push_back(lamp(LightType::spot, 5));
         s.lights.back().inner_cone = 0.3f, s.lights.back().outer_cone = 0.8f;
       }},
      {"profile",
       [](scene::Scene& s) {
         s.lights.push_back(lamp(LightType::point, 5));
         s.lights.back().profile = {"p", std::make_shared<const scene::PhotometricTable>(
                                             scene::PhotometricTable{scene::Photometry::c,
                                                                     {0, 30, 70, 180},
                                                                     {0, 180, 360},
                                                                     {9, 8, 0, 0, 9, 2, 1, 3, 9, 8, 0, 0}})};
       }},
      {"sphere",
       [](scene::Scene& s) { s.lights.push_back(lamp(LightType::sphere, 3)), s.lights.back().radius = 0.4f; },
       true},
      {"sphl",
       [](scene::Scene& s) {
         scene::Light light = lamp(LightType::sphl, 6);
         light.radius = 0.2f;
         light.emission.frames = {scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, 0.5f)};
         s.lights.push_back(light);
       }},
      {"directional", [](scene::Scene& s) { s.lights.push_back(lamp(LightType::directional, 2)); }, true},
      {"sunDisc",
       [](scene::Scene& s) {
         s.lights.push_back(lamp(LightType::directional, 2)), s.lights.back().angular_radius = 0.3f;
       },
       true},
      {"mesh",
       [](scene::Scene& s) {
         add_quad(s, {-0.5f, 1, -0.5f}, {0.8f, 0, 0}, {0, 0, 1}, {4, 3, 2});
       },
       true},
      {"doubleSidedMesh",
       [](scene::Scene& s) {
         add_quad(s, {-0.5f, 0.5f, -0.5f}, {0.8f, 0, 0}, {0, 0.7f, 1}, {4, 3, 2}, true);
       }},
      {"constantSky",
       [](scene::Scene& s) {
         s.environment.emplace().group = "lamp", s.environment->color = {1, 2, 3};
       },
       true},
      {"imageOfTheSky",
       [](scene::Scene& s) {
         s.environment.emplace().group = "lamp";
         image::Image& sky = s.environment->equirect = image::Image(8, 4, 3);
         for (int y = 0; y < 4; ++y) {
           for (int x = 0; x < 8; ++x) {
             for (int c = 0; c < 3; ++c) sky.at(x, y)[c] = static_cast<float>(1 + (x * 3 + y * 5 + c) % 7);
           }
         }
       }},
      {"severalInOneGroup",
       [](scene::Scene& s) {
         s.lights.push_back(lamp(LightType::point, 2));
         s.lights.push_back(lamp(LightType::spot, 8));
         s.lights.push_back(lamp(LightType::directional, 1));
         add_quad(s, {-0.5f, 1, -0.5f}, {0.8f, 0, 0}, {0, 0, 1}, {4, 3, 2});
       }},
  };
}

class PhotonsOf : public testing::TestWithParam<Case> {
 protected:
  PhotonsOf() {
    scene.nodes.resize(2);
    scene.nodes[1].local.translation = {0.3f, 1.2f, -0.2f};
    scene.nodes[1].local.rotation = glm::angleAxis(-1.3f, vec3(1, 0, 0));
    add_quad(scene, {-half_floor, 0, half_floor}, {2 * half_floor, 0, 0}, {0, 0, -2 * half_floor}, vec3(0));
    GetParam().light(scene);
    scene::validate(scene);
  }
  scene::Scene scene;
};

TEST_P(PhotonsOf, LandAsIrradianceSays) {
  const trace::TransportScene source(scene, {.light_samples = 256, .environment_samples = 1024});
  const auto lights = source.direct_light(source.lights(0), std::vector<mat4>{mat4(1)});
  int group = 0;
  while (source.light_groups()[group] != "lamp") ++group;

  // What each cell receives, by midpoints.
  constexpr int q = 8;
  constexpr float step = 2 * half_tested / (cells * q);
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < cells * q; ++i) {
    for (int k = 0; k < cells * q; ++k) {
      points.push_back({{-half_tested + (static_cast<float>(i) + 0.5f) * step, 0,
                         -half_tested + (static_cast<float>(k) + 0.5f) * step},
                        {0, 1, 0}});
    }
  }
  std::vector<vec3> irradiance(points.size());
  lights->irradiance(group, points, irradiance);
  std::vector<double> received(cells * cells);
  for (int i = 0; i < cells * q; ++i) {
    for (int k = 0; k < cells * q; ++k) {
      received[i / q * cells + k / q] +=
          static_cast<double>(irradiance[i * cells * q + k].g) * static_cast<double>(step * step);
    }
  }

  // What photons bring.
  constexpr int count = 40000;
  Pcg32 random(7);
  std::vector<Samples> landed(received.size());
  std::vector<double> counted(received.size() + 1);
  Samples flux;
  double power_of_each = 0;
  for (int n = 0; n < count; ++n) {
    rays::PhotonNumbers numbers;
    numbers.emitter = random.uniform(), numbers.place = random.uniform2(),
    numbers.direction = random.uniform2();
    const auto photon = lights->emit(group, numbers);
    flux.add(photon ? double(luminance(photon->power)) : 0);
    if (photon) power_of_each = double(photon->power.g);
    std::size_t cell = received.size();
    double power = 0;
    if (photon && photon->origin.y > 0 && photon->direction.y < 0) {
      const float distance = -photon->origin.y / photon->direction.y;
      const rays::RayQuery way{photon->origin, photon->direction, 0.9999f * distance};
      std::uint8_t blocked = 0;
      source.occluded(0, {&way, 1}, {&blocked, 1});
      const vec3 at = photon->origin + distance * photon->direction;
      const int i = static_cast<int>(std::floor((at.x + half_tested) / (step * q)));
      const int k = static_cast<int>(std::floor((at.z + half_tested) / (step * q)));
      power = double(photon->power.g * photon->range_share(distance));
      if (!blocked && i >= 0 && i < cells && k >= 0 && k < cells)
        cell = static_cast<std::size_t>(i * cells + k);
    }
    for (std::size_t c = 0; c < landed.size(); ++c) landed[c].add(c == cell ? power : 0);
    counted[cell] += 1;
  }

  const Significance significance{1e-3, 11 * cells * cells};
  double all = 0, largest = 0;
  for (const double r : received) all += r, largest = std::max(largest, r);
  ASSERT_GT(all, 0);
  for (std::size_t c = 0; c < landed.size(); ++c) {
    // Midpoints and the light's own samples: a hundredth of the brightest cell.
    EXPECT_TRUE(mean_is(landed[c], received[c], significance, 0.01 * largest)) << "cell " << c;
  }
  // flux() shares photons out: a tenth off does no harm, and the sun's disc is narrower than its cone.
  EXPECT_NEAR(flux.mean() / double(lights->flux(group)), 1, 0.1);

  if (!GetParam().equal_power) return;
  std::vector<double> expected;
  for (const double r : received) expected.push_back(count * r / power_of_each);
  expected.push_back(count * (1 - all / power_of_each));
  const Chi2Result chi2 = chi2_of_counts(counted, expected);
  EXPECT_GE(chi2.p, 1e-4) << "χ² " << chi2.statistic << " with " << chi2.degrees << " degrees";
}

INSTANTIATE_TEST_SUITE_P(EveryLight, PhotonsOf, testing::ValuesIn(lamps_and_suns()),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(EmitterPlaces, LieOnSmallEmittersMoreOfThemWhereMoreLightLeaves) {
  scene::Scene scene;
  scene.nodes.resize(2);
  scene.nodes[1].local.translation = {0, 2, 0};
  add_quad(scene, {-10, 3, 0}, {1, 0, 0}, {0, 0, 1}, vec3(1));
  add_quad(scene, {10, 3, 0}, {1, 0, 0}, {0, 0, 1}, vec3(3));
  scene.lights.push_back(lamp(scene::LightType::point, 0.01f));
  scene.lights.push_back(lamp(scene::LightType::directional, 1));
  const trace::TransportScene source(scene);
  const auto light = source.direct_light(source.lights(0), std::vector<mat4>{mat4(1)});
  const std::vector<vec3> places = light->emitter_places(0, 1, 100);
  const auto within = [&](float x) {
    return std::ranges::count_if(
        places, [&](const vec3& p) { return p == glm::clamp(p, vec3(x, 3, 0), vec3(x + 1, 3, 1)); });
  };
  EXPECT_NEAR(static_cast<double>(within(-10)), 25, 1);
  EXPECT_NEAR(static_cast<double>(within(10)), 75, 1);
  EXPECT_EQ(static_cast<std::size_t>(within(-10) + within(10)), places.size()) << "points have no surface";
  EXPECT_EQ(places, light->emitter_places(0, 1, 100));
  EXPECT_TRUE(light->emitter_places(0, 0.9f, 100).empty()) << "both are wider";
}

}  // namespace
}  // namespace ssphh::test
