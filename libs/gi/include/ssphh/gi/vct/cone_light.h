#pragma once
/// Indirect light by tracing cones through voxels.

#include <memory>

#include <ssphh/gi/vct/cones.h>
#include <ssphh/gi/vct/pyramid.h>
#include <ssphh/scene/radiance_source.h>

namespace ssphh::gi::vct {

struct ConeParams {
  int cones = 16;     ///< of the hemisphere
  float offset = 1;   ///< start above the surface, in voxels along the normal
  float opacity = 1;  ///< multiplies what voxels cover
  float step = 0.5f;  ///< in voxels of the level that is read
};

/// Light that comes back along a cone from `origin` (grid units) on.
///
/// At distance t the cone has the radius r = t·tangent. The voxels read there have the edge s = max(r, 1),
/// between two levels by linear interpolation: a voxel and the trilinear kernel together have the variance
/// s²/12 + s²/6 along each axis, and a disk of radius r has r²/4. Depth per metre along direction d is Σ_i
/// |d_i| τ_i/s over the axes, τ_i of the sides that face the cone: a plane then stops the same share of light
/// at any angle, since the way through it grows as 1/|d_i|.
vec3 trace_cone(const Pyramid& voxels, const vec3& origin, const vec3& direction, float tangent,
                const ConeParams& params);

/// Reads the pyramid at every question; both may change between questions.
class ConeLight final : public scene::IndirectLight {
 public:
  ConeLight(const Pyramid& voxels, const ConeParams& params)
      : voxels_(voxels), params_(params), cones_(hemisphere_cones(params.cones)) {}

  vec3 irradiance(const scene::SurfacePoint& at) const override;
  /// Mean over the part of the lobe that is above the surface.
  vec3 glossy(const scene::SurfacePoint& at, const vec3& r, float roughness) const override;

  const ConeParams& params() const { return params_; }
  const std::vector<Cone>& cones() const { return cones_; }

 private:
  vec3 start(const scene::SurfacePoint& at) const;

  const Pyramid& voxels_;
  ConeParams params_;
  std::vector<Cone> cones_;
};

}  // namespace ssphh::gi::vct
