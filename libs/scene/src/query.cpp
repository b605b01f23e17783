#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/scene/placed_camera.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

constexpr std::size_t max_light_groups = 256;

const mat4& matrix_of(const std::vector<mat4>& world, int node) {
  static const mat4 identity(1);
  return node < 0 ? identity : world[node];
}

const Material& shading_material(const Scene& scene, const Instance& instance) {
  static const Material plain;
  const int index = instance_material(scene, instance);
  return index < 0 ? plain : scene.materials[index];
}

/// Camera in front (+z) of the scene, far enough to see all of it.
CameraPose front_camera(const Scene& scene, const std::vector<mat4>& world) {
  CameraPose pose{mat4(1), Camera{}};
  pose.camera.name = "default";
  const Bounds bounds = world_bounds(scene, world);
  if (bounds.empty()) return pose;
  const float distance = bounds.radius() / std::sin(0.5f * pose.camera.yfov);
  pose.world[3] = vec4(bounds.center() + vec3(0, 0, distance), 1);
  return pose;
}

}  // namespace

Bounds world_bounds(const Scene& scene, const std::vector<mat4>& world) {
  require(world.size() >= scene.nodes.size(), "scene", "there is not one matrix for each node");
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    const mat4& m = matrix_of(world, instance.node);
    for (const vec3& p : scene.meshes[instance.mesh].positions) {
      bounds.add(vec3(m * vec4(p, 1)));
    }
  }
  return bounds;
}

std::uint64_t triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene.instances) {
    count += scene.meshes[instance.mesh].triangles.size();
  }
  return count;
}

int instance_material(const Scene& scene, const Instance& instance) {
  if (instance.material >= 0) return instance.material;
  require(instance.mesh >= 0 && instance.mesh < static_cast<int>(scene.meshes.size()), "instance",
          "the scene has no such mesh");
  return scene.meshes[instance.mesh].material;
}

std::string light_group(const Light& light) {
  if (!light.group.empty()) return light.group;
  return light.name.empty() ? "light" : light.name;
}

std::string light_group(const Environment& environment) {
  if (!environment.group.empty()) return environment.group;
  return environment.name.empty() ? "environment" : environment.name;
}

std::string light_group(const Scene& scene, const Instance& instance) {
  if (!instance.light_group.empty()) return instance.light_group;
  if (instance.node < 0) return "emitter";
  require(instance.node < static_cast<int>(scene.nodes.size()), "instance", "the scene has no such node");
  const std::string& name = scene.nodes[instance.node].name;
  return name.empty() ? "emitter" : name;
}

bool is_dark(const Scene& scene, const std::string& group) {
  return std::ranges::find(scene.dark_groups, group) != scene.dark_groups.end();
}

bool is_emitter(const Scene& scene, const Instance& instance) {
  return shading_material(scene, instance).emissive() ||
         (!scene.dark_groups.empty() && is_dark(scene, light_group(scene, instance)));
}

std::vector<std::string> light_groups(const Scene& scene) {
  std::vector<std::string> groups;
  std::unordered_set<std::string> seen;
  const auto add = [&](std::string name) {
    if (seen.insert(name).second) groups.push_back(std::move(name));
  };
  for (const Light& light : scene.lights) add(light_group(light));
  for (const Instance& instance : scene.instances) {
    if (is_emitter(scene, instance)) add(light_group(scene, instance));
  }
  if (scene.environment) add(light_group(*scene.environment));
  if (groups.size() > max_light_groups) {
    groups.resize(max_light_groups);
    groups.back() = "other";
  }
  return groups;
}

int light_group_index(const std::vector<std::string>& groups, const std::string& name) {
  require(!groups.empty(), "light groups", "there are none");
  const auto found = std::ranges::find(groups, name);
  // A name that is not there was merged into the last group.
  return static_cast<int>(found == groups.end() ? groups.size() - 1
                                                : static_cast<std::size_t>(found - groups.begin()));
}

Camera find_camera(const Scene& scene, const std::string& name) {
  if (name.empty()) {
    return scene.cameras.empty() ? front_camera(scene, world_matrices(scene)).camera : scene.cameras.front();
  }
  std::string names;
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name) return camera;
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  throw Error(scene.name.empty() ? "scene" : scene.name, fmt::format("has no camera \"{}\"", name),
              names.empty() ? "it has no cameras; leave the name out for a view of the whole"
                            : "its cameras: " + names);
}

CameraPose camera_pose(const Scene& scene, const std::string& name, float time) {
  const auto is_name = [&](const Camera& camera) { return camera.name == name; };
  if (std::ranges::none_of(scene.cameras, is_name)) {
    if (const auto placed = placed_camera(name)) return placed->pose;
  }
  const std::vector<mat4> world = world_matrices(scene, time);
  if (name.empty() && scene.cameras.empty()) return front_camera(scene, world);
  const Camera camera = find_camera(scene, name);
  // A camera has no size: drop its node's scale.
  mat4 pose = matrix_of(world, camera.node);
  for (int axis = 0; axis < 3; ++axis) {
    const float length = glm::length(vec3(pose[axis]));
    if (length > 0) pose[axis] /= length;
  }
  return {pose, camera};
}

std::vector<ProbePlace> sphl_places(const Scene& scene, float time) {
  const std::vector<mat4> world = world_matrices(scene, time);
  std::vector<ProbePlace> places;
  for (const Sphl& sphl : scene.sphls) {
    if (sphl.enabled) places.push_back({sphl.name, vec3(matrix_of(world, sphl.node)[3]), sphl.radius});
  }
  return places;
}

}  // namespace ssphh::scene
