#pragma once
/// Flat lamps, rectangles and discs: glowing meshes without a body, which neither block nor reflect light.

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// Whether lamps of the type are flat and shine from one side.
bool is_area_lamp(LightType type);

/// [m²]; 0 of other types.
float lamp_area(const Light& light);

/// Radius of the ball around the lamp's place that holds what shines of it [m]: 0 of points and suns.
float lamp_reach(const Light& light);

/// The lamp's surface around the origin, across the z axis, its front toward −z: two triangles, or of a disc
/// a regular polygon of the same area in 32, so that all that closed forms know of meshes holds for it. No
/// triangles for other types. Edges of a disc stand 0.3 % of its radius from the circle at most.
Mesh area_lamp_mesh(const Light& light);

/// Where that surface stands in the world: origin and axes of the lamp's matrix, z first, without scale,
/// mirroring and shear. Lengths of lamps are metres, not scaled by the node.
mat4 area_lamp_pose(const mat4& world);
/// The pose of a flat lamp that shines along `direction`, of any length but 0: turned from `world` the
/// shortest way, so that its sides never spin while it is aimed.
mat4 aimed_area_lamp(const mat4& world, const vec3& direction);

/// The scene with its flat lamps as glowing meshes, black otherwise, that stand where the lamps do at `time`:
/// for those who know no such lamps. Such a mesh blocks light. Light groups stay.
Scene area_lamps_as_meshes(Scene scene, float time);

}  // namespace ssphh::scene
