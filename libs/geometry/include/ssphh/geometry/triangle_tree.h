#pragma once
/// A tree of boxes around triangles, for the triangle nearest to a point.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::geometry {

using Corners = std::array<vec3, 3>;

/// Point of a triangle by the weights of its corners: not negative, with a sum of 1.
struct OnTriangle {
  vec3 weight{1, 0, 0};
  float distance2 = std::numeric_limits<float>::infinity();  ///< of the point asked for [m²]
};

/// Of the triangle, corners and edges included, the point nearest to p (Ericson, Real-Time Collision
/// Detection, 2005, 5.1.5). Triangles may be flat: segments and points are served as such.
OnTriangle nearest_on_triangle(const Corners& triangle, const vec3& p);

class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::span<const Corners> triangles);

  struct Found {
    std::int32_t triangle = -1;  ///< −1: none
    OnTriangle place;
  };
  /// The nearest triangle within `reach` metres that `takes(index)`; of those equally near the one with the
  /// lowest index.
  template <class Takes>
  Found nearest(const vec3& p, float reach, const Takes& takes) const {
    Found best;
    best.place.distance2 = reach * reach;
    if (nodes_.empty()) return best;
    std::array<std::int32_t, 64> stack;
    int depth = 0;
    stack[0] = 0;
    while (depth >= 0) {
      const Node& node = nodes_[stack[depth--]];
      if (distance2(node.box, p) > best.place.distance2) continue;
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        const std::int32_t triangle = order_[i];
        if (!takes(triangle)) continue;
        const OnTriangle place = nearest_on_triangle(corners_[triangle], p);
        const float d = place.distance2;
        if (d < best.place.distance2 ||
            (d == best.place.distance2 && (best.triangle < 0 || triangle < best.triangle)))
          best = {triangle, place};
      }
      if (node.count > 0) continue;
      // The nearer child is opened first.
      const std::int32_t left = node.first, right = left + 1;
      const bool swap = distance2(nodes_[right].box, p) < distance2(nodes_[left].box, p);
      stack[++depth] = swap ? left : right;
      stack[++depth] = swap ? right : left;
    }
    return best;
  }
  Found nearest(const vec3& p) const {
    return nearest(p, std::numeric_limits<float>::infinity(), [](std::int32_t) { return true; });
  }

  std::span<const Corners> triangles() const { return corners_; }
  std::size_t bytes() const {
    return corners_.size() * (sizeof(Corners) + sizeof(std::int32_t)) + nodes_.size() * sizeof(Node);
  }

 private:
  struct Node {
    scene::Bounds box;
    std::int32_t first = 0;  ///< triangle in order_, or left child; the right one follows it
    std::int32_t count = 0;  ///< of triangles; 0: an inner node
  };
  static float distance2(const scene::Bounds& box, const vec3& p) {
    const vec3 d = glm::max(glm::max(box.min - p, p - box.max), vec3(0));
    return glm::dot(d, d);
  }
  void split(std::size_t node, std::int32_t first, std::int32_t count);

  std::vector<Corners> corners_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ssphh::geometry
