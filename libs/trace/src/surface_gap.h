#pragma once
/// Where rays start that leave a surface point which somebody else computed.

#include <ssphh/scene/query.h>

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

}  // namespace ssphh::trace
