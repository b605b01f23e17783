#pragma once
/// Slow references for questions about triangles in world space.

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::scene {

using Triangle = std::array<vec3, 3>;

inline std::vector<Triangle> triangles_of(const Mesh& mesh, const mat4& m = mat4(1)) {
  std::vector<Triangle> result;
  for (const uvec3& t : mesh.triangles) {
    Triangle triangle;
    for (int c = 0; c < 3; ++c) {
      triangle[c] = vec3(m * vec4(mesh.positions[t[c]], 1));
    }
    result.push_back(triangle);
  }
  return result;
}

/// All triangles in world space at `time`, of the instances whose node's name begins with `prefix`.
inline std::vector<Triangle> world_triangles(const Scene& scene, float time = 0,
                                             const std::string& prefix = {}) {
  const std::vector<mat4> world = world_matrices(scene, time);
  std::vector<Triangle> result;
  for (const Instance& instance : scene.instances) {
    const auto node = static_cast<std::size_t>(instance.node);
    if (scene.nodes[node].name.compare(0, prefix.size(), prefix) != 0) continue;
    const auto part = triangles_of(scene.meshes[instance.mesh], world[node]);
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

/// Distance from p to the nearest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
inline float distance(const vec3& p, const Triangle& t) {
  const vec3 a = t[0], b = t[1], c = t[2], ab = b - a, ac = c - a;
  const float d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return glm::distance(p, a);
  const float d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return glm::distance(p, b);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::distance(p, a + ab * (d1 / (d1 - d3)));
  const float d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return glm::distance(p, c);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::distance(p, a + ac * (d2 / (d2 - d6)));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return glm::distance(p, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  }
  const float sum = va + vb + vc;
  return glm::distance(p, a + ab * (vb / sum) + ac * (vc / sum));
}

/// Whether the open segment a–b crosses a triangle, in double; edges belong to the triangle.
inline bool crosses(const vec3& a, const vec3& b, const Triangle& triangle) {
  using dvec3 = glm::dvec3;
  const dvec3 v0(triangle[0]), e1 = dvec3(triangle[1]) - v0, e2 = dvec3(triangle[2]) - v0;
  const dvec3 d = dvec3(b) - dvec3(a), h = glm::cross(d, e2);
  const double det = glm::dot(e1, h);
  if (det == 0) return false;
  const dvec3 s = dvec3(a) - v0;
  const double u = glm::dot(s, h) / det;
  const dvec3 q = glm::cross(s, e1);
  const double v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
  constexpr double edge = -1e-9;
  return u >= edge && v >= edge && u + v <= 1 - edge && t > 0 && t < 1;
}

/// Generalised winding number of a closed surface around p: 1 inside, 0 outside (−1 inside one that faces
/// inward).
inline double winding_number(const vec3& p, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const glm::dvec3 a = glm::dvec3(t[0]) - glm::dvec3(p), b = glm::dvec3(t[1]) - glm::dvec3(p),
                     c = glm::dvec3(t[2]) - glm::dvec3(p);
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
  }
  return sum / (4 * pi_d);
}

inline double signed_volume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    sum += glm::dot(glm::dvec3(t[0]), glm::cross(glm::dvec3(t[1]), glm::dvec3(t[2]))) / 6;
  }
  return sum;
}

inline double area(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    sum += glm::length(glm::cross(glm::dvec3(t[1] - t[0]), glm::dvec3(t[2] - t[0]))) / 2;
  }
  return sum;
}

/// Number of directed edges, between exactly equal positions, that have no single partner the other way.
inline int open_edges(const std::vector<Triangle>& triangles) {
  using Key = std::tuple<float, float, float>;
  const auto key = [](const vec3& p) { return Key(p.x + 0.0f, p.y + 0.0f, p.z + 0.0f); };
  std::map<std::pair<Key, Key>, int> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[{key(t[c]), key(t[(c + 1) % 3])}];
  }
  int open = 0;
  for (const auto& [edge, count] : edges) {
    const auto partner = edges.find({edge.second, edge.first});
    open += count != 1 || partner == edges.end() || partner->second != 1;
  }
  return open;
}

}  // namespace ssphh::scene
