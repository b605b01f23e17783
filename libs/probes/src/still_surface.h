#pragma once
/// Triangles that stand still, by the cells of a grid that they pass, and points on them.

#include <algorithm>
#include <optional>
#include <vector>

#include <ssphh/geometry/box.h>
#include <ssphh/probes/surface_lists.h>
#include <ssphh/scene/query.h>

namespace ssphh::probes {

struct StillTriangle {
  vec3 a, b, c;        ///< world
  bool glass = false;  ///< light goes through it
};

/// All triangles of instances that no animation moves, posed at `time`, unlit ones left out.
std::vector<StillTriangle> still_triangles(const scene::Scene& scene, float time);

/// Calls visit(triangle) for the parts of a triangle that meet a box, halved until their edges are at most
/// `edge`. Parts may lie outside, within `edge` of the box.
template <class Visit>
void visit_parts(const StillTriangle& whole, const vec3& min, const vec3& max, float edge,
                 const Visit& visit) {
  const auto visit_part = [&](const auto& self, const StillTriangle& t) -> void {
    const vec3 low = glm::min(t.a, glm::min(t.b, t.c)), high = glm::max(t.a, glm::max(t.b, t.c));
    if (geometry::apart(low, high, min, max)) return;
    const vec3 ab = t.b - t.a, bc = t.c - t.b, ca = t.a - t.c;
    const float l0 = glm::dot(ab, ab), l1 = glm::dot(bc, bc), l2 = glm::dot(ca, ca);
    if (!(std::max(l0, std::max(l1, l2)) > edge * edge)) return visit(t);
    // Halves its longest edge
    const StillTriangle r = l0 >= l1 && l0 >= l2 ? t
                            : l1 >= l2           ? StillTriangle{t.b, t.c, t.a, t.glass}
                                                 : StillTriangle{t.c, t.a, t.b, t.glass};
    const vec3 middle = 0.5f * (r.a + r.b);
    self(self, {r.a, middle, r.c, r.glass});
    self(self, {middle, r.b, r.c, r.glass});
  };
  visit_part(visit_part, whole);
}

/// Where the way from `from` to `to` passes a triangle, 0 to 1 of the way; none where it does not.
std::optional<float> passed(const StillTriangle& t, const vec3& from, const vec3& to);

/// The middle of what of a triangle lies in a box; none where that is nothing.
std::optional<vec3> middle_within(const StillTriangle& t, const vec3& min, const vec3& max);

/// Lists of triangles for each cell, one after the other.
struct TriangleCells {
  std::vector<std::size_t> first;  ///< of each cell, and the end
  std::vector<std::uint32_t> triangles;
};
/// Cells of side `size` from `origin`; a list may name a few triangles that pass the cell by. What lies
/// outside all of them is in none.
TriangleCells triangle_cells(const std::vector<StillTriangle>& triangles, const vec3& origin, float size,
                             const ivec3& cells);

}  // namespace ssphh::probes
