#include "objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

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
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const uvec3 t = mesh.triangles[k];
      const float distance =
          meet(in_frame, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], limit);
      if (!(distance < limit)) continue;
      limit = distance;
      best = {static_cast<int>(i), k, distance};
    }
  }
  return best;
}

scene::Bounds part_bounds(const scene::Scene& scene, const std::vector<mat4>& world,
                          const PickedBody& picked) {
  const scene::Instance& instance = scene.instances[at(picked.instance)];
  const scene::Mesh& mesh = scene.meshes[at(instance.mesh)];
  const std::size_t count = mesh.positions.size();
  // Trees of vertices: each leads to another one of its part, the root to itself.
  std::vector<std::uint32_t> toward(count), order(count);
  std::iota(toward.begin(), toward.end(), 0u);
  std::iota(order.begin(), order.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (toward[v] != v) v = toward[v] = toward[toward[v]];
    return v;
  };
  // Where normals or texture coordinates part, vertices stand twice at one place.
  const auto place = [&](std::uint32_t v) {
    const vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(order, {}, place);
  for (std::size_t i = 1; i < count; ++i) {
    if (place(order[i]) == place(order[i - 1])) toward[root(order[i])] = root(order[i - 1]);
  }
  for (const uvec3& t : mesh.triangles) toward[root(t.x)] = toward[root(t.y)] = root(t.z);
  const std::uint32_t wanted = root(mesh.triangles[picked.triangle].x);
  scene::Bounds bounds;
  for (const uvec3& t : mesh.triangles) {
    if (root(t.x) != wanted) continue;
    for (int k = 0; k < 3; ++k) bounds.add(vec3(world[at(instance.node)] * vec4(mesh.positions[t[k]], 1)));
  }
  return bounds;
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
