#pragma once
/// What several methods ask of a scene.

#include <vector>

#include <ssphh/methods/method.h>

namespace ssphh::methods {

/// Points uniform by area over what the scene's cameras, SPHLs and lamps can reach (reachable_points); a
/// scene without any of these is looked at from the middle of its bounds.
std::vector<rays::SurfacePoint> points_in_reach(const MethodScene& scene, float time, int count,
                                                const Control& control);

/// Irradiance [W/m²] at each point straight from all light groups, each times its scale.
std::vector<vec3> scaled_direct(const rays::DirectLight& lights, std::span<const vec3> group_scales,
                                std::span<const rays::SurfacePoint> points);

}  // namespace ssphh::methods
