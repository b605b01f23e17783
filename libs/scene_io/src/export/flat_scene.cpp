#include "flat_scene.h"

#include <ssphh/scene/query.h>

namespace ssphh::scene_io {
namespace {

// Other renderers let a vertex normal decide which side is the front, and so which side glows.
void turn_to_front(scene::Mesh& mesh) {
  std::vector<float> agreement(mesh.normals.size());
  if (agreement.empty()) return;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x];
    const vec3 front = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    for (int c = 0; c < 3; ++c) agreement[t[c]] += glm::dot(front, mesh.normals[t[c]]);
  }
  for (std::size_t i = 0; i < agreement.size(); ++i) {
    if (agreement[i] < 0) mesh.normals[i] = -mesh.normals[i];
  }
}

FlatMesh flat_mesh(const scene::Scene& scene, const scene::Instance& instance, const mat4& world) {
  const scene::Mesh& mesh = scene.meshes[instance.mesh];
  const std::string& name = scene.nodes[instance.node].name;
  FlatMesh flat{name.empty() ? mesh.name : name, scene::instance_material(scene, instance), mesh};
  flat.mesh.tangents.clear();
  for (vec3& p : flat.mesh.positions) p = vec3(world * vec4(p, 1));
  const mat3 to_world = glm::transpose(glm::inverse(mat3(world)));
  for (vec3& n : flat.mesh.normals) n = glm::normalize(to_world * n);
  if (glm::determinant(mat3(world)) < 0) {
    for (uvec3& t : flat.mesh.triangles) std::swap(t.y, t.z);
  }
  turn_to_front(flat.mesh);
  return flat;
}

}  // namespace

FlatScene flatten(const scene::Scene& scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  FlatScene flat;
  for (const scene::Instance& instance : scene.instances) {
    if (scene.meshes[instance.mesh].triangles.empty()) continue;
    flat.meshes.push_back(flat_mesh(scene, instance, world[instance.node]));
  }
  for (const scene::Light& light : scene.lights) {
    const mat4& m = world[light.node];
    vec3 strength = light.color * light.intensity;
    if (light.type == scene::LightType::sphl)
      strength *= scene::mean_intensity(scene::emission_at(light.emission, time));
    if (light.has_profile() && light.type == scene::LightType::point) {
      const scene::PhotometricTable& table = *light.profile.table;
      strength *= scene::mean_candela(table) / scene::greatest_candela(table);
    }
    flat.lights.push_back({&light, m, vec3(m[3]), -glm::normalize(vec3(m[2])), strength});
  }
  return flat;
}

const scene::Material& material_of(const scene::Scene& scene, const FlatMesh& mesh) {
  static const scene::Material standard;
  return mesh.material < 0 ? standard : scene.materials[mesh.material];
}

}  // namespace ssphh::scene_io
