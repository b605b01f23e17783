#pragma once
/// What is under the mouse.

#include <optional>
#include <span>

#include "live_light.h"

namespace ssphh::viewer {

/// The nearest sphere (center, radius [m]) on the ray in front of `limit` metres; −1: none.
int pick_sphere(const rays::RayQuery& ray, std::span<const vec4> spheres, float limit);

/// Nearest surface of the posed scene on a world-space ray with a unit direction: point and normal toward the
/// ray's origin.
std::optional<rays::SurfacePoint> pick_surface(const rays::TransportSource& source, float time,
                                               const rays::RayQuery& ray);

/// Distance along `axis` (unit, through `origin`) of the point that is nearest to the ray: dragging along an
/// axis. None where the two are parallel.
std::optional<float> along_axis(const rays::RayQuery& ray, const vec3& origin, const vec3& axis);

/// Where the ray meets a ball first, or the point of its surface that is nearest to the ray.
vec3 on_ball(const rays::RayQuery& ray, const vec3& center, float radius);

/// Where the ray meets the plane through `point` with unit normal `normal`; none behind the origin.
std::optional<vec3> on_plane(const rays::RayQuery& ray, const vec3& point, const vec3& normal);

}  // namespace ssphh::viewer
