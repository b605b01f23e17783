#include "builder.h"

#include <cmath>
#include <utility>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {

Transform at(const vec3& translation, float degrees, const vec3& axis) {
  return {translation, glm::angleAxis(glm::radians(degrees), glm::normalize(axis)), vec3(1)};
}

Transform looking_at(const vec3& eye, const vec3& target) {
  const vec3 direction = glm::normalize(target - eye);
  const vec3 up = std::abs(direction.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  return {eye, glm::normalize(glm::quatLookAt(direction, up)), vec3(1)};
}

Material thin_glass(const std::string& name, const vec3& tint) {
  Material m;
  m.name = name;
  m.base_color = tint;
  m.specular_roughness = 0;
  m.transmission = 1;
  return m;
}

Material solid_glass(const std::string& name, const vec3& color, float distance) {
  Material m = thin_glass(name, vec3(1));
  m.thickness = distance, m.attenuation_color = color, m.attenuation_distance = distance;
  return m;
}

int Builder::add_material(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<int>(scene_.materials.size()) - 1;
}

int Builder::matte(const std::string& name, const vec3& albedo, const vec3& emission) {
  Material m;
  m.name = name;
  m.base_color = albedo;
  m.specular = 0;
  m.emission = emission;
  return add_material(std::move(m));
}

int Builder::glossy(const std::string& name, const vec3& albedo, float roughness, float metallic) {
  Material m;
  m.name = name;
  m.base_color = albedo;
  m.metallic = metallic;
  m.specular_roughness = roughness;
  return add_material(std::move(m));
}

int Builder::metal(const std::string& name, const vec3& f0, float roughness) {
  return glossy(name, f0, roughness, 1);
}

int Builder::pane(const std::string& name, const vec3& tint) {
  return add_material(thin_glass(name, tint));
}

int Builder::body(const std::string& name, const vec3& color, float distance, float ior) {
  Material m = solid_glass(name, color, distance);
  m.ior = ior;
  return add_material(std::move(m));
}

int Builder::node(const std::string& name, const Transform& local, int parent) {
  Node n;
  n.name = name;
  n.parent = parent >= 0 ? parent : parent_;
  n.local = local;
  scene_.nodes.push_back(std::move(n));
  return static_cast<int>(scene_.nodes.size()) - 1;
}

void Builder::add_at(int node, const std::string& name, Mesh mesh, int material) {
  mesh.name = name;
  mesh.material = material;
  scene_.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.mesh = static_cast<int>(scene_.meshes.size()) - 1;
  instance.node = node;
  scene_.instances.push_back(instance);
}

int Builder::add(const std::string& name, Mesh mesh, int material, const Transform& local) {
  add_at(node(name, local), name, std::move(mesh), material);
  return static_cast<int>(scene_.meshes.size()) - 1;
}

void Builder::again(const std::string& name, int mesh, int material, const Transform& local) {
  Instance instance;
  instance.mesh = mesh;
  instance.node = node(name, local);
  instance.material = material;
  scene_.instances.push_back(instance);
}

void Builder::add_emitter(const std::string& name, const std::string& group, Mesh mesh,
                          const vec3& radiance) {
  add(name, std::move(mesh), matte(name, vec3(0), radiance));
  scene_.instances.back().light_group = group;
}

void Builder::camera(const std::string& name, const vec3& eye, const vec3& target, float yfov, float aspect) {
  Camera c;
  c.name = name;
  c.node = node("camera " + name, looking_at(eye, target));
  c.yfov = glm::radians(yfov);
  c.aspect = aspect;
  scene_.cameras.push_back(std::move(c));
}

Light& Builder::light(const std::string& name, LightType type, const Transform& place, const vec3& color,
                      float intensity, const std::string& group) {
  Light l;
  l.name = name;
  l.group = group;
  l.node = node(name, place);
  l.type = type;
  l.color = color;
  l.intensity = intensity;
  scene_.lights.push_back(std::move(l));
  return scene_.lights.back();
}

void Builder::point_light(const std::string& name, const vec3& position, const vec3& color, float intensity,
                          const std::string& group) {
  light(name, LightType::point, at(position), color, intensity, group);
}

void Builder::sphere_light(const std::string& name, const vec3& position, float radius, const vec3& color,
                           float radiance, const std::string& group) {
  light(name, LightType::sphere, at(position), color, radiance, group).radius = radius;
}

void Builder::spot_light(const std::string& name, const vec3& position, const vec3& target, const vec3& color,
                         float intensity, float inner, float outer, const std::string& group) {
  Light& l = light(name, LightType::spot, looking_at(position, target), color, intensity, group);
  l.inner_cone = glm::radians(inner);
  l.outer_cone = glm::radians(outer);
}

void Builder::sphl(const std::string& name, const vec3& position, float radius) {
  Sphl s;
  s.name = name;
  s.node = node("SPHL " + name, at(position));
  s.radius = radius;
  scene_.sphls.push_back(std::move(s));
}

void Builder::sphl(const std::string& name, const vec3& position, float radius, Emission emission,
                   float intensity) {
  sphl(name, position, radius);
  Light l;
  l.name = name, l.node = scene_.sphls.back().node;
  l.type = LightType::sphl, l.radius = radius;
  l.emission = std::move(emission), l.intensity = intensity;
  scene_.lights.push_back(std::move(l));
}

Scene Builder::finish() {
  SSPHH_CHECK(validate(scene_).empty());
  return std::move(scene_);
}

}  // namespace ssphh::scene
