#include "joined.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

namespace ssphh::lightmap {
namespace {

/// One number for all vertices of the same key, as std::vector<Key> sorts them.
template <class Key>
std::vector<std::uint32_t> welded(const std::vector<Key>& keys) {
  std::vector<std::uint32_t> order(keys.size()), id(keys.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  for (std::size_t i = 0, now = 0; i < order.size(); ++i) {
    if (i > 0 && keys[order[i - 1]] < keys[order[i]]) ++now;
    id[order[i]] = static_cast<std::uint32_t>(now);
  }
  return id;
}

struct Side {
  std::uint32_t low, high;  ///< welded ends
  std::uint32_t triangle;
  std::uint8_t edge;
  bool forward;  ///< from low to high
};

template <class Agree>
Neighbours joined(std::span<const uvec3> triangles, const std::vector<std::uint32_t>& id,
                  const Agree& agree) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = id[triangles[i][k]], b = id[triangles[i][(k + 1) % 3]];
      if (a != b)
        sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i),
                         static_cast<std::uint8_t>(k), a < b});
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) < std::tie(b.low, b.high, b.triangle, b.edge);
  });
  Neighbours out(triangles.size(), {-1, -1, -1});
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const Side& a = sides[i];
    const bool two = end - i == 2 && a.triangle != sides[i + 1].triangle;
    if (two && a.forward != sides[i + 1].forward && agree(a, sides[i + 1])) {
      const Side& b = sides[i + 1];
      out[a.triangle][a.edge] = static_cast<std::int32_t>(b.triangle);
      out[b.triangle][b.edge] = static_cast<std::int32_t>(a.triangle);
    }
    i = end;
  }
  return out;
}

using Place = std::array<float, 5>;

}  // namespace

Neighbours joined_smoothly(const WorldMesh& mesh, float crease) {
  std::vector<std::array<float, 3>> places;
  for (const vec3& p : mesh.positions) places.push_back({p.x, p.y, p.z});
  const std::span<const uvec3> triangles = mesh.mesh.triangles;
  const float least = std::cos(crease);
  const auto normal = [&](const Side& side, int end) {
    const uvec3& t = triangles[side.triangle];
    if (!mesh.normals.empty()) return mesh.normals[t[(side.edge + end) % 3]];
    const vec3 n = mesh.front(t);
    return n / std::max(glm::length(n), std::numeric_limits<float>::min());
  };
  return joined(triangles, welded(places), [&](const Side& a, const Side& b) {
    return glm::dot(normal(a, 0), normal(b, 1)) >= least && glm::dot(normal(a, 1), normal(b, 0)) >= least;
  });
}

Neighbours joined_in_uvs(const WorldMesh& mesh) {
  std::vector<Place> places;
  const std::vector<vec2>& uvs = mesh.mesh.uvs[1];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3& p = mesh.positions[i];
    places.push_back({p.x, p.y, p.z, uvs[i].x, uvs[i].y});
  }
  return joined(mesh.mesh.triangles, welded(places), [](const Side&, const Side&) { return true; });
}

}  // namespace ssphh::lightmap
