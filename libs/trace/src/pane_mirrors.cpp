#include "pane_mirrors.h"

#include <algorithm>

#include "glass_passage.h"
#include "surface_gap.h"

namespace ssphh::trace {
namespace {

/// About the share of the hemisphere that a pane covers, as seen by a surface; 0 where it sees none of it.
float apparent_size(const Pane& pane, const vec3& position, const vec3& normal) {
  const vec3 way = pane.bounds.center() - position;
  if (!(std::abs(pane.above(position)) > 2 * position_error(max_abs_component(position)))) return 0;
  if (!(glm::dot(farthest(pane.bounds, normal) - position, normal) > 0)) return 0;
  return pane.area / (pi * glm::dot(way, way) + pane.area);
}

/// The chance that any pane is chosen, where they cover so much of the hemisphere.
float any_chance(float covered) {
  return std::min(1.0f, 4 * covered);
}

bool is_flat(const Pane& pane, const scene::Scene& scene) {
  constexpr float bent = 1e-6f;
  const scene::Instance& instance = scene.instances[pane.instance];
  const scene::Material& material = scene.materials[scene::instance_material(scene, instance)];
  const scene::Mesh& mesh = scene.meshes[instance.mesh];
  if (material.normal_texture.texture >= 0 || material.alpha_mode != scene::AlphaMode::opaque) return false;
  return mesh.normals.empty() || std::ranges::all_of(pane.triangles, [&](const Pane::Triangle& triangle) {
           const uvec3& corners = mesh.triangles[triangle.index];
           const vec3 &a = mesh.normals[corners.x], &b = mesh.normals[corners.y],
                      &c = mesh.normals[corners.z];
           return std::min({glm::dot(a, b), glm::dot(b, c), glm::dot(c, a)}) > 1 - bent;
         });
}

}  // namespace

PaneMirrors::PaneMirrors(std::vector<Pane> panes, const scene::Scene& scene) : panes_(std::move(panes)) {
  std::erase_if(panes_, [&](const Pane& pane) { return !is_flat(pane, scene); });
  std::ranges::stable_sort(panes_, {}, &Pane::instance);
}

PaneMirrors::Choice PaneMirrors::choose(const vec3& position, const vec3& normal, float u) const {
  float covered = 0;
  for (const Pane& pane : panes_) covered += apparent_size(pane, position, normal);
  const float any = any_chance(covered);
  if (!(u < any)) return {};
  float left = u / any * covered;
  Choice choice;
  for (const Pane& pane : panes_) {
    const float size = apparent_size(pane, position, normal);
    if (!(size > 0)) continue;
    choice = {&pane, any * size / covered};
    left -= size;
    if (left < 0) break;
  }
  return choice;
}

float PaneMirrors::chance(const vec3& position, const vec3& normal, const Pane& pane) const {
  float covered = 0;
  for (const Pane& other : panes_) covered += apparent_size(other, position, normal);
  return covered > 0 ? any_chance(covered) * apparent_size(pane, position, normal) / covered : 0;
}

const Pane* PaneMirrors::at(const Hit& hit) const {
  for (const Pane& pane : std::ranges::equal_range(panes_, hit.instance, {}, &Pane::instance)) {
    for (const Pane::Triangle& triangle : pane.triangles)
      if (triangle.index == hit.triangle) return &pane;
  }
  return nullptr;
}

vec3 mirrored_by(const shading::Surface& surface, const vec3& direction, const Passage& passage) {
  if (!passes(surface.glass, passage)) return vec3(0);
  const float cosine = glm::clamp(-glm::dot(surface.normal, direction), 0.0f, 1.0f);
  return surface.glass.share * shading::sheet_reflectance(surface.glass, cosine);
}

vec3 mirrored_share(const PosedGeometry& scene, const Pane& pane, const vec3& start, const vec3& position,
                    const shading::LightSample& toward, const Passage& passage, RayTask& task,
                    vec3* mirrored) {
  Hit hit;
  if (!pane.meets(position, toward.wi, hit) || !(hit.distance < toward.distance)) return vec3(0);
  vec3 ray_origin;
  const shading::Surface surface = scene.surface(hit, -toward.wi, ray_origin);
  const bool is_there = passage.seed != 0 || surface.alpha >= 0.5f;
  const vec3 by_pane = is_there ? mirrored_by(surface, toward.wi, passage) : vec3(0);
  if (mirrored) *mirrored = by_pane;
  if (!(max_component(by_pane) > 0)) return vec3(0);
  shading::LightSample way = toward;
  way.distance = hit.distance;
  vec3 share = scene.transmittance(shadow_ray(start, position, way), passage, task);
  if (!(max_component(share) > 0)) return vec3(0);
  way.wi = pane.mirrored_direction(toward.wi);
  way.distance = toward.distance - hit.distance;
  share *= scene.transmittance(shadow_ray(ray_origin, surface.position, way), passage, task);
  return share * by_pane;
}

}  // namespace ssphh::trace
