#pragma once
/// Binary PLY (Turk, The PLY Polygon File Format, 1994), as Mitsuba and pbrt read it.

#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// binary_little_endian; vertex x y z, nx ny nz if the mesh has normals, u v from `uv` and r g b from
/// `colors` unless they are empty (as long as the positions otherwise); faces as "list uchar int
/// vertex_indices".
std::vector<std::byte> encode_ply(const scene::Mesh& mesh, std::span<const vec2> uv,
                                  std::span<const vec3> colors = {});

}  // namespace ssphh::scene_io
