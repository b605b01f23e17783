#pragma once
/// One thing of a scene by itself.

#include <string>

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Index of the node of that name. Throws Error that lists the names of nodes with something at or below
/// them, for an unknown name and for one that several nodes have.
int find_node(const Scene& scene, const std::string& name);

/// The scene with what stands at the node or below it, meshes and lamps, and nothing else: no environment, no
/// suns, no cameras, no SPHLs as probes. Nodes and animations stay, so that everything stands and moves as
/// before. Throws Error for a node that there is not.
Scene thing_alone(Scene scene, int node);

}  // namespace ssphh::scene
