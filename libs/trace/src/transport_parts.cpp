/// Which instance belongs to which part, and where parts stand.

#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>

#include "surface_gap.h"
#include "transport_data.h"

namespace ssphh::trace {
namespace {

void check_options(const TransportOptions& options) {
  if (options.light_samples < 1) throw Error("light samples", "at least one is needed");
  if (options.environment_samples < 1) throw Error("environment samples", "at least one is needed");
  if (!(options.surface_tolerance >= 0 && options.surface_tolerance < 1))
    throw Error("surface tolerance", "it must lie in 0..1");
}

/// For every node the nearest animated node among its ancestors and itself; −1: none.
std::vector<int> animated_ancestors(const scene::Scene& scene) {
  std::vector<int> nearest(scene.nodes.size(), -1);
  for (const scene::Animation& animation : scene.animations) {
    for (const scene::AnimationChannel& channel : animation.channels)
      nearest[static_cast<std::size_t>(channel.node)] = channel.node;
  }
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (nearest[i] < 0 && parent >= 0) nearest[i] = nearest[static_cast<std::size_t>(parent)];
  }
  return nearest;
}

/// Matrix of every node to its animated ancestor's frame, or to the world: the product of what lies between,
/// without a detour over the world.
std::vector<mat4> frame_matrices(const scene::Scene& scene, const std::vector<int>& animated) {
  std::vector<mat4> frames;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (animated[i] == static_cast<int>(i)) {
      frames.emplace_back(1);
      continue;
    }
    const mat4 local = node.matrix ? *node.matrix : node.local.matrix();
    frames.push_back(node.parent < 0 ? local : frames[static_cast<std::size_t>(node.parent)] * local);
  }
  return frames;
}

scene::Bounds bounds_of(const scene::Scene& scene, const std::vector<int>& instances,
                        const std::vector<mat4>& matrices) {
  scene::Bounds bounds;
  for (const int i : instances) {
    const scene::Instance& instance = scene.instances[static_cast<std::size_t>(i)];
    const scene::Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const mat4 m = instance.node < 0 ? mat4(1) : matrices[static_cast<std::size_t>(instance.node)];
    for (const uvec3& triangle : mesh.triangles) {
      for (int k = 0; k < 3; ++k) bounds.add(vec3(m * vec4(mesh.positions[triangle[k]], 1)));
    }
  }
  return bounds;
}

}  // namespace

TransportData::TransportData(const scene::Scene& scene_in, const TransportOptions& options_in)
    : scene(scene_in), options(options_in), lights(scene_in, scene::world_matrices(scene_in, 0)) {
  check_options(options);

  // Make a part of every animated node that carries instances.
  const std::vector<int> animated = animated_ancestors(scene);
  node_frame = frame_matrices(scene, animated);
  const auto carrier = [&](const scene::Instance& instance) {
    return instance.node < 0 ? -1 : animated[static_cast<std::size_t>(instance.node)];
  };
  std::vector<int> carriers;
  for (const scene::Instance& instance : scene.instances) carriers.push_back(carrier(instance));
  carriers.push_back(-1);
  std::sort(carriers.begin(), carriers.end());
  carriers.erase(std::unique(carriers.begin(), carriers.end()), carriers.end());
  for (const int node : carriers) {
    TransportPart part;
    part.node = node;
    part.name = node < 0 ? "static" : scene.nodes[static_cast<std::size_t>(node)].name;
    parts.push_back(std::move(part));
  }
  const auto part_of = [&](int node) {
    const auto found = std::lower_bound(carriers.begin(), carriers.end(), node);
    return found != carriers.end() && *found == node ? static_cast<int>(found - carriers.begin()) : 0;
  };
  for (const int node : animated) node_part.push_back(part_of(node));

  // Build each part's structure over its own instances.
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].mesh < 0) continue;
    parts[static_cast<std::size_t>(part_of(carrier(scene.instances[i])))].instances.push_back(
        static_cast<int>(i));
  }
  for (TransportPart& part : parts) {
    std::vector<bool> only(scene.instances.size());
    for (const int i : part.instances) only[static_cast<std::size_t>(i)] = true;
    part.bounds = bounds_of(scene, part.instances, node_frame);
    part.embree = std::make_unique<EmbreeScene>(scene, node_frame, EmbreeScene::default_flatten_limit, only);
  }

  gap = options.surface_tolerance * scene_size(scene::world_bounds(scene, scene::world_matrices(scene, 0)));
  for (const scene::Light& light : scene.lights) {
    light_names.push_back(light.name);
    light_group.push_back(scene::light_group_index(lights.groups(), scene::light_group(light)));
  }
}

std::vector<mat4> TransportData::node_matrices(std::span<const mat4> poses) const {
  std::vector<mat4> world = node_frame;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (node_part[i] > 0) world[i] = poses[static_cast<std::size_t>(node_part[i])] * world[i];
  }
  return world;
}

const TransportPart& TransportData::part(int index) const {
  require(index >= 0 && static_cast<std::size_t>(index) < parts.size(), "part",
          "there is none of that index");
  return parts[static_cast<std::size_t>(index)];
}

TransportScene::TransportScene(const scene::Scene& scene, const TransportOptions& options) {
  scene::check_indices(scene);
  data_ = std::make_shared<const Data>(scene, options);
}

TransportScene::~TransportScene() = default;

int TransportScene::part_count() const {
  return static_cast<int>(data_->parts.size());
}

const std::string& TransportScene::part_name(int part) const {
  return data_->part(part).name;
}

scene::Bounds TransportScene::part_bounds(int part) const {
  return data_->part(part).bounds;
}

float TransportScene::duration() const {
  return scene::animation_duration(data_->scene);
}

mat4 TransportScene::part_pose(int part, float time) const {
  const int node = data_->part(part).node;
  return node < 0 ? mat4(1) : scene::world_matrices(data_->scene, time)[static_cast<std::size_t>(node)];
}

std::uint64_t TransportScene::rays_traced() const {
  return data_->rays.total();
}

}  // namespace ssphh::trace
