#pragma once
/// A scene with its lamps moved, dimmed or coloured, for renderers that know scenes only.

#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// The scene at state.time with the state's lights in place of its own and every emitter's radiance times the
/// factor of its group. A light that moved stands on a node of its own, which no animation moves; what is as
/// before stays as it is, to the bit. SPHLs that shine are no part of scenes: they are left out. Groups whose
/// factor is 0 emit nothing and are the dark ones, so that light_groups() are those of before.
/// Throws Error as check_lighting does.
Scene with_lighting(Scene scene, const LightingState& state);

/// The scene as renderers take it: its dark groups emit nothing, and are light groups still.
Scene without_dark_light(Scene scene);

/// As with_lighting(), for files: groups whose factor is 0 are dark and keep what they emit.
Scene keeping_dark_light(Scene scene, LightingState state);

/// The scene as it is lit at `time` by one emitter alone: a sphere [m] of this radiance [W sr⁻¹ m⁻²] in every
/// direction, as VIZ has it. Throws Error for a radius that is not over 0.
Scene lit_by_sphere(const Scene& scene, float time, const vec3& center, float radius, float radiance);

}  // namespace ssphh::scene
