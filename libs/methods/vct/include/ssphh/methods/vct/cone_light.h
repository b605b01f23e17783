#pragma once
/// Indirect light by tracing cones through voxels.

#include <ssphh/methods/vct/cones.h>
#include <ssphh/methods/vct/pyramid.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::methods::vct {

struct ConeParams {
  int cones = 16;     ///< of the hemisphere
  float offset = 1;   ///< start above the surface, in voxels along the normal
  float opacity = 1;  ///< multiplies what voxels cover
  float step = 0.5f;  ///< in voxels of the level that is read
};

/// What a cone from `origin` (grid units) on sees: w is the share of it that surfaces cover, xyz their
/// radiance times that share.
///
/// At distance t the cone has the radius r = t·tangent. The voxels read there have the edge s = max(r, 1),
/// between two levels by linear interpolation: a voxel and the trilinear kernel together have the variance
/// s²/12 + s²/6 along each axis, and a disk of radius r has r²/4. A step of length l along direction d meets
/// Σ_i |d_i| a_i l/s, a_i being the opacity of the side that faces the cone along axis i; over the whole way
/// through a plane this sums to 1 at any angle. As long as a surface is being crossed, s stays as it is, for
/// the same plane lies elsewhere in another level and would be met less or more than once.
vec4 trace_cone(const Pyramid& voxels, const vec3& origin, const vec3& direction, float tangent,
                const ConeParams& params);

/// Reads the pyramid at every question; both may change between questions.
class ConeLight final : public rays::IndirectLight {
 public:
  ConeLight(const Pyramid& voxels, const ConeParams& params)
      : voxels_(voxels), params_(params), cones_(hemisphere_cones(params.cones)) {}

  vec3 irradiance(const rays::SurfacePoint& at) const override;
  /// Mean over the part of the lobe that is above the surface.
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;

  const ConeParams& params() const { return params_; }
  const std::vector<Cone>& cones() const { return cones_; }

 private:
  vec3 start(const rays::SurfacePoint& at) const;

  const Pyramid& voxels_;
  ConeParams params_;
  std::vector<Cone> cones_;
};

}  // namespace ssphh::methods::vct
