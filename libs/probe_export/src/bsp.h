#pragma once
/// Tetrahedra in a tree of planes, as Godot finds the one around a point.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::probe_export {

/// A point p is over the plane where dot(normal, p) > offset. Children: an index greater than the node's own;
/// −(tetrahedron + 1); or `empty`.
struct BspNode {
  static constexpr std::int32_t empty = INT32_MIN;
  vec3 normal{0};
  float offset = 0;
  std::int32_t over = empty, under = empty;
};

/// Corners are indices of points; the tetrahedra do not overlap and have volume. The first node is the root.
/// Each plane is one of a tetrahedron's faces, chosen such that it parts the others best; a tetrahedron that
/// it cuts goes to both sides. Around the hull a leaf may hold the tetrahedron nearby.
std::vector<BspNode> make_bsp(std::span<const vec3> points,
                              std::span<const std::array<std::int32_t, 4>> tetrahedra);

}  // namespace ssphh::probe_export
