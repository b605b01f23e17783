/// Emissive triangles seen from a point: closed form against sampling by area, and samples by solid angle.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/shading/mesh_view.h>

#include "light_scenes.h"

namespace ssphh::shading::test {
namespace {

using ssphh::test::mean_is;
using ssphh::test::Samples;

scene::Scene emissive(scene::Mesh mesh, bool double_sided = false) {
  scene::Scene scene;
  scene::Material material;
  material.emission = vec3(2, 1, 3);
  material.double_sided = double_sided;
  scene.materials.push_back(material);
  mesh.material = 0;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({0, add_node(scene, {}, "lamp"), -1, {}});
  return scene;
}

/// Irradiance means of 16 samples each: by LightSet's area sampling, and by the view's.
struct Estimates {
  double closed_form;
  Samples by_area, by_view;
};
Estimates estimates(const scene::Scene& scene, const vec3& position, const vec3& normal) {
  const LightSet lights(scene, {mat4(1)});
  const auto view = lights.view_mesh(0, position, normal);
  Estimates result{static_cast<double>(view->irradiance().x), {}, {}};
  for (std::uint64_t batch = 0; batch < 4000; ++batch) {
    double area = 0, solid = 0;
    for (std::uint32_t s = 0; s < 16; ++s) {
      const vec2 u = SampleSequence(batch, s).next2();
      const auto value = [&](const std::optional<LightSample>& sample) {
        if (!sample) return 0.0;
        return static_cast<double>(sample->radiance.x * std::max(glm::dot(sample->wi, normal), 0.0f) /
                                   sample->pdf);
      };
      area += value(lights.sample_emitter(0, position, u)) / 16;
      const auto sample = view->sample(u);
      solid += value(sample) / 16;
      // Cut off at the horizon.
      if (sample) {
        EXPECT_GE(glm::dot(sample->wi, normal), -1e-6f);
      }
    }
    result.by_area.add(area), result.by_view.add(solid);
  }
  return result;
}

TEST(MeshView, ClosedFormIsTheMeanOfSamples) {
  const scene::Scene panel = emissive(scene::make_quad(vec3(-1, 1, -1), vec3(2, 0, 0), vec3(0, 0, 1.5f)));
  const scene::Scene box = emissive(scene::make_box(vec3(-0.5f, 0.2f, -0.5f), vec3(0.5f, 1, 0.5f)));
  const scene::Scene both =
      emissive(scene::make_quad(vec3(-1, 1, -1), vec3(0, 0, 2), vec3(2, 0.3f, 0)), true);
  const struct {
    const scene::Scene& scene;
    vec3 position, normal;
  } cases[] = {{panel, vec3(0), vec3(0, 1, 0)},
               {panel, vec3(0.3f, 0.5f, 0), glm::normalize(vec3(1, 0.3f, 0.2f))},
               {panel, vec3(20, -30, 5), glm::normalize(vec3(-0.2f, 1, 0))},
               {box, vec3(0.9f, 0.3f, 0.2f), glm::normalize(vec3(-1, 0.5f, 0.3f))},
               {both, vec3(0.5f, 0, 0), vec3(0, 1, 0)},
               {both, vec3(0.5f, 2, 0), glm::normalize(vec3(-1, -0.5f, 0))}};
  int index = 0;
  for (const auto& [scene, position, normal] : cases) {
    const Estimates e = estimates(scene, position, normal);
    EXPECT_GT(e.closed_form, 0) << index;
    EXPECT_TRUE(mean_is(e.by_area, e.closed_form, {1e-3, 12}, 1e-5 * e.closed_form)) << "case " << index;
    EXPECT_TRUE(mean_is(e.by_view, e.closed_form, {1e-3, 12}, 1e-5 * e.closed_form)) << "case " << index;
    EXPECT_LT(e.by_view.variance(), 1.05 * e.by_area.variance() + 1e-9) << "case " << index;
    ++index;
  }
}

TEST(MeshView, InsideAGlowingBoxItIsPi) {
  const scene::Scene scene = emissive(scene::flipped(scene::make_box(vec3(-1), vec3(1))));
  const LightSet lights(scene, {mat4(1)});
  Pcg32 random(4);
  for (int i = 0; i < 200; ++i) {
    // Up to a millionth of a metre from the walls: float coordinates end there.
    vec3 position = 1.998f * random.uniform3() - 0.999f;
    if (i % 2) position.x = -1 + 1e-6f;
    const vec3 normal = i % 2 ? vec3(1, 0, 0) : sample_uniform_sphere(random.uniform2());
    EXPECT_NEAR(lights.view_mesh(0, position, normal)->irradiance().y, pi, 2e-5f);
  }
}

TEST(MeshView, FarAwayItIsAreaTimesCosinesOverSquaredDistance) {
  const scene::Scene scene =
      emissive(scene::make_quad(vec3(-5e-4f, 100, -5e-4f), vec3(1e-3f, 0, 0), vec3(0, 0, 1e-3f)));
  const LightSet lights(scene, {mat4(1)});
  const auto view = lights.view_mesh(0, vec3(0), vec3(0, 1, 0));
  const double expected = 1e-6 / 1e4 * 2;
  EXPECT_NEAR(static_cast<double>(view->irradiance().x), expected, 1e-4 * expected) << "vertices are floats";
  const auto sample = view->sample(vec2(0.3f, 0.6f));
  EXPECT_NEAR(sample->distance, 100, 1e-4);
}

TEST(MeshView, SamplesLieOnTheMesh) {
  const scene::Scene scene = emissive(scene::make_box(vec3(-0.5f, 0.2f, -0.5f), vec3(0.5f, 1, 0.5f)));
  const LightSet lights(scene, {mat4(1)});
  const vec3 position(0.9f, -0.3f, 0.2f);
  const auto view = lights.view_mesh(0, position, vec3(0, 1, 0));
  for (std::uint32_t s = 0; s < 1000; ++s) {
    const auto sample = view->sample(SampleSequence(1, s).next2());
    ASSERT_TRUE(sample);
    const vec3 p = position + sample->distance * sample->wi;
    // Its lower face or that at +x: the faces toward the point.
    EXPECT_TRUE(std::abs(p.y - 0.2f) < 1e-5f || std::abs(p.x - 0.5f) < 1e-5f);
    EXPECT_LE(max_component(glm::abs(p - vec3(0, 0.6f, 0)) - vec3(0.5f, 0.4f, 0.5f)), 1e-5f);
  }
}

}  // namespace
}  // namespace ssphh::shading::test
