#include "world_mesh.h"

#include <glm/gtc/matrix_inverse.hpp>

namespace ssphh::lightmap {

WorldMesh::WorldMesh(const scene::Scene& scene, const scene::Instance& instance, std::span<const mat4> world)
    : mesh(scene.meshes[instance.mesh]), moves(instance.node >= 0 && scene.nodes[instance.node].movable) {
  const mat4 matrix = instance.node < 0 ? mat4(1) : world[instance.node];
  positions.reserve(mesh.positions.size());
  for (const vec3& p : mesh.positions) positions.emplace_back(matrix * vec4(p, 1));
  const float determinant = glm::determinant(mat3(matrix));
  mirrored = determinant < 0;
  if (mesh.normals.empty() || determinant == 0) return;  // a flat body has no side for its normals
  const mat3 turn = glm::inverseTranspose(mat3(matrix));
  for (const vec3& n : mesh.normals) {
    const vec3 turned = turn * n;
    const float length = glm::length(turned);
    normals.push_back(length > 0 ? turned / length : n);
  }
}

}  // namespace ssphh::lightmap
