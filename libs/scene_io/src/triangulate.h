#pragma once
/// Polygons to triangles.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::scene_io {

/// Triangles, as indices into `polygon`, of a simple, nearly flat polygon with at least 3 corners: a fan
/// where it is convex, ear clipping where it is not. `work` is a budget of elementary tests shared between
/// calls; when it is used up, or the polygon crosses itself, the rest is a fan. Always gives corners − 2
/// triangles.
void triangulate(std::span<const vec3> polygon, std::uint64_t& work, std::vector<uvec3>& out);

}  // namespace ssphh::scene_io
