#include <algorithm>
#include <array>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>

#include "../surface/material_lookup.h"
#include "distant_lights.h"
#include "mesh_light.h"
#include "punctual_lights.h"

namespace ssphh::shading {
namespace {

/// Up to so many local lights are weighed anew at each point; more are chosen by their power.
constexpr std::size_t max_weighed = 16;

/// Probability to choose any light in reach, however weak; the rest goes by importance. A strong light may be
/// hidden.
constexpr float uniform_share = 0.2f;

mat4 matrix_at(const std::vector<mat4>& world, int node) {
  return node < 0 ? mat4(1) : world[static_cast<std::size_t>(node)];
}

}  // namespace

struct LightSet::Data {
  const scene::Scene* scene = nullptr;
  float scene_radius = 0;
  std::vector<std::string> groups;
  std::vector<PosedLight> lights;  ///< of the scene, as they are now
  std::vector<PointLight> points;
  std::vector<SphereLight> spheres;
  std::vector<std::shared_ptr<const MeshLight>> meshes;
  std::vector<int> instance_group, instance_mesh_light;
  std::vector<std::shared_ptr<const MeshLight>> moved_meshes;  ///< [instance], not as in the base
  DistantLights distant;
  std::vector<float> powers;      ///< scratch
  Distribution by_power;          ///< local lights: points, spheres, meshes in this order
  float distant_probability = 0;  ///< to choose among the distant lights

  std::size_t local_count() const { return points.size() + spheres.size() + meshes.size(); }

  void read_lights();
  void add_lights();
  void add_meshes(const std::vector<mat4>& world, const Data* base);
  void divide_choices();

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

  /// Probabilities of the local lights as seen from a point, few lights only. False: none reaches the point.
  bool weigh(const vec3& from, std::array<float, max_weighed>& probability) const {
    const std::size_t count = local_count();
    if (count == 1) {
      probability[0] = 1;
      return true;
    }
    float total = 0, active = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const float w = importance(i, from);
      probability[i] = w;
      total += w;
      active += w > 0 ? 1.0f : 0.0f;
    }
    if (!(total > 0 && std::isfinite(total))) return false;
    const float scale = (1 - uniform_share) / total, base = uniform_share / active;
    for (std::size_t i = 0; i < count; ++i)
      probability[i] = probability[i] > 0 ? base + scale * probability[i] : 0;
    return true;
  }

  float local_probability(std::size_t i, const vec3& from) const {
    const float any = 1 - distant_probability;
    if (local_count() > max_weighed) return any * by_power.probability(i);
    std::array<float, max_weighed> probability;
    return weigh(from, probability) ? any * probability[i] : 0;
  }

  Distribution::Choice choose_local(const vec3& from, float u) const {
    if (local_count() > max_weighed) return by_power.sample(u);
    std::array<float, max_weighed> probability;
    if (!weigh(from, probability)) return {0, 0, 0};
    std::size_t chosen = 0;
    float below = 0;
    for (std::size_t i = 0; i < local_count(); ++i) {
      if (!(probability[i] > 0)) continue;
      chosen = i;
      if (u < below + probability[i]) break;
      below += i + 1 < local_count() ? probability[i] : 0;
    }
    const float p = probability[chosen];
    return {chosen, glm::clamp((u - below) / p, 0.0f, 0x1.fffffep-1f), p};
  }
};

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
  std::shared_ptr<const EnvironmentLight> environment;
  if (scene.environment) {
    const int group = scene::light_group_index(d.groups, scene::light_group(*scene.environment));
    environment = std::make_shared<const EnvironmentLight>(*scene.environment, group);
  }
  d.distant.assign(d.lights, std::move(environment));
  if (!d.distant.empty() && d.local_count() > 0) d.scene_radius = scene::world_bounds(scene, world).radius();
  d.divide_choices();
}

LightSet::LightSet(const LightSet& base, const std::vector<mat4>& world,
                   std::span<const scene::LightState> states, float environment_rotation)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.scene = base.data_->scene;
  d.scene_radius = base.data_->scene_radius;
  d.groups = base.data_->groups;
  d.read_lights();
  pose(base, world, states, environment_rotation);
}

void LightSet::pose(const LightSet& base, const std::vector<mat4>& world,
                    std::span<const scene::LightState> states, float environment_rotation) {
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
  std::shared_ptr<const EnvironmentLight> environment = base.data_->distant.environment();
  if (environment && environment_rotation != 0) {
    const float rotation = d.scene->environment->rotation + environment_rotation;
    const std::shared_ptr<const EnvironmentLight>& last = d.distant.environment();
    environment = last && last->rotation() == rotation
                      ? last
                      : std::make_shared<const EnvironmentLight>(environment->turned(rotation));
  }
  d.distant.assign(d.lights, std::move(environment));
  d.divide_choices();
}

void LightSet::Data::read_lights() {
  for (const scene::Light& light : scene->lights)
    lights.push_back({light, mat4(1), scene::light_group_index(groups, scene::light_group(light)), {}});
}

void LightSet::Data::add_lights() {
  points.clear();
  spheres.clear();
  for (const PosedLight& posed : lights) {
    const auto& [light, world, group, emission] = posed;
    if (!(luminance(light.color * light.intensity) > 0)) continue;
    if (light.type == scene::LightType::point || light.type == scene::LightType::spot) {
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
    if (base && base->instance_mesh_light[i] >= 0)
      light = base->meshes[static_cast<std::size_t>(base->instance_mesh_light[i])];
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

/// Divides the samples between distant and local lights by the irradiance they give, neither below a quarter.
void LightSet::Data::divide_choices() {
  powers.clear();
  float total = 0;
  for (std::size_t i = 0; i < local_count(); ++i) powers.push_back(power(i)), total += powers.back();
  by_power.assign(powers);
  if (distant.empty()) {
    distant_probability = 0;
  } else if (by_power.empty()) {
    distant_probability = 1;
  } else {
    const float local = scene_radius > 0 ? total / (scene_radius * scene_radius) : distant.irradiance();
    distant_probability = glm::clamp(distant.irradiance() / (distant.irradiance() + local), 0.25f, 0.75f);
  }
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
    d.meshes.push_back(data_->meshes[static_cast<std::size_t>(before)]);
  }
  d.distant = d.distant.without(groups);
  d.divide_choices();
  return rest;
}

LightSet::~LightSet() = default;
LightSet::LightSet(LightSet&&) noexcept = default;
LightSet& LightSet::operator=(LightSet&&) noexcept = default;

bool LightSet::empty() const {
  return data_->by_power.empty() && data_->distant.empty();
}
const std::vector<std::string>& LightSet::groups() const {
  return data_->groups;
}

std::optional<LightSample> LightSet::sample(const vec3& position, float u_choice, const vec2& u) const {
  const Data& d = *data_;
  if (u_choice < d.distant_probability) {
    auto s = d.distant.sample(u_choice / d.distant_probability, u);
    if (s) s->pdf *= d.distant_probability;
    return s;
  }
  if (d.by_power.empty()) return std::nullopt;
  const float any_local = 1 - d.distant_probability;
  const auto choice = d.choose_local(position, (u_choice - d.distant_probability) / any_local);
  if (!(choice.probability > 0)) return std::nullopt;
  auto s = d.sample(choice.index, position, choice.u, u);
  if (s) s->pdf *= any_local * choice.probability;
  return s;
}

namespace {

void check_emitter(int index, const LightSet& lights) {
  require(index >= 0 && index < lights.emitter_count(), "light set", "there is no emitter of that index");
}

}  // namespace

int LightSet::emitter_count() const {
  return static_cast<int>(data_->local_count() + data_->distant.count());
}

Emitter LightSet::emitter(int index) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i < d.points.size()) {
    const PointLight& light = d.points[i];
    return {EmitterKind::point, light.group, {light.position - light.radius, light.position + light.radius}};
  }
  i -= d.points.size();
  if (i < d.spheres.size()) {
    const SphereLight& light = d.spheres[i];
    return {EmitterKind::sphere, light.group, {light.center - light.radius, light.center + light.radius}};
  }
  i -= d.spheres.size();
  if (i < d.meshes.size()) return {EmitterKind::mesh, d.meshes[i]->group(), d.meshes[i]->bounds()};
  return d.distant.emitter(i - d.meshes.size());
}

std::optional<LightSample> LightSet::sample_emitter(int index, const vec3& position, const vec2& u) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i < d.points.size()) return d.points[i].sample(position);
  i -= d.points.size();
  if (i < d.spheres.size()) return d.spheres[i].sample(position, u);
  i -= d.spheres.size();
  if (i < d.meshes.size()) return d.meshes[i]->sample(position, u);
  return d.distant.sample_one(i - d.meshes.size(), u);
}

float LightSet::flux(int index, float radius) const {
  check_emitter(index, *this);
  const auto i = static_cast<std::size_t>(index);
  const std::size_t local = data_->local_count();
  return i < local ? 4 * pi * data_->power(i) : data_->distant.flux(i - local, radius);
}

std::optional<EmittedPhoton> LightSet::emit(int index, const vec2& u_place, const vec2& u_direction,
                                            const vec3& center, float radius) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  auto i = static_cast<std::size_t>(index);
  if (i < d.points.size()) return EmittedPhoton{d.points[i].emit(u_direction)};
  i -= d.points.size();
  if (i < d.spheres.size()) return EmittedPhoton{d.spheres[i].emit(u_place, u_direction)};
  i -= d.spheres.size();
  if (i < d.meshes.size()) return d.meshes[i]->emit(u_place, u_direction);
  const auto photon = d.distant.emit(i - d.meshes.size(), u_place, u_direction, center, radius);
  return photon ? std::optional(EmittedPhoton{*photon}) : std::nullopt;
}

std::optional<MeshView> LightSet::view_mesh(int index, const vec3& position, const vec3& normal) const {
  check_emitter(index, *this);
  const Data& d = *data_;
  const std::size_t i = static_cast<std::size_t>(index) - d.points.size() - d.spheres.size();
  return i < d.meshes.size() ? d.meshes[i]->view(position, normal) : std::nullopt;
}

std::optional<EmitterHit> LightSet::distant_radiance(int i, const vec3& direction) const {
  check_emitter(i, *this);
  const std::size_t local = data_->local_count();
  require(static_cast<std::size_t>(i) >= local, "light set", "that emitter is not distant");
  return data_->distant.radiance_of(static_cast<std::size_t>(i) - local, direction);
}

float LightSet::pdf_triangle(const vec3& position, int instance, std::uint32_t triangle, float distance,
                             float cos_light) const {
  const Data& d = *data_;
  require(instance >= 0 && static_cast<std::size_t>(instance) < d.instance_mesh_light.size(), "light set",
          "there is no instance of that index");
  const int mesh = d.instance_mesh_light[static_cast<std::size_t>(instance)];
  if (mesh < 0) return 0;
  const auto index = static_cast<std::size_t>(mesh);
  const float pdf = d.meshes[index]->pdf(position, triangle, distance, cos_light);
  return pdf > 0 ? pdf * d.local_probability(d.points.size() + d.spheres.size() + index, position) : 0;
}

int LightSet::instance_group(int instance) const {
  const std::vector<int>& groups = data_->instance_group;
  require(instance >= 0 && static_cast<std::size_t>(instance) < groups.size(), "light set",
          "there is no instance of that index");
  return groups[static_cast<std::size_t>(instance)];
}

int LightSet::sphere_count() const {
  return static_cast<int>(data_->spheres.size());
}

std::optional<EmitterHit> LightSet::intersect_sphere(int i, const vec3& origin, const vec3& direction,
                                                     float max_distance) const {
  const Data& d = *data_;
  const auto index = static_cast<std::size_t>(i);
  const SphereLight& light = d.spheres[index];
  const auto distance = light.intersect(origin, direction, max_distance);
  if (!distance) return std::nullopt;
  const float pdf = light.pdf(origin) * d.local_probability(d.points.size() + index, origin);
  return EmitterHit{*distance, light.radiance, pdf, light.group};
}

int LightSet::distant_count() const {
  return data_->distant.visible_count();
}

std::optional<EmitterHit> LightSet::distant(int i, const vec3& direction) const {
  auto hit = data_->distant.hit(i, direction);
  if (hit) hit->pdf *= data_->distant_probability;
  return hit;
}

}  // namespace ssphh::shading
