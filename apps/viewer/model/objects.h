#pragma once
/// Bodies of a scene: what a click finds and a tree lists. A body is a node that has instances of meshes.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>

namespace ssphh::viewer {

/// What a ray meets.
struct PickedBody {
  int instance = -1;
  std::size_t triangle = 0;  ///< of its mesh
  float distance = 0;        ///< in units of the ray's direction
};

/// The nearest triangle of any instance before the ray's end, from either side; glass and what alpha cuts out
/// count as surfaces. `world` as scene::world_matrices() gives it.
std::optional<PickedBody> pick_body(const scene::Scene& scene, const std::vector<mat4>& world,
                                    const rays::RayQuery& ray);

/// Of the part of the body that hangs together with the triangle, by corners at the same places: of a mesh
/// that holds all chairs, one chair.
scene::Bounds part_bounds(const scene::Scene& scene, const std::vector<mat4>& world,
                          const PickedBody& picked);

/// Of all instances at the node; empty where there are none.
scene::Bounds node_bounds(const scene::Scene& scene, const std::vector<mat4>& world, int node);
/// Of all instances that shade with the material.
scene::Bounds material_bounds(const scene::Scene& scene, const std::vector<mat4>& world, int material);

/// Name of a node; of one without, that of its mesh; else "node 7".
std::string node_name(const scene::Scene& scene, int node);

/// Nodes as a tree of bodies: those with instances, and all above them.
struct BodyTree {
  std::vector<std::vector<int>> children;  ///< of each node
  std::vector<int> roots;
  std::vector<bool> body;  ///< whether the node has instances itself
};
BodyTree body_tree(const scene::Scene& scene);

}  // namespace ssphh::viewer
