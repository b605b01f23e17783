#include "scene_parts.h"

#include <algorithm>

#include <ssphh/core/require.h>

namespace ssphh::trace {
namespace {

std::vector<int> animated_ancestors(const scene::Scene& scene) {
  std::vector<int> nearest(scene.nodes.size(), -1);
  for (const scene::Animation& animation : scene.animations) {
    for (const scene::AnimationChannel& channel : animation.channels) nearest[channel.node] = channel.node;
  }
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (nearest[i] < 0 && parent >= 0) nearest[i] = nearest[parent];
  }
  return nearest;
}

scene::Bounds bounds_of(const scene::Scene& scene, const std::vector<int>& instances,
                        const std::vector<mat4>& matrices) {
  scene::Bounds bounds;
  for (const int i : instances) {
    const scene::Instance& instance = scene.instances[i];
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    const mat4 m = instance.node < 0 ? mat4(1) : matrices[instance.node];
    for (const uvec3& triangle : mesh.triangles) {
      for (int k = 0; k < 3; ++k) bounds.add(vec3(m * vec4(mesh.positions[triangle[k]], 1)));
    }
  }
  return bounds;
}

}  // namespace

NodeFrames node_frames(const scene::Scene& scene) {
  NodeFrames frames{animated_ancestors(scene), {}};
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (frames.carrier[i] == static_cast<int>(i)) {
      frames.to_frame.emplace_back(1);
      continue;
    }
    const mat4 local = node.matrix ? *node.matrix : node.local.matrix();
    frames.to_frame.push_back(node.parent < 0 ? local : frames.to_frame[node.parent] * local);
  }
  return frames;
}

SceneParts::SceneParts(const scene::Scene& scene) : frames(node_frames(scene)) {
  // Make a part of every animated node that carries instances.
  const auto carrier = [&](const scene::Instance& instance) {
    return instance.node < 0 ? -1 : frames.carrier[instance.node];
  };
  std::vector<int> carriers = {-1};
  for (const scene::Instance& instance : scene.instances) carriers.push_back(carrier(instance));
  std::ranges::sort(carriers);
  carriers.erase(std::unique(carriers.begin(), carriers.end()), carriers.end());
  for (const int node : carriers) {
    ScenePart part;
    part.node = node;
    part.name = node < 0 ? "static" : scene.nodes[node].name;
    parts.push_back(std::move(part));
  }

  // Say which part holds each node and instance.
  const auto part_of = [&](int node) {
    const auto found = std::ranges::lower_bound(carriers, node);
    return found != carriers.end() && *found == node ? static_cast<int>(found - carriers.begin()) : 0;
  };
  for (const int node : frames.carrier) node_part.push_back(part_of(node));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    instance_part.push_back(part_of(carrier(scene.instances[i])));
    parts[instance_part[i]].instances.push_back(static_cast<int>(i));
  }
  for (ScenePart& part : parts) part.bounds = bounds_of(scene, part.instances, frames.to_frame);
}

const ScenePart& SceneParts::part(int index) const {
  require(index >= 0 && static_cast<std::size_t>(index) < parts.size(), "part",
          "there is none of that index");
  return parts[index];
}

std::vector<mat4> SceneParts::poses(const scene::Scene& scene, float time) const {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  std::vector<mat4> poses;
  for (const ScenePart& part : parts) poses.push_back(part.node < 0 ? mat4(1) : world[part.node]);
  return poses;
}

void SceneParts::node_matrices(std::span<const mat4> poses, std::vector<mat4>& world) const {
  world = frames.to_frame;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (node_part[i] > 0) world[i] = poses[node_part[i]] * world[i];
  }
}

}  // namespace ssphh::trace
