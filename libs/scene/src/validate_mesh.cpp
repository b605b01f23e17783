#include "validate_mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::scene {
namespace {

using dvec3 = glm::dvec3;

/// Normal times twice the area, in double.
dvec3 area_normal(const Mesh& mesh, const uvec3& t) {
  const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

bool degenerate(const Mesh& mesh, const uvec3& t) {
  const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  // Thinner than float coordinates can say: the normal would be noise.
  return !(glm::length(glm::cross(b - a, c - a)) > 1e-10 * longest);
}

bool nearly_unit(const vec3& v) {
  return std::abs(glm::dot(v, v) - 1) < 1e-3f;
}

/// Unit normals; where there is no direction, the area-weighted mean of the triangles around the vertex.
void repair_normals(Mesh& mesh, Repairs& repairs) {
  std::vector<std::size_t> lost;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    vec3& n = mesh.normals[i];
    const float length = glm::length(n);
    if (!is_finite(n) || !(length > 1e-20f) || !std::isfinite(length)) {
      lost.push_back(i);
    } else if (!nearly_unit(n)) {
      n /= length;
      repairs.count("normals were not unit vectors: normalised");
    }
  }
  if (lost.empty()) return;
  repairs.count("normals without direction: computed from the triangles", lost.size());
  std::vector<dvec3> sums(mesh.positions.size(), dvec3(0));
  for (const uvec3& t : mesh.triangles) {
    const dvec3 n = area_normal(mesh, t);
    for (int corner = 0; corner < 3; ++corner) sums[t[corner]] += n;
  }
  for (const std::size_t i : lost) {
    const double length = glm::length(sums[i]);
    mesh.normals[i] = length > 0 ? vec3(sums[i] / length) : vec3(0, 1, 0);
  }
}

void repair_tangents(Mesh& mesh, Repairs& repairs) {
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    vec4& t = mesh.tangents[i];
    const float length = glm::length(vec3(t)), sign = t.w < 0 ? -1.0f : 1.0f;
    const bool lost = !is_finite(vec3(t)) || !(length > 1e-20f) || !std::isfinite(length);
    if (!lost && nearly_unit(vec3(t)) && t.w == sign) continue;
    const vec3 axis =
        lost ? Frame::around(mesh.normals.empty() ? vec3(0, 0, 1) : mesh.normals[i]).x : vec3(t) / length;
    t = vec4(axis, sign);
    repairs.count("tangents were not unit vectors: mended");
  }
}

}  // namespace

void validate_mesh(Mesh& mesh, const std::string& where, Repairs& repairs) {
  // Check numbers.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_finite(mesh.positions[i])) throw Error(where, fmt::format("position {} is not finite", i));
  }
  for (const auto& uvs : mesh.uvs) {
    for (std::size_t i = 0; i < uvs.size(); ++i) {
      if (!is_finite(vec3(uvs[i], 0)))
        throw Error(where, fmt::format("texture coordinate {} is not finite", i));
    }
  }
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    vec4& c = mesh.colors[i];
    if (!is_finite(vec3(c)) || !std::isfinite(c.w))
      throw Error(where, fmt::format("colour {} is not finite", i));
    const vec4 clamped = glm::clamp(c, 0.0f, 1.0f);
    if (clamped != c) c = clamped, repairs.count("vertex colours outside 0..1: clamped");
  }

  // Repair.
  const std::size_t removed =
      std::erase_if(mesh.triangles, [&](const uvec3& t) { return degenerate(mesh, t); });
  repairs.count("degenerate triangles: removed", removed);
  repair_normals(mesh, repairs);
  repair_tangents(mesh, repairs);
}

}  // namespace ssphh::scene
