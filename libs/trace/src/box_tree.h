#pragma once
/// A binary tree over boxes: which of them may a ray meet?

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include <ssphh/scene/query.h>

#include "rays.h"

namespace ssphh::trace {

class BoxTree {
 public:
  BoxTree() = default;
  /// Split at the median of the centres along the longest axis.
  explicit BoxTree(const std::vector<scene::Bounds>& boxes) { assign(boxes); }
  /// The same in place of what it was, in the memory of that.
  void assign(const std::vector<scene::Bounds>& boxes) {
    nodes_.clear();
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
  }

  /// Calls `visit(box)` for each box that the ray may meet before `t_max`, those nearer along the ray rather
  /// first, until it returns true. `visit` may make `t_max` smaller.
  template <class Visit>
  bool any(const Ray& ray, const float& t_max, const Visit& visit) const {
    if (nodes_.empty()) return false;
    const vec3 inverse = 1.0f / ray.direction;  // infinite along an axis that it does not take
    std::array<std::uint32_t, 32> stack;        // the tree is balanced: as deep as 2^32 boxes ask for
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (!meets(ray.origin, inverse, t_max, node.box)) continue;
      if (node.count > 0) {
        for (std::uint32_t i = 0; i < node.count; ++i)
          if (visit(order_[node.first + i])) return true;
        continue;
      }
      const bool forward = ray.direction[node.axis] >= 0;
      stack[depth++] = forward ? node.first : at + 1;
      stack[depth++] = forward ? at + 1 : node.first;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t leaf = 2;

  struct Node {
    scene::Bounds box;
    std::uint32_t first = 0;  ///< of a leaf's boxes in the order; else the right child, the left one is next
    std::uint32_t count = 0;  ///< of a leaf; else 0
    int axis = 0;
  };

  static bool meets(const vec3& origin, const vec3& inverse, float t_max, const scene::Bounds& box) {
    float first = 0, last = t_max;
    for (int k = 0; k < 3; ++k) {
      // On a face that the ray runs along 0·∞ is no number, which narrows nothing.
      const float a = (box.min[k] - origin[k]) * inverse[k], b = (box.max[k] - origin[k]) * inverse[k];
      const float enter = inverse[k] >= 0 ? a : b, leave = inverse[k] >= 0 ? b : a;
      if (enter > first) first = enter;
      if (leave < last) last = leave;
    }
    return first <= last + 1e-6f * std::abs(last);
  }

  void build(const std::vector<scene::Bounds>& boxes, std::uint32_t begin, std::uint32_t end) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    scene::Bounds box, centers;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.add(boxes[order_[i]].min), box.add(boxes[order_[i]].max);
      centers.add(boxes[order_[i]].center());
    }
    nodes_[at].box = box;
    if (end - begin <= leaf) {
      nodes_[at].first = begin, nodes_[at].count = end - begin;
      return;
    }
    const vec3 extent = centers.max - centers.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
      const float ca = boxes[a].center()[axis], cb = boxes[b].center()[axis];
      return ca != cb ? ca < cb : a < b;
    };
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto first = order_.begin();
    std::nth_element(first + begin, first + middle, first + end, less);
    nodes_[at].axis = axis;
    build(boxes, begin, middle);
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
    build(boxes, middle, end);
  }

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ssphh::trace
