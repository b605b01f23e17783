#include <algorithm>
#include <cmath>
#include <limits>

#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>

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

/// What the light emits at the time, unless its own sequence says the same.
void hold_emission(Light& light, const sh::IntensitySh& now, float time) {
  if (now != emission_at(light.emission, time)) light.emission = {.frames = {now}};
  if (now.empty()) light.intensity = 0;
}

}  // namespace

Scene with_lighting(Scene scene, const LightingState& state) {
  const std::vector<std::string> groups = light_groups(scene);
  check_lighting(state, {scene.lights.size(), groups.size(), std::numeric_limits<std::size_t>::max()});
  const auto scale_of = [&](const std::string& group) {
    return state.group_scales[light_group_index(groups, group)];
  };
  const std::vector<mat4> world = world_matrices(scene, state.time);

  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    Light& light = scene.lights[i];
    light.color = state.lights[i].color * scale_of(light_group(light));
    light.intensity = state.lights[i].intensity;
    if (light.type == LightType::sphl) hold_emission(light, state.lights[i].emission, state.time);
    if (state.lights[i].world == world[light.node]) continue;
    Node node;
    node.name = light.name;
    node.matrix = state.lights[i].world;
    light.node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(node);
  }
  for (Instance& instance : scene.instances) {
    const int material = instance_material(scene, instance);
    if (material < 0 || !scene.materials[material].emissive()) continue;
    const vec3 factor = scale_of(light_group(scene, instance));
    if (factor != vec3(1)) scale_emission(scene, instance, factor);
  }
  if (scene.environment) {
    scene.environment->color *= scale_of(light_group(*scene.environment));
    scene.environment->rotation += state.environment_rotation;
    if (state.environment_image) {
      scene.environment->equirect = *state.environment_image;
      scene.environment->sun_sky.reset();
    }
  }
  // No factor gives back what was put out before.
  scene.dark_groups.clear();
  const std::vector<std::string> shining = light_groups(scene);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (state.group_scales[g] == vec3(0) || std::ranges::find(shining, groups[g]) == shining.end())
      scene.dark_groups.push_back(groups[g]);
  }
  return scene;
}

Scene without_dark_light(Scene scene) {
  if (scene.dark_groups.empty()) return scene;
  const LightingState state = lighting_at(scene);
  return with_lighting(std::move(scene), state);
}

Scene keeping_dark_light(Scene scene, LightingState state) {
  const std::vector<std::string> groups = light_groups(scene);
  check_lighting(state, {scene.lights.size(), groups.size(), std::numeric_limits<std::size_t>::max()});
  std::vector<std::string> dark;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (state.group_scales[g] != vec3(0)) continue;
    dark.push_back(groups[g]);
    state.group_scales[g] = vec3(1);
  }
  scene = with_lighting(std::move(scene), state);
  scene.dark_groups = std::move(dark);
  return scene;
}

Scene lit_by_sphere(const Scene& scene, float time, const vec3& center, float radius, float radiance) {
  require(radius > 0 && std::isfinite(radius), "emitting sphere", "its radius must be over 0");
  LightingState dark = lighting_at(scene, time);
  for (vec3& scale : dark.group_scales) scale = vec3(0);
  Scene lit = with_lighting(scene, dark);
  lit.lights.clear();
  lit.environment.reset();
  lit.dark_groups.clear();
  Light& light = lit.lights.emplace_back();
  light.name = "emitter", light.type = LightType::sphere;
  light.radius = radius, light.intensity = radiance;
  light.node = static_cast<int>(lit.nodes.size());
  Node& node = lit.nodes.emplace_back();
  node.name = light.name, node.local.translation = center;
  return lit;
}

}  // namespace ssphh::scene
