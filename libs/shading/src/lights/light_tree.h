#pragma once
/// Few of many lights, chosen by what they may bring to a point.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/scene/query.h>

namespace ssphh::shading {

/// Lights in boxes within boxes: at each branching one side is chosen by its power over the squared distance,
/// down to a few lights side by side (Estevez & Kulla 2018, Importance Sampling of Many Lights with Adaptive
/// Tree Splitting; without its cones). What the few are worth is for the caller to weigh.
class LightTree {
 public:
  struct Light {
    scene::Bounds bounds;
    float power;
  };
  static constexpr std::size_t most_in_leaf = 16;

  /// In place of what it was, in the memory of that. Negative, NaN and infinite powers count as zero.
  void assign(std::span<const Light> lights);
  /// Whether no light has any power.
  bool empty() const { return nodes_.empty() || !(nodes_[0].power > 0); }

  struct Leaf {
    std::span<const std::uint32_t> lights;  ///< of assign(), most_in_leaf at most, in their order
    float probability;
  };
  struct Choice {
    Leaf leaf;
    float u;  ///< the place of u within the leaf's share, again uniform in [0, 1)
  };
  /// `u` in [0, 1). Not of an empty tree.
  Choice choose(const vec3& from, float u) const;
  /// The leaf that holds a light, with the probability with which choose() finds it.
  Leaf leaf_of(std::size_t light, const vec3& from) const;

 private:
  struct Node {
    vec3 center{0};
    float radius2 = 0, power = 0;
    int parent = -1;
    int children = -1;  ///< the first of two; −1: a leaf
    std::uint32_t begin = 0, end = 0;
  };
  void build(std::span<const Light> lights, int node);
  std::span<const std::uint32_t> lights_of(const Node& node) const;
  /// Probability of the first of a node's children.
  float first_share(const Node& node, const vec3& from) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<int> leaf_;  ///< [light]
};

}  // namespace ssphh::shading
