/// Lights read from a scene, and posed anew.

#include <algorithm>

#include <ssphh/core/require.h>
#include <ssphh/scene/area_lamp.h>

#include "../surface/material_lookup.h"
#include "light_set_data.h"
#include "profile_intensity.h"

namespace ssphh::shading {
namespace {

mat4 matrix_at(const std::vector<mat4>& world, int node) {
  return node < 0 ? mat4(1) : world[node];
}

/// The light of the scene's own environment as it is now; `last` is kept where it is the same.
std::shared_ptr<const EnvironmentLight> environment_light(const std::shared_ptr<const EnvironmentLight>& own,
                                                          const std::shared_ptr<const EnvironmentLight>& last,
                                                          const scene::Scene& scene,
                                                          const scene::EnvironmentState& now) {
  if (!own || now == scene::EnvironmentState()) return own;
  const float rotation = scene.environment->rotation + now.rotation;
  if (last && last->rotation() == rotation && last->image() == now.image) return last;
  if (!now.image) return std::make_shared<const EnvironmentLight>(own->turned(rotation));
  if (last && last->image() == now.image)
    return std::make_shared<const EnvironmentLight>(last->turned(rotation));
  return std::make_shared<const EnvironmentLight>(now.image, scene.environment->color, rotation,
                                                  own->group());
}

}  // namespace

LightSet::LightSet(const scene::Scene& scene, const std::vector<mat4>& world, float time)
    : data_(std::make_unique<Data>()) {
  scene::check_indices(scene);
  require(world.size() >= scene.nodes.size(), "light set", "there is not one matrix for each node");
  Data& d = *data_;
  d.scene = &scene;
  d.groups = scene::light_groups(scene);
  d.read_lights();
  for (PosedLight& light : d.lights) {
    light.world = matrix_at(world, light.light.node);
    light.emission = scene::emission_at(light.light.emission, time);
  }
  d.add_lights();
  d.add_meshes(world, nullptr);
  d.add_flat_lamps();
  std::shared_ptr<const EnvironmentLight> environment;
  if (scene.environment) {
    const int group = scene::light_group_index(d.groups, scene::light_group(*scene.environment));
    environment = std::make_shared<const EnvironmentLight>(*scene.environment, group);
  }
  d.distant.assign(d.lights, std::move(environment));
  d.grow_tree();
}

LightSet::LightSet(const LightSet& base, const std::vector<mat4>& world,
                   std::span<const scene::LightState> states, const scene::EnvironmentState& surroundings)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.scene = base.data_->scene;
  d.groups = base.data_->groups;
  d.lights = base.data_->lights;
  d.flat_lamps = base.data_->flat_lamps;
  pose(base, world, states, surroundings);
}

void LightSet::pose(const LightSet& base, const std::vector<mat4>& world,
                    std::span<const scene::LightState> states, const scene::EnvironmentState& surroundings) {
  Data& d = *data_;
  require(d.scene == base.data_->scene, "light set", "it was not made of this one");
  require(world.size() >= d.scene->nodes.size(), "light set", "there is not one matrix for each node");
  require(states.size() == d.lights.size(), "light set", "there is not one state for each light");
  for (std::size_t i = 0; i < states.size(); ++i) {
    d.lights[i].world = states[i].world;
    d.lights[i].light.color = states[i].color;
    d.lights[i].light.intensity = states[i].intensity;
    d.lights[i].emission = states[i].emission;
  }
  d.add_lights();
  d.add_meshes(world, base.data_.get());
  d.add_flat_lamps();
  d.distant.assign(d.lights, environment_light(base.data_->distant.environment(), d.distant.environment(),
                                               *d.scene, surroundings));
  d.grow_tree();
}

void LightSet::Data::read_lights() {
  for (const scene::Light& light : scene->lights)
    lights.push_back({light, mat4(1), scene::light_group_index(groups, scene::light_group(light))});
  // Lamps of one luminaire share its table.
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const scene::Light& light = lights[i].light;
    if (!light.has_profile()) continue;
    const auto alike = std::find_if(lights.begin(), lights.begin() + i, [&](const PosedLight& other) {
      return other.profile && light.type == scene::LightType::point && other.light.type == light.type &&
             other.light.profile == light.profile;
    });
    lights[i].profile =
        alike == lights.begin() + i ? std::make_shared<const ProfileTable>(light) : alike->profile;
  }
}

void LightSet::Data::add_lights() {
  points.clear();
  spheres.clear();
  for (const PosedLight& posed : lights) {
    const auto& [light, world, group, emission, profile] = posed;
    if (!(luminance(light.color * light.intensity) > 0)) continue;
    if (profile) {
      points.push_back(make_profile_light(posed, group));
    } else if (light.type == scene::LightType::point || light.type == scene::LightType::spot) {
      points.push_back(make_point_light(light, world, group));
    } else if (light.type == scene::LightType::sphl && !emission.empty()) {
      points.push_back(make_sphl_light(posed, group));
    } else if (light.type == scene::LightType::sphere && light.radius > 0) {
      spheres.push_back(make_sphere_light(light, world, group));
    }
  }
}

/// Emissive instances; unlit ones are seen but light nothing. Those that stand as in `base` are shared.
void LightSet::Data::add_meshes(const std::vector<mat4>& world, const Data* base) {
  if (base) {
    instance_group = base->instance_group;
  } else {
    instance_group.assign(scene->instances.size(), -1);
    for (std::size_t i = 0; i < scene->instances.size(); ++i) {
      const scene::Instance& instance = scene->instances[i];
      if (material_at(*scene, scene::instance_material(*scene, instance)).emissive())
        instance_group[i] = scene::light_group_index(groups, scene::light_group(*scene, instance));
    }
  }
  instance_mesh_light.assign(scene->instances.size(), -1);
  moved_meshes.resize(scene->instances.size());
  meshes.clear();
  for (std::size_t i = 0; i < scene->instances.size(); ++i) {
    const scene::Instance& instance = scene->instances[i];
    const scene::Material& material = material_at(*scene, scene::instance_material(*scene, instance));
    if (instance_group[i] < 0 || material.unlit) continue;
    const mat4 matrix = matrix_at(world, instance.node);
    std::shared_ptr<const MeshLight> light;
    if (base && base->instance_mesh_light[i] >= 0) light = base->meshes[base->instance_mesh_light[i]];
    if (!light || light->world() != matrix) {
      std::shared_ptr<const MeshLight>& moved = moved_meshes[i];
      if (!moved || moved->world() != matrix)
        moved = std::make_shared<const MeshLight>(*scene, instance, matrix, instance_group[i]);
      light = moved;
    }
    if (light->empty()) continue;
    instance_mesh_light[i] = static_cast<int>(meshes.size());
    meshes.push_back(std::move(light));
  }
}

/// Those that stand and shine as before are kept.
void LightSet::Data::add_flat_lamps() {
  flat_from = meshes.size();
  flat_lamps.resize(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const PosedLight& posed = lights[i];
    const vec3 radiance = posed.light.color * posed.light.intensity;
    if (!scene::is_area_lamp(posed.light.type) || !(luminance(radiance) > 0)) continue;
    std::shared_ptr<const MeshLight>& lamp = flat_lamps[i];
    if (!lamp || lamp->world() != posed.world || lamp->emission() != radiance)
      lamp = std::make_shared<const MeshLight>(posed.light, posed.world, posed.group);
    if (!lamp->empty()) meshes.push_back(lamp);
  }
}

void LightSet::Data::grow_tree() {
  tree_lights.clear();
  for (std::size_t i = 0; i < local_count(); ++i) tree_lights.push_back({bounds(i), power(i)});
  tree.assign(tree_lights);
}

LightSet::LightSet() : data_(std::make_unique<Data>()) {}

LightSet LightSet::without(std::span<const int> groups) const {
  const auto is_one = [&](int group) { return std::ranges::find(groups, group) != groups.end(); };
  LightSet rest;
  Data& d = *rest.data_;
  d = *data_;
  std::erase_if(d.points, [&](const PointLight& light) { return is_one(light.group); });
  std::erase_if(d.spheres, [&](const SphereLight& light) { return is_one(light.group); });
  d.meshes.clear();
  for (std::size_t i = 0; i < d.instance_group.size(); ++i) {
    int& mesh = d.instance_mesh_light[i];
    const int before = mesh;
    if (is_one(d.instance_group[i])) d.instance_group[i] = mesh = -1;
    if (mesh < 0) continue;
    mesh = static_cast<int>(d.meshes.size());
    d.meshes.push_back(data_->meshes[before]);
  }
  d.flat_from = d.meshes.size();
  for (std::size_t i = data_->flat_from; i < data_->meshes.size(); ++i)
    if (!is_one(data_->meshes[i]->group())) d.meshes.push_back(data_->meshes[i]);
  d.distant = d.distant.without(groups);
  d.grow_tree();
  return rest;
}

}  // namespace ssphh::shading
