#include "objects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace ssphh::viewer {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Möller and Trumbore, from either side; infinite: none before `limit`.
float meet(const rays::RayQuery& ray, const vec3& a, const vec3& b, const vec3& c, float limit) {
  constexpr float none = std::numeric_limits<float>::infinity();
  const vec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac);
  const float determinant = glm::dot(ab, p);
  if (determinant == 0) return none;
  const vec3 s = ray.origin - a;
  const float u = glm::dot(s, p) / determinant;
  if (!(u >= 0 && u <= 1)) return none;
  const vec3 q = glm::cross(s, ab);
  const float v = glm::dot(ray.direction, q) / determinant;
  if (!(v >= 0 && u + v <= 1)) return none;
  const float t = glm::dot(ac, q) / determinant;
  return t > 0 && t < limit ? t : none;
}

void add(scene::Bounds& bounds, const scene::Scene& scene, const std::vector<mat4>& world,
         const scene::Instance& instance) {
  for (const vec3& p : scene.meshes[at(instance.mesh)].positions)
    bounds.add(vec3(world[at(instance.node)] * vec4(p, 1)));
}

}  // namespace

std::optional<PickedBody> pick_body(const scene::Scene& scene, const std::vector<mat4>& world,
                                    const rays::RayQuery& ray) {
  std::optional<PickedBody> best;
  float limit = ray.t_max;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    const scene::Mesh& mesh = scene.meshes[at(instance.mesh)];
    const mat4& matrix = world[at(instance.node)];
    // A part that its animation scales to nothing is not there.
    if (std::abs(glm::determinant(mat3(matrix))) < 1e-30f) continue;
    const mat4 inverse = glm::inverse(matrix);
    // A ray's distances are the same in every frame.
    const rays::RayQuery in_frame{vec3(inverse * vec4(ray.origin, 1)), mat3(inverse) * ray.direction};
    for (const uvec3& t : mesh.triangles) {
      const float distance =
          meet(in_frame, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], limit);
      if (!(distance < limit)) continue;
      limit = distance;
      best = {static_cast<int>(i), distance};
    }
  }
  return best;
}

scene::Bounds node_bounds(const scene::Scene& scene, const std::vector<mat4>& world, int node) {
  scene::Bounds bounds;
  for (const scene::Instance& instance : scene.instances) {
    if (instance.node == node) add(bounds, scene, world, instance);
  }
  return bounds;
}

scene::Bounds material_bounds(const scene::Scene& scene, const std::vector<mat4>& world, int material) {
  scene::Bounds bounds;
  for (const scene::Instance& instance : scene.instances) {
    if (scene::instance_material(scene, instance) == material) add(bounds, scene, world, instance);
  }
  return bounds;
}

std::string node_name(const scene::Scene& scene, int node) {
  if (const std::string& name = scene.nodes[at(node)].name; !name.empty()) return name;
  for (const scene::Instance& instance : scene.instances) {
    if (instance.node == node && !scene.meshes[at(instance.mesh)].name.empty())
      return scene.meshes[at(instance.mesh)].name;
  }
  return fmt::format("node {}", node);
}

BodyTree body_tree(const scene::Scene& scene) {
  BodyTree tree;
  const std::size_t count = scene.nodes.size();
  tree.children.resize(count), tree.body.resize(count);
  for (const scene::Instance& instance : scene.instances) tree.body[at(instance.node)] = true;
  // Children stand after their parents.
  std::vector<bool> wanted = tree.body;
  for (std::size_t i = count; i-- > 0;) {
    if (wanted[i] && scene.nodes[i].parent >= 0) wanted[at(scene.nodes[i].parent)] = true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!wanted[i]) continue;
    const int parent = scene.nodes[i].parent;
    (parent < 0 ? tree.roots : tree.children[at(parent)]).push_back(static_cast<int>(i));
  }
  return tree;
}

}  // namespace ssphh::viewer
