#pragma once
/// Lamps aimed, and turned about their aim.

#include "lamp.h"

namespace ssphh::viewer {

/// Whether it is seen how far the lamp is turned about its aim: of a rectangle, and with a profile.
bool has_turn(const Lamp& lamp);

/// How far a lamp is turned about its aim, counter-clockwise seen from behind [rad], within −π..π; and the
/// same matrix with another turn.
float turn_of(const mat4& world);
mat4 with_turn(const mat4& world, float turn);

/// The lamp aimed in another direction, of any length but 0. One with a profile keeps its turn; a rectangle
/// goes there the shortest way, so that it never spins while it is aimed.
mat4 aimed(const Lamp& lamp, const mat4& world, const vec3& direction);

}  // namespace ssphh::viewer
