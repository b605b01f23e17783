#pragma once
/// Wavefront OBJ as Corona's Standalone reads it.

#include <span>
#include <string>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Positions, `uv` unless it is empty (as long as the positions otherwise), normals, triangles. Each corner
/// names a normal, which Corona demands: that of the triangle where the mesh has none.
std::string encode_corona_obj(const scene::Mesh& mesh, std::span<const vec2> uv);

}  // namespace ssphh::scene_io
