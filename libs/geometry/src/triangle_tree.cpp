#include <algorithm>
#include <numeric>

#include <ssphh/geometry/triangle_tree.h>

namespace ssphh::geometry {
namespace {

constexpr std::int32_t leaf_size = 4;

/// Nearest point of the edge that begins at corner i.
OnTriangle nearest_on_edge(const Corners& triangle, int i, const vec3& p) {
  const int j = (i + 1) % 3;
  const vec3 a = triangle[i], b = triangle[j];
  const vec3 edge = b - a;
  const float length2 = glm::dot(edge, edge);
  const float t = length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0f, 1.0f) : 0;
  OnTriangle place;
  place.weight = vec3(0);
  place.weight[i] += 1 - t;
  place.weight[j] += t;
  const vec3 away = p - (a + t * edge);
  place.distance2 = glm::dot(away, away);
  return place;
}

}  // namespace

OnTriangle nearest_on_triangle(const Corners& triangle, const vec3& p) {
  const vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], w = p - triangle[0];
  const vec3 n = glm::cross(u, v);
  const float n2 = glm::dot(n, n);
  if (n2 > 0) {
    const float b1 = glm::dot(glm::cross(w, v), n) / n2, b2 = glm::dot(glm::cross(u, w), n) / n2;
    if (b1 >= 0 && b2 >= 0 && b1 + b2 <= 1) {
      const float away = glm::dot(w, n);
      return {vec3(1 - b1 - b2, b1, b2), away * away / n2};
    }
  }
  const auto nearer = [](const OnTriangle& a, const OnTriangle& b) { return a.distance2 < b.distance2; };
  return std::min(
      {nearest_on_edge(triangle, 0, p), nearest_on_edge(triangle, 1, p), nearest_on_edge(triangle, 2, p)},
      nearer);
}

TriangleTree::TriangleTree(std::span<const Corners> triangles)
    : corners_(triangles.begin(), triangles.end()), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (corners_.empty()) return;
  nodes_.reserve(corners_.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<std::int32_t>(corners_.size()));
}

void TriangleTree::split(std::size_t node, std::int32_t first, std::int32_t count) {
  const auto begin = order_.begin() + first, end = begin + count;
  scene::Bounds box, centers;
  const auto center = [&](std::int32_t i) {
    const Corners& c = corners_[i];
    return c[0] + c[1] + c[2];
  };
  for (auto i = begin; i != end; ++i) {
    for (const vec3& corner : corners_[*i]) box.add(corner);
    centers.add(center(*i));
  }
  nodes_[node].box = box;
  if (count <= leaf_size) {
    nodes_[node].first = first, nodes_[node].count = count;
    return;
  }
  const vec3 extent = centers.max - centers.min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::nth_element(begin, begin + count / 2, end, [&](std::int32_t a, std::int32_t b) {
    const float x = center(a)[axis], y = center(b)[axis];
    return x != y ? x < y : a < b;
  });
  const std::size_t left = nodes_.size();
  nodes_[node].first = static_cast<std::int32_t>(left);
  nodes_.resize(left + 2);
  split(left, first, count / 2);
  split(left + 1, first + count / 2, count - count / 2);
}

}  // namespace ssphh::geometry
