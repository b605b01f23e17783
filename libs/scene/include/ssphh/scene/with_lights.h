#pragma once
/// A scene with its lamps moved, dimmed or coloured, for renderers that know scenes only.

#include <span>

#include <ssphh/scene/scene.h>
#include <ssphh/scene/transport_source.h>

namespace ssphh::scene {

/// The scene at `time` with `lights` in place of its own (one each, in its order) and every emitter's
/// radiance times the factor of its group (one each, as light_groups() lists them; none: all 1). A light that
/// moved stands on a node of its own, which no animation moves; what is as before stays as it is, to the bit.
/// The environment is turned about +y by so many radians beyond its own rotation.
/// Throws Error for wrong counts.
Scene with_lights(Scene scene, float time, std::span<const LightState> lights,
                  std::span<const vec3> group_scales = {}, float environment_rotation = 0);

}  // namespace ssphh::scene
