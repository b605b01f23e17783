#pragma once
/// Rays against the parts of a scene, and what they hit.

#include <ssphh/shading/surface.h>

#include "geometry_data.h"
#include "rays.h"

namespace ssphh::trace {

/// A shared geometry with the materials of a scene. Rays and answers are in the frame of one part.
class ShadedGeometry {
 public:
  /// Keeps a reference to the scene. Throws Error where the geometry was built for one with other surfaces.
  ShadedGeometry(SharedGeometry geometry, const scene::Scene& scene);

  /// Nearest hit. Surfaces with alpha let a ray pass with probability 1 − alpha, decided by a hash of the
  /// seed and the triangle. `met_glass` becomes true where it may have gone through glass on the way.
  bool intersect(int part, const Ray& ray, const Passage& passage, Hit& hit, bool* met_glass = nullptr) const;
  /// Whether anything holds the ray back; else `met_glass` becomes true where it went through glass.
  bool occluded(int part, const Ray& ray, const Passage& passage, bool& met_glass) const;
  /// What the glass of the part leaves of light along a ray that nothing in it holds back.
  vec3 through_glass(int part, const Ray& ray, const Passage& passage, RayTask& task) const;

  /// Shading inputs. `ray_origin` is where new rays start: on the side of `wo`, above the surface by more
  /// than the rounding error of `position`.
  shading::Surface surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const;
  /// The same in the world for a part at `pose`, whose inverse transpose is `normal_matrix`.
  shading::Surface posed_surface(const Hit& hit, const mat4& pose, const mat3& normal_matrix, const vec3& wo,
                                 vec3& ray_origin) const;

  /// Coverage at a hit, 0..1.
  float alpha(const Hit& hit) const;
  /// Glass at a hit, as seen from outside.
  shading::GlassParams glass_at(const Hit& hit) const;
  /// Whether a ray along `direction` hit the back of a one-sided surface.
  bool is_back(const Hit& hit, const vec3& direction) const;

  int part_of(int instance) const { return data_->layout.instance_part[instance]; }
  bool emissive(int instance) const { return shading_[instance].emissive; }
  bool glass(int instance) const { return shading_[instance].glass; }
  /// Whether any surface may let rays pass.
  bool filters() const { return data_->filters; }
  const SceneParts& layout() const { return data_->layout; }
  const scene::Scene& scene() const { return scene_; }
  const SharedGeometry& shared() const { return geometry_; }

 private:
  struct InstanceShading {
    int material = -1;
    bool emissive = false, double_sided = false, glass = false;
  };
  const InstanceGeometry& geometry_of(const Hit& hit) const { return data_->instances[hit.instance]; }
  const InstanceShading& shading_of(const Hit& hit) const { return shading_[hit.instance]; }

  SharedGeometry geometry_;
  const SceneGeometry::Data* data_;
  const scene::Scene& scene_;
  std::vector<InstanceShading> shading_;
};

}  // namespace ssphh::trace
