#pragma once
/// Photometric profiles of lamps as users give and see them.

#include <vector>

#include "lamp.h"

namespace ssphh::viewer {

/// Gives a lamp a profile, or takes it with an empty one. A point lamp, which stands at `world` and had no
/// direction, is aimed down with its first. Throws Error for lamps that can have none.
void set_profile(LightEdit& light, const scene::LampProfile& profile, const mat4& world);

/// How far a lamp is turned about its aim, counter-clockwise seen from behind [rad], within −π..π; and the
/// same matrix with another turn.
float turn_of(const mat4& world);
mat4 with_turn(const mat4& world, float turn);
/// The lamp aimed in another direction; one with a profile keeps its turn.
mat4 aimed(const Lamp& lamp, const mat4& world, const vec3& direction);

/// The polar curve of a profile that is not empty, in the plane through the lamp's aim that stands `turn`
/// radians from its x axis: directions in the lamp's axes, as long as their share of the brightest one.
std::vector<vec3> profile_curve(const scene::LampProfile& profile, float turn);

}  // namespace ssphh::viewer
