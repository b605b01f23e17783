#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lights.h>

namespace ssphh::scene {
namespace {

/// The material of an emissive instance, times `factor`: a copy, since other groups may share it.
void scale_emission(Scene& scene, Instance& instance, const vec3& factor) {
  const auto material = static_cast<std::size_t>(instance_material(scene, instance));
  scene.materials.push_back(scene.materials[material]);
  Material& own = scene.materials.back();
  own.emission *= factor;
  if (own.unlit) own.base_color *= factor;
  instance.material = static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace

Scene with_lights(Scene scene, float time, std::span<const LightState> lights,
                  std::span<const vec3> group_scales, float environment_rotation) {
  const std::vector<std::string> groups = light_groups(scene);
  if (lights.size() != scene.lights.size() ||
      (!group_scales.empty() && group_scales.size() != groups.size())) {
    throw Error("lights",
                fmt::format("{} lights and {} groups were given, but the scene has {} and {}", lights.size(),
                            group_scales.size(), scene.lights.size(), groups.size()));
  }
  const auto scale_of = [&](const std::string& group) {
    if (group_scales.empty()) return vec3(1);
    return group_scales[static_cast<std::size_t>(light_group_index(groups, group))];
  };
  const std::vector<mat4> world = world_matrices(scene, time);

  for (std::size_t i = 0; i < lights.size(); ++i) {
    Light& light = scene.lights[i];
    light.color = lights[i].color * scale_of(light_group(light));
    light.intensity = lights[i].intensity;
    if (lights[i].world == world[static_cast<std::size_t>(light.node)]) continue;
    Node node;
    node.name = light.name;
    node.matrix = lights[i].world;
    light.node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(node);
  }
  for (Instance& instance : scene.instances) {
    const int material = instance_material(scene, instance);
    if (material < 0 || !scene.materials[static_cast<std::size_t>(material)].emissive()) continue;
    const vec3 factor = scale_of(light_group(scene, instance));
    if (factor != vec3(1)) scale_emission(scene, instance, factor);
  }
  if (scene.environment) {
    scene.environment->color *= scale_of(light_group(*scene.environment));
    scene.environment->rotation += environment_rotation;
  }
  return scene;
}

}  // namespace ssphh::scene
