#pragma once
/// Photometric profiles of lamps as users give and see them.

#include <vector>

#include "lamp.h"

namespace ssphh::viewer {

/// Gives a lamp a profile, or takes it with an empty one. A point lamp, which stands at `world` and had no
/// direction, is aimed down with its first. Throws Error for lamps that can have none.
void set_profile(LightEdit& light, const scene::LampProfile& profile, const mat4& world);

/// The polar curve of a profile that is not empty, in the plane through the lamp's aim that stands `turn`
/// radians from its x axis: directions in the lamp's axes, as long as their share of the brightest one.
std::vector<vec3> profile_curve(const scene::LampProfile& profile, float turn);

}  // namespace ssphh::viewer
