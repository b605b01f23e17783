#pragma once
/// How far surfaces are from what stands before them.

#include <ssphh/geometry/triangle_tree.h>
#include <ssphh/scene/scene.h>

namespace ssphh::lightmap {

class Clearance {
 public:
  /// Of all surfaces, posed at `time`.
  Clearance(const scene::Scene& scene, float time);

  /// Distance [m] from x, on a plane whose front looks along the unit vector `front`, to the nearest triangle
  /// that rises over the plane; infinity: there is none.
  float at(const vec3& x, const vec3& front) const;

 private:
  geometry::TriangleTree tree_;
};

}  // namespace ssphh::lightmap
