#pragma once
/// Flat sheets of glass that stand still: what mirrors lamps and the sky.

#include <vector>

#include <ssphh/scene/query.h>
#include <ssphh/shading/mesh_view.h>

#include "shaded_geometry.h"

namespace ssphh::trace {

/// The corner of the box farthest along the direction.
inline vec3 farthest(const scene::Bounds& box, const vec3& direction) {
  return {direction.x > 0 ? box.max.x : box.min.x, direction.y > 0 ? box.max.y : box.min.y,
          direction.z > 0 ? box.max.z : box.min.z};
}

/// The triangles of one instance that lie in one plane. World space.
struct Pane {
  struct Triangle {
    std::uint32_t index;  ///< in its mesh
    vec3 corner, edge1, edge2;
  };

  int instance = -1;
  vec3 normal{0};    ///< unit
  float height = 0;  ///< of the plane along the normal
  std::vector<Triangle> triangles;
  scene::Bounds bounds;
  float area = 0;  ///< [m²]

  float above(const vec3& p) const { return glm::dot(normal, p) - height; }
  vec3 mirrored(const vec3& p) const { return p - 2 * above(p) * normal; }
  vec3 mirrored_direction(const vec3& d) const { return d - 2 * glm::dot(normal, d) * normal; }
  /// Where a ray meets it, which covers distances over 0 without end; false where it does not.
  bool meets(const vec3& origin, const vec3& direction, Hit& hit) const;
};

/// Those of part 0. Instances that have more than most_planes of them are curved, and left out.
std::vector<Pane> find_panes(const ShadedGeometry& geometry);

inline constexpr std::size_t most_planes = 16;
inline constexpr std::size_t most_pane_triangles = shading::MeshView::max_triangles;

}  // namespace ssphh::trace
