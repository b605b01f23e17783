#pragma once
/// What a LightSet holds, and how it chooses one of its lights.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <ssphh/shading/lights.h>

#include "distant_lights.h"
#include "light_tree.h"
#include "mesh_light.h"
#include "punctual_lights.h"

namespace ssphh::shading {

/// Probability to choose any light in reach, however weak; the rest goes by importance. A strong light may be
/// hidden.
inline constexpr float uniform_share = 0.2f;

struct LightSet::Data {
  const scene::Scene* scene = nullptr;
  std::vector<std::string> groups;
  std::vector<PosedLight> lights;  ///< of the scene, as they are now
  std::vector<PointLight> points;
  std::vector<SphereLight> spheres;
  /// Emissive instances; from flat_from on flat lamps, which rays meet like spheres.
  std::vector<std::shared_ptr<const MeshLight>> meshes;
  std::size_t flat_from = 0;
  std::vector<std::shared_ptr<const MeshLight>> flat_lamps;  ///< [light], as they were last
  std::vector<int> instance_group, instance_mesh_light;
  std::vector<std::shared_ptr<const MeshLight>> moved_meshes;  ///< [instance], not as in the base
  DistantLights distant;
  std::vector<LightTree::Light> tree_lights;  ///< scratch
  LightTree tree;                             ///< local lights: points, spheres, meshes in this order

  std::size_t local_count() const { return points.size() + spheres.size() + meshes.size(); }

  void read_lights();
  void add_lights();
  void add_meshes(const std::vector<mat4>& world, const Data* base);
  void add_flat_lamps();
  void grow_tree();

  scene::Bounds bounds(std::size_t i) const {
    if (i < points.size())
      return {points[i].position - points[i].radius, points[i].position + points[i].radius};
    i -= points.size();
    if (i < spheres.size())
      return {spheres[i].center - spheres[i].radius, spheres[i].center + spheres[i].radius};
    return meshes[i - spheres.size()]->bounds();
  }
  float importance(std::size_t i, const vec3& from) const {
    if (i < points.size()) return points[i].importance(from);
    i -= points.size();
    if (i < spheres.size()) return spheres[i].importance(from);
    return meshes[i - spheres.size()]->importance(from);
  }
  float power(std::size_t i) const {
    if (i < points.size()) return points[i].power();
    i -= points.size();
    if (i < spheres.size()) return spheres[i].power();
    return meshes[i - spheres.size()]->power();
  }
  std::optional<LightSample> sample(std::size_t i, const vec3& from, float u_choice, const vec2& u) const {
    if (i < points.size()) return points[i].sample(from);
    i -= points.size();
    if (i < spheres.size()) return spheres[i].sample(from, u);
    return meshes[i - spheres.size()]->sample(from, u_choice, u);
  }

  using Weights = std::array<float, LightTree::most_in_leaf>;

  /// Probabilities of the lights of a leaf as seen from a point. False: none reaches the point.
  bool weigh(std::span<const std::uint32_t> leaf, const vec3& from, Weights& probability) const {
    if (leaf.size() == 1) {
      probability[0] = 1;
      return true;
    }
    float total = 0, active = 0;
    for (std::size_t i = 0; i < leaf.size(); ++i) {
      const float w = importance(leaf[i], from);
      probability[i] = w;
      total += w;
      active += w > 0 ? 1.0f : 0.0f;
    }
    if (!(total > 0 && std::isfinite(total))) return false;
    const float scale = (1 - uniform_share) / total, base = uniform_share / active;
    for (std::size_t i = 0; i < leaf.size(); ++i)
      probability[i] = probability[i] > 0 ? base + scale * probability[i] : 0;
    return true;
  }

  float local_probability(std::size_t light, const vec3& from) const {
    const LightTree::Leaf leaf = tree.leaf_of(light, from);
    const auto i = std::ranges::lower_bound(leaf.lights, light) - leaf.lights.begin();
    Weights probability;
    return weigh(leaf.lights, from, probability) ? leaf.probability * probability[i] : 0;
  }

  Distribution::Choice choose_local(const vec3& from, float u) const {
    const auto [leaf, leaf_u] = tree.choose(from, u);
    Weights probability;
    if (!weigh(leaf.lights, from, probability)) return {0, 0, 0};
    const auto c = choose_weighted(std::span(probability).first(leaf.lights.size()), 1, leaf_u);
    return {leaf.lights[c.index], c.u, leaf.probability * c.probability};
  }
};

}  // namespace ssphh::shading
