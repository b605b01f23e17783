#include "pane_mirrors.h"

#include <algorithm>
#include <functional>

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

/// What a surface sees of panes.
struct Seen {
  float covered = 0;  ///< of the hemisphere, about
  float count = 0;

  /// Half of the choices by size, for lamps and skies, half even, for a sun, which fills a small pane as
  /// well.
  float chance(float size) const { return size > 0 ? 0.5f * (size / covered + 1 / count) : 0; }
};

Seen seen_from(const std::vector<Pane>& panes, const vec3& position, const vec3& normal) {
  Seen seen;
  for (const Pane& pane : panes) {
    const float size = apparent_size(pane, position, normal);
    seen.covered += size;
    seen.count += size > 0 ? 1 : 0;
  }
  return seen;
}

bool is_flat(const Pane& pane, const scene::Scene& scene) {
  constexpr float bent = 1e-6f;
  const scene::Instance& instance = scene.instances[pane.instance];
  const scene::Material& material = scene.materials[scene::instance_material(scene, instance)];
  const scene::Mesh& mesh = scene.meshes[instance.mesh];
  if (material.normal_texture.texture >= 0 || material.alpha_mode != scene::AlphaMode::opaque) return false;
  return mesh.normals.empty() || std::ranges::all_of(pane.triangles, [&](const Pane::Triangle& triangle) {
           const uvec3& corners = mesh.triangles[triangle.index];
           const vec3& a = mesh.positions[corners.x];
           const vec3 normal =
               glm::normalize(glm::cross(mesh.positions[corners.y] - a, mesh.positions[corners.z] - a));
           const auto along = [&](std::uint32_t corner) { return glm::dot(mesh.normals[corner], normal); };
           const float first = along(corners.x), second = along(corners.y), third = along(corners.z);
           return std::min({first, second, third}) > 1 - bent || std::max({first, second, third}) < bent - 1;
         });
}

}  // namespace

PaneMirrors::PaneMirrors(std::vector<Pane> panes, const scene::Scene& scene) : panes_(std::move(panes)) {
  std::erase_if(panes_, [&](const Pane& pane) { return !is_flat(pane, scene); });
  std::ranges::stable_sort(panes_, std::greater<>(), &Pane::area);
  panes_.resize(std::min(panes_.size(), most_panes));
  std::ranges::stable_sort(panes_, {}, &Pane::instance);
}

PaneMirrors::Choice PaneMirrors::choose(const vec3& position, const vec3& normal, float u) const {
  const Seen seen = seen_from(panes_, position, normal);
  Choice choice;
  for (const Pane& pane : panes_) {
    const float chance = seen.chance(apparent_size(pane, position, normal));
    if (!(chance > 0)) continue;
    choice = {&pane, chance};
    u -= chance;
    if (u < 0) break;
  }
  return choice;
}

float PaneMirrors::chance(const vec3& position, const vec3& normal, const Pane& pane) const {
  return seen_from(panes_, position, normal).chance(apparent_size(pane, position, normal));
}

const Pane* PaneMirrors::at(const Hit& hit) const {
  auto pane = std::ranges::lower_bound(panes_, hit.instance, {}, &Pane::instance);
  for (; pane != panes_.end() && pane->instance == hit.instance; ++pane) {
    if (std::ranges::find(pane->triangles, hit.triangle, &Pane::Triangle::index) != pane->triangles.end())
      return &*pane;
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
