#include "gltf_deform.h"

namespace ssphh::scene_io {
namespace {

template <class Vector>
void add_scaled(std::vector<Vector>& to, const std::vector<vec3>& differences, float weight) {
  if (to.empty() || differences.empty()) return;
  for (std::size_t i = 0; i < to.size(); ++i) {
    for (int c = 0; c < 3; ++c) to[i][c] += weight * differences[i][c];
  }
}

// Of length 1, as far as there is a direction.
vec3 direction(const vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : v;
}

void normalize_directions(scene::Mesh& mesh) {
  for (vec3& n : mesh.normals) n = direction(n);
  for (vec4& t : mesh.tangents) t = vec4(direction(vec3(t)), t.w);
}

/// Takes normals where `m` takes surfaces: columns are the cross products of those of `m`.
mat3 cofactors(const mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

}  // namespace

void blend(scene::Mesh& mesh, const std::vector<MeshShape::Target>& targets,
           const std::vector<float>& weights) {
  bool changed = false;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (weights[t] == 0) continue;
    changed = true;
    add_scaled(mesh.positions, targets[t].positions, weights[t]);
    add_scaled(mesh.normals, targets[t].normals, weights[t]);
    add_scaled(mesh.tangents, targets[t].tangents, weights[t]);
  }
  if (changed) normalize_directions(mesh);
}

std::optional<std::size_t> bend(scene::Mesh& mesh, const std::vector<MeshShape::Influences>& influences,
                                const std::vector<mat4>& joints) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mat4 sum(0);
    float total = 0;
    for (const auto& [indices, weights] : influences) {
      for (int c = 0; c < 4; ++c) {
        const float index = indices[v][c];
        if (!(index >= 0 && index < static_cast<float>(joints.size()))) return v;
        sum += weights[v][c] * joints[index];
        total += weights[v][c];
      }
    }
    const mat4 matrix = total > 0 ? sum / total : joints[influences[0].joints[v].x];
    mesh.positions[v] = vec3(matrix * vec4(mesh.positions[v], 1));
    if (!mesh.normals.empty()) mesh.normals[v] = cofactors(mat3(matrix)) * mesh.normals[v];
    if (!mesh.tangents.empty()) {
      vec4& t = mesh.tangents[v];
      t = vec4(mat3(matrix) * vec3(t), t.w);
    }
  }
  normalize_directions(mesh);
  return std::nullopt;
}

}  // namespace ssphh::scene_io
