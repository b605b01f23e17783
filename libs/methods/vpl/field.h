#pragma once
/// Indirect light from virtual lights, with a shadow ray to each.

#include <ssphh/rays/radiance_source.h>

#include "light_tree.h"

namespace ssphh::methods::vpl {

class VplField final : public rays::IndirectLight {
 public:
  /// `cluster_error`: of lightcuts, a share of the light; 0: every light counts. Keeps a reference to the
  /// surfaces.
  VplField(std::vector<Vpl> lights, const rays::PosedWorld& surfaces, const VplParams& params,
           float cluster_error);

  vec3 irradiance(const rays::SurfacePoint& at) const override;
  /// By a lobe cosⁿ around r, n = 2/roughness⁴ − 2 but at most 100: sharper ones show the single lights. All
  /// lights count.
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;

  /// Share of the points' unbounded irradiance (luminance) that the bound of the parameters takes away.
  double lost_energy(std::span<const rays::SurfacePoint> points) const;
  /// Mean number of lights or clusters that count at the points.
  double mean_cut(std::span<const rays::SurfacePoint> points) const;

  const std::vector<Vpl>& lights() const { return lights_; }
  const VplParams& params() const { return params_; }
  std::size_t bytes() const { return lights_.size() * sizeof(Vpl) + tree_.size() * sizeof(LightNode); }

 private:
  template <class Transfer>
  vec3 gather(const rays::SurfacePoint& at, const Transfer& of) const;

  std::vector<Vpl> lights_;
  const rays::PosedWorld& surfaces_;
  VplParams params_;
  float cluster_error_, lift_;
  std::vector<LightNode> tree_;
};

/// Gives each light as radius `factor` times the distance to its eighth neighbour, so that neighbours
/// overlap.
void set_radii(std::vector<Vpl>& lights, float factor);

}  // namespace ssphh::methods::vpl
