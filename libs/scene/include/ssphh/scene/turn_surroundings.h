#pragma once
/// The sky and the sun in it, turned together.

#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Turns what is infinitely far away about +y by so many radians, counter-clockwise seen from above: the
/// environment, and with it the directional lights, as the sun of a sky. Throws Error for a state that has
/// another number of lights than the scene.
void turn_surroundings(LightingState& state, const Scene& scene, float radians);

}  // namespace ssphh::scene
