#pragma once
/// Light that goes straight through glass.

#include <cmath>

#include <ssphh/shading/surface.h>

#include "rays.h"

namespace ssphh::trace {

/// Whether a ray goes on as if this glass was not there.
inline bool passes(const shading::GlassParams& glass, const Passage& passage) {
  if (!(passage.seed == 0 ? glass.share >= 0.5f : glass.share > 0)) return false;
  return passage.glass == PassedGlass::all ||
         (passage.glass == PassedGlass::smooth_sheets && glass.sheet && shading::is_smooth(glass));
}

/// exp(−σ d), also for distances and σ without end.
inline vec3 attenuated(const vec3& absorption, float distance) {
  vec3 left(1);
  for (int c = 0; c < 3; ++c) {
    if (absorption[c] > 0) left[c] = std::exp(-absorption[c] * distance);
  }
  return left;
}

/// The t_min with which a ray goes on beyond the surface that it hit at `distance`: by twice the rounding
/// errors of the hit and of the ray's own plane distance. `ray_origin` as ShadedGeometry::surface gives it.
inline float beyond(const Ray& ray, float distance, const shading::Surface& surface, const vec3& ray_origin) {
  const float length = glm::length(ray.direction);
  const float height = glm::distance(ray_origin, surface.position) +
                       position_error(max_abs_component(ray.origin) + distance * length);
  const float cosine = std::abs(glm::dot(surface.geometric_normal, ray.direction)) / length;
  return distance + 2 * height / (std::max(cosine, 1e-3f) * length);
}

/// What the glass on a ray leaves of its light, if nothing but glass stands in its way. `intersect(ray, hit)`
/// finds the next hit, `surface_of(hit, wo, ray_origin)` its surface. Bodies absorb between their front and
/// their back, and up to their back where the ray starts within.
template <class Intersect, class SurfaceOf>
vec3 through_glass(Ray ray, const Intersect& intersect, const SurfaceOf& surface_of) {
  const float length = glm::length(ray.direction);
  const vec3 wo = -ray.direction / length;
  vec3 left(1);
  float entered = 0;
  Hit hit;
  while (max_component(left) > 0 && intersect(ray, hit)) {
    vec3 ray_origin;
    const shading::Surface surface = surface_of(hit, wo, ray_origin);
    const shading::GlassParams& glass = surface.glass;
    if (!(glass.share > 0)) break;  // what the ray ends at
    left *= glass.share * shading::straight_transmittance(glass, glm::dot(surface.normal, wo));
    if (!glass.sheet) {
      if (glass.inside) left *= attenuated(glass.absorption, (hit.distance - entered) * length);
      entered = hit.distance;
    }
    ray.t_min = beyond(ray, hit.distance, surface, ray_origin);
  }
  return left;
}

}  // namespace ssphh::trace
