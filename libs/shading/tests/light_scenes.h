#pragma once
/// Small scenes with one light each, and the irradiance that a LightSet's samples give.

#include <cmath>
#include <optional>
#include <string>

#include <ssphh/core/random.h>
#include <ssphh/shading/lights.h>

#include "z_test.h"

namespace ssphh::shading::test {

inline const vec3 up(0, 1, 0);

inline int add_node(scene::Scene& scene, const scene::Transform& transform,
                    const std::string& name = "node") {
  scene::Node node;
  node.name = name;
  node.local = transform;
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

/// Rotation that turns −z, where lights point, to `direction`.
inline quat pointing(const vec3& direction) {
  const vec3 d = glm::normalize(direction);
  const vec3 axis = glm::cross(vec3(0, 0, -1), d);
  const float s = glm::length(axis), c = -d.z;
  if (s < 1e-6f) return c > 0 ? quat(1, 0, 0, 0) : quat(0, 0, 1, 0);
  return glm::angleAxis(std::atan2(s, c), axis / s);
}

inline scene::Light& add_light(scene::Scene& scene, scene::LightType type, const vec3& position,
                               const vec3& direction = {0, -1, 0}) {
  scene::Light light;
  light.type = type;
  light.name = "light " + std::to_string(scene.lights.size());
  light.node = add_node(scene, {position, pointing(direction), vec3(1)});
  scene.lights.push_back(light);
  return scene.lights.back();
}

/// Unit square around the origin in the plane y = 0 that faces −y, with texture coordinates 0..1, as an
/// instance.
inline int add_panel(scene::Scene& scene, const scene::Material& material, const scene::Transform& transform,
                     const std::string& name = "panel") {
  scene::Mesh mesh;
  mesh.positions = {{-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0.5f, 0, 0.5f}, {-0.5f, 0, 0.5f}};
  mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.materials.push_back(material);
  mesh.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back(mesh);
  scene::Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = add_node(scene, transform, name);
  scene.instances.push_back(instance);
  return static_cast<int>(scene.instances.size()) - 1;
}

inline scene::Material glowing(const vec3& radiance) {
  scene::Material material;
  material.emission = radiance;
  return material;
}

inline LightSet make_lights(const scene::Scene& scene) {
  return {scene, scene::world_matrices(scene)};
}

/// Estimates of the irradiance (red) on a plane through `position`, one per sample.
inline ssphh::test::Samples irradiance(const LightSet& lights, const vec3& position, const vec3& normal,
                                       int count = 20000, std::uint64_t seed = 1) {
  Pcg32 random(seed);
  ssphh::test::Samples samples;
  for (int n = 0; n < count; ++n) {
    double sum = 0;
    for (int i = 0; i < lights.sample_count(); ++i) {
      const float u_choice = random.uniform();
      const auto s = lights.sample(i, position, u_choice, random.uniform2());
      if (s) sum += static_cast<double>(s->radiance.x * glm::max(glm::dot(s->wi, normal), 0.0f) / s->pdf);
    }
    samples.add(sum);
  }
  return samples;
}

}  // namespace ssphh::shading::test
