#pragma once
/// Light that a pane mirrors to a vertex of a path: found by sampling emitters from the vertex's mirror
/// image, and by scattered rays, weighted against each other.

#include <ssphh/shading/scattering.h>

#include "glass_passage.h"
#include "pane_mirrors.h"
#include "path_vertex.h"

namespace ssphh::trace {

/// By which scattered rays count more than their density says: of samples of a wide sky most miss the pane.
inline constexpr float rays_count = 4;

/// What arrives at a vertex of light sample i that a pane mirrors, and is reflected there as `reflect(wi)`
/// tells (value and density). `alone`: scattered rays are not counted.
struct PaneEvent {
  int group;
  vec3 value;
  vec3 emission;  ///< direction in which the light left its emitter
};
template <class Emitters, class Reflect>
std::optional<PaneEvent> next_event_by_pane(const PosedGeometry& scene, const Emitters& emitters, int i,
                                            const PaneMirrors& panes, const PathVertex& vertex,
                                            const vec3& start, const PathSampler::Vertex& random, bool alone,
                                            const Passage& passage, RayTask& task, const Reflect& reflect) {
  const auto [pane, chance] = panes.choose(vertex.position, vertex.normal, random.roulette);
  if (!pane) return {};
  PathVertex image = vertex;
  image.position = pane->mirrored(vertex.position), image.normal = pane->mirrored_direction(vertex.normal);
  auto toward = emitters.sample(i, image, random.light, random.point);
  // Lamps without extent light nothing by way of mirrors: scattered rays cannot find them there.
  if (!toward || toward->delta || !(toward->pdf > 0)) return {};
  const vec3 emission = -toward->wi;
  toward->wi = pane->mirrored_direction(toward->wi);
  if (!(glm::dot(toward->wi, vertex.normal) > 0)) return {};
  const shading::BsdfValue f = reflect(toward->wi);
  if (!(max_component(f.value * toward->radiance) > 0)) return {};
  vec3 mirrored(0);
  const vec3 share = mirrored_share(scene, *pane, start, vertex.position, *toward, passage, task, &mirrored);
  if (!(max_component(share) > 0)) return {};
  const float pdf = toward->pdf * chance;
  const float weight =
      alone ? 1 : shading::power_heuristic(pdf, rays_count * f.pdf * max_component(mirrored));
  return PaneEvent{toward->group, share * f.value * toward->radiance * (weight / pdf), emission};
}

/// The mirror image of the vertex whose ray met a pane and left it along `wi`, with the density by which
/// next_event_by_pane() weighs it; none where that finds nothing. `ray` becomes one of the image's.
inline std::optional<PathVertex> image_in_pane(const PaneMirrors& panes, const PathVertex& before,
                                               const shading::Surface& surface, const vec3& ray_origin,
                                               const Hit& hit, const vec3& wi, const Passage& passage,
                                               Ray& ray) {
  const bool found = before.bsdf_pdf > 0 && !before.in_pane && glm::dot(ray.direction, before.normal) > 0;
  const Pane* pane = found ? panes.at(hit) : nullptr;
  if (!pane) return {};
  const float chance = panes.chance(before.position, before.normal, *pane);
  const float mirrored = max_component(mirrored_by(surface, ray.direction, passage));
  if (!(chance > 0 && mirrored > 0)) return {};
  PathVertex image = before;
  image.position = surface.position - hit.distance * wi;
  image.normal = pane->mirrored_direction(before.normal);
  image.bsdf_pdf = rays_count * before.bsdf_pdf * mirrored / chance;
  image.in_pane = true;
  ray = {image.position, wi};
  ray.t_min = beyond(ray, hit.distance, surface, ray_origin);
  return image;
}

}  // namespace ssphh::trace
