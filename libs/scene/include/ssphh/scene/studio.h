#pragma once
/// Light for scenes that come without any.

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Radiance of the studio from a unit direction, the same in every channel [W sr⁻¹ m⁻²]: a grey room,
/// brighter above than below, with a large soft light from the upper right and a weaker one from the left.
float studio_radiance(const vec3& direction);

/// Sets the environment to the studio (group "studio"), replacing any other.
void add_studio(Scene& scene);

}  // namespace ssphh::scene
