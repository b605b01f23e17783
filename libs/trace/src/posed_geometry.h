#pragma once
/// A scene whose parts have taken their places: rays in the world.

#include "box_tree.h"
#include "shaded_geometry.h"

namespace ssphh::trace {

/// Keeps a reference to the geometry. A part that its pose scales to nothing, also along one axis only, is
/// not there.
class PosedGeometry {
 public:
  /// `poses`: part to world, one per part; the first is the identity.
  PosedGeometry(const ShadedGeometry& geometry, std::span<const mat4> poses);
  /// Poses the parts anew, without allocation.
  void pose(std::span<const mat4> poses);

  /// As ShadedGeometry's, over all parts.
  bool intersect(const Ray& ray, const Passage& passage, RayTask& task, Hit& hit) const;
  bool occluded(const Ray& ray, const Passage& passage, RayTask& task) const;
  /// Share of light that arrives along the ray: 0 where something holds it back, 1 where nothing stands in
  /// its way, else what the glass that it may pass leaves of it.
  vec3 transmittance(const Ray& ray, const Passage& passage, RayTask& task) const;
  shading::Surface surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const;
  bool is_back(const Hit& hit, const vec3& direction) const;

  /// Around all that is there.
  const scene::Bounds& bounds() const { return bounds_; }
  bool emissive(int instance) const { return geometry_.emissive(instance); }
  bool glass(int instance) const { return geometry_.glass(instance); }
  bool filters() const { return geometry_.filters(); }

 private:
  struct MovingPart {
    int index;
    mat4 pose, from_world;
    mat3 normal_matrix;
    scene::Bounds bounds;  ///< in its frame, grown by rounding errors

    Ray in_frame(const Ray& ray) const {
      return {vec3(from_world * vec4(ray.origin, 1)), mat3(from_world) * ray.direction, ray.t_max, ray.t_min};
    }
    bool may_meet(const Ray& ray) const;
  };
  bool occluded(const Ray& ray, const Passage& passage, RayTask& task, bool& met_glass) const;
  /// Null for what never moves.
  const MovingPart* moving_part_of(const Hit& hit) const;

  const ShadedGeometry& geometry_;
  std::vector<MovingPart> moving_;
  std::vector<scene::Bounds> boxes_;  ///< of moving_, in the world
  BoxTree tree_;                      ///< over their boxes in the world
  scene::Bounds bounds_;
};

}  // namespace ssphh::trace
