#include "light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ssphh::shading {
namespace {

/// Of a branching's choices, divided evenly: the brighter side may be hidden.
constexpr float even_share = 0.1f;

float importance(float power, float radius2, const vec3& center, const vec3& from) {
  const vec3 d = center - from;
  constexpr float least_distance2 = 1e-12f;
  return power / std::max({glm::dot(d, d), radius2, least_distance2});
}

}  // namespace

void LightTree::assign(std::span<const Light> lights) {
  nodes_.clear();
  order_.resize(lights.size());
  std::iota(order_.begin(), order_.end(), 0);
  leaf_.resize(lights.size());
  if (lights.empty()) return;
  nodes_.push_back({.end = static_cast<std::uint32_t>(lights.size())});
  // Children stand behind their parents
  for (std::size_t node = 0; node < nodes_.size(); ++node) build(lights, static_cast<int>(node));
}

/// Bounds of the node's lights, which are divided at their median along the longest side if they are many.
void LightTree::build(std::span<const Light> lights, int index) {
  Node node = nodes_[index];
  scene::Bounds bounds, centers;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const Light& light = lights[order_[i]];
    bounds.add(light.bounds.min), bounds.add(light.bounds.max);
    centers.add(light.bounds.center());
    if (light.power > 0 && std::isfinite(light.power)) node.power += light.power;
  }
  node.center = bounds.center();
  node.radius2 = bounds.radius() * bounds.radius();
  if (node.end - node.begin > most_in_leaf) {
    const vec3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = (node.begin + node.end) / 2;
    const auto key = [&](std::uint32_t light) {
      return std::pair(lights[light].bounds.center()[axis], light);
    };
    std::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end,
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    node.children = static_cast<int>(nodes_.size());
    nodes_.push_back({.parent = index, .begin = node.begin, .end = middle});
    nodes_.push_back({.parent = index, .begin = middle, .end = node.end});
  } else {
    std::sort(order_.begin() + node.begin, order_.begin() + node.end);
    for (std::uint32_t i = node.begin; i < node.end; ++i) leaf_[order_[i]] = index;
  }
  nodes_[index] = node;
}

std::span<const std::uint32_t> LightTree::lights_of(const Node& node) const {
  return std::span(order_).subspan(node.begin, node.end - node.begin);
}

float LightTree::first_share(const Node& node, const vec3& from) const {
  const Node &a = nodes_[node.children], &b = nodes_[node.children + 1];
  if (!(a.power > 0) || !(b.power > 0)) return a.power > 0 ? 1.0f : 0.0f;
  const float first = importance(a.power, a.radius2, a.center, from);
  const float share = first / (first + importance(b.power, b.radius2, b.center, from));
  return std::isfinite(share) ? even_share / 2 + (1 - even_share) * share : 0.5f;
}

LightTree::Choice LightTree::choose(const vec3& from, float u) const {
  const Node* node = nodes_.data();
  float probability = 1;
  while (node->children >= 0) {
    const float first = first_share(*node, from);
    const bool second = u >= first;
    const float share = second ? 1 - first : first;
    u = glm::clamp((second ? u - first : u) / share, 0.0f, 0x1.fffffep-1f);
    probability *= share;
    node = &nodes_[node->children + (second ? 1 : 0)];
  }
  return {{lights_of(*node), probability}, u};
}

LightTree::Leaf LightTree::leaf_of(std::size_t light, const vec3& from) const {
  int at = leaf_[light];
  const Leaf leaf{lights_of(nodes_[at]), 1};
  float probability = 1;
  for (int parent = nodes_[at].parent; parent >= 0; at = parent, parent = nodes_[at].parent) {
    const float first = first_share(nodes_[parent], from);
    probability *= at == nodes_[parent].children ? first : 1 - first;
  }
  return {leaf.lights, probability};
}

}  // namespace ssphh::shading
