#include "light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include <ssphh/core/random.h>

namespace ssphh::methods::vpl {
namespace {

class Builder {
 public:
  explicit Builder(std::span<const Vpl> lights) : lights_(lights), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    scene::Bounds bounds;
    for (const Vpl& light : lights) bounds.add(light.position);
    normal_weight_ = 0.25f * bounds.radius();
  }

  std::vector<LightNode> build() {
    if (!order_.empty()) add(0, order_.size());
    return std::move(nodes_);
  }

 private:
  float coordinate(int light, int axis) const {
    const Vpl& l = lights_[light];
    return axis < 3 ? l.position[axis] : normal_weight_ * l.normal[axis - 3];
  }

  int longest_axis(std::size_t begin, std::size_t end) const {
    int longest = 0;
    float most = -1;
    for (int axis = 0; axis < 6; ++axis) {
      float low = coordinate(order_[begin], axis), high = low;
      for (std::size_t i = begin; i < end; ++i) {
        low = std::min(low, coordinate(order_[i], axis));
        high = std::max(high, coordinate(order_[i], axis));
      }
      if (high - low > most) most = high - low, longest = axis;
    }
    return longest;
  }

  VplCluster cluster_of(std::size_t begin, std::size_t end) const {
    VplCluster cluster;
    cluster.least_radius = std::numeric_limits<float>::infinity();
    vec3 sum(0);
    for (std::size_t i = begin; i < end; ++i) {
      const Vpl& light = lights_[order_[i]];
      cluster.bounds.add(light.position);
      cluster.least_radius = std::min(cluster.least_radius, light.radius);
      cluster.most_radius = std::max(cluster.most_radius, light.radius);
      cluster.power += light.power;
      sum += light.normal;
    }
    const float length = glm::length(sum);
    if (length > 0) cluster.axis = sum / length;
    float least = 1;
    for (std::size_t i = begin; i < end; ++i)
      least = std::min(least, glm::dot(lights_[order_[i]].normal, cluster.axis));
    // Rounding of the cosine of a single direction is an angle of a thousandth.
    cluster.spread = end - begin == 1 ? 0 : std::acos(std::max(least, -1.0f)) + 1e-3f;
    return cluster;
  }

  int add(std::size_t begin, std::size_t end) {
    LightNode node;
    node.cluster = cluster_of(begin, end);
    if (end - begin == 1) {
      node.light = order_[begin];
    } else {
      const int axis = longest_axis(begin, end);
      const std::size_t middle = begin + (end - begin) / 2;
      const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(begin), at(middle), at(end), [&](int a, int b) {
        const float x = coordinate(a, axis), y = coordinate(b, axis);
        return x < y || (x == y && a < b);
      });
      node.left = add(begin, middle);
      node.right = add(middle, end);
      const LightNode& l = nodes_[node.left];
      const LightNode& r = nodes_[node.right];
      const float share = luminance(l.cluster.power) / luminance(node.cluster.power);
      node.light = Pcg32(3, nodes_.size()).uniform() < share ? l.light : r.light;
    }
    nodes_.push_back(node);
    return static_cast<int>(nodes_.size()) - 1;
  }

  std::span<const Vpl> lights_;
  std::vector<int> order_;
  float normal_weight_ = 0;
  std::vector<LightNode> nodes_;
};

/// A node of the cut.
struct CutNode {
  float bound;  ///< of its error, luminance
  int node;
  float transfer;  ///< of its light; 0 where that is hidden
  friend bool operator<(const CutNode& a, const CutNode& b) {
    return a.bound < b.bound || (a.bound == b.bound && a.node < b.node);
  }
};

}  // namespace

std::vector<LightNode> build_light_tree(std::span<const Vpl> lights) {
  return Builder(lights).build();
}

CutLight gather_cut(std::span<const LightNode> tree, std::span<const Vpl> lights, const Receiver& at,
                    const vec3& start, const rays::PosedWorld& surfaces, const VplParams& params,
                    float error) {
  CutLight result;
  if (tree.empty()) return result;
  const auto visible_transfer = [&](int light) {
    const Vpl& l = lights[light];
    const float open = transfer(at, l, params);
    return open > 0 && surfaces.visible(start, l.position) ? open : 0;
  };
  const auto node_at = [&](int i) -> const LightNode& { return tree[i]; };
  const auto cut_node = [&](int i, float of_light) {
    const LightNode& node = node_at(i);
    const float bound =
        node.left < 0 ? 0 : transfer_bound(at, node.cluster, params) * luminance(node.cluster.power) / pi;
    return CutNode{bound, i, of_light};
  };

  std::priority_queue<CutNode> cut;
  // The sum is kept in double: it is changed by differences as often as the cut is refined.
  glm::dvec3 sum(0);
  const auto add = [&](const CutNode& n, double sign) {
    sum += sign * static_cast<double>(n.transfer) / pi_d * glm::dvec3(node_at(n.node).cluster.power);
  };
  const int root = static_cast<int>(tree.size()) - 1;
  cut.push(cut_node(root, visible_transfer(node_at(root).light)));
  add(cut.top(), 1);
  while (cut.top().bound > error * luminance(vec3(sum))) {
    const CutNode split = cut.top();
    cut.pop();
    add(split, -1);
    const LightNode& parent = node_at(split.node);
    for (const int child : {parent.left, parent.right}) {
      const int light = node_at(child).light;
      const CutNode part = cut_node(child, light == parent.light ? split.transfer : visible_transfer(light));
      add(part, 1);
      cut.push(part);
    }
  }
  result.irradiance = glm::max(vec3(sum), vec3(0));
  result.lights = static_cast<int>(cut.size());
  return result;
}

}  // namespace ssphh::methods::vpl
