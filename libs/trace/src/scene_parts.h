#pragma once
/// What of a scene moves together.

#include <span>
#include <string>
#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::trace {

/// What hangs on one animated node: the instances for which it is the nearest animated ancestor or itself.
struct ScenePart {
  int node = -1;  ///< whose frame it is; −1: world
  std::string name;
  std::vector<int> instances;
  scene::Bounds bounds;  ///< in its frame
};

/// The frame that holds each node: that of its nearest animated ancestor or itself, else the world.
struct NodeFrames {
  std::vector<int> carrier;    ///< the animated node; −1: none
  std::vector<mat4> to_frame;  ///< the product of what lies between, without a detour over the world
};

NodeFrames node_frames(const scene::Scene& scene);

struct SceneParts {
  explicit SceneParts(const scene::Scene& scene);

  const ScenePart& part(int index) const;
  /// Parts to world at `time`.
  std::vector<mat4> poses(const scene::Scene& scene, float time) const;
  /// World matrix of every node below which a part hangs or that never moves, parts posed by `poses`.
  void node_matrices(std::span<const mat4> poses, std::vector<mat4>& world) const;

  std::vector<ScenePart> parts;    ///< the first never moves; then in the order of their nodes
  NodeFrames frames;               ///< of nodes
  std::vector<int> node_part;      ///< part whose frame holds the node; 0 also where it has no surfaces
  std::vector<int> instance_part;  ///< part that holds the instance
};

}  // namespace ssphh::trace
