#pragma once
/// Where rays start that leave a surface point which somebody else computed.

#include <cmath>

#include <ssphh/scene/query.h>
#include <ssphh/shading/lights.h>

#include "rays.h"

namespace ssphh::trace {

/// Default share of the scene's size by which such points may lie below their surface.
inline constexpr float default_surface_tolerance = 5e-5f;

/// Size of a scene for tolerances: radius of its bounds and their distance from the origin.
inline float scene_size(const scene::Bounds& bounds) {
  return bounds.empty() ? 0 : bounds.radius() + max_abs_component(bounds.center());
}

/// Start of a ray on the side of `normal`: above the point by `gap`, or by the rounding error of its
/// coordinates where that is more.
inline vec3 above_surface(const vec3& position, const vec3& normal, float gap) {
  return position + std::max(gap, position_error(max_abs_component(position))) * normal;
}

/// From there to the place on a light that was sampled at `position`. Not parallel to the sample, so that a
/// light nearby is not passed; the direction is no unit vector, except to distant lights.
inline Ray shadow_ray(const vec3& start, const vec3& position, const shading::LightSample& light) {
  if (std::isinf(light.distance)) return {start, light.wi, light.distance};
  const vec3 path = position + light.distance * light.wi - start;
  const float length = glm::length(path);
  return {start, path, shadow_distance(start, length) / length};
}

}  // namespace ssphh::trace
