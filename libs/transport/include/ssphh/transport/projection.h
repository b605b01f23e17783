#pragma once
/// Spherical harmonics of many probes at once: S_i[k] = Σ_q w Y_k(ω_q) L_iq for radiances L along fixed
/// directions, as one matrix product.

#include <span>
#include <vector>

#include <ssphh/rays/transport_source.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::transport {

class DirectionProjector {
 public:
  /// Every direction has the weight 4π / count.
  DirectionProjector(int degree, std::span<const vec3> directions);

  int degree() const { return degree_; }
  /// Directions rounded up to whole SIMD blocks: the length of one channel in project()'s input.
  std::size_t stride() const { return stride_; }

  /// `radiance` holds the three channels one after the other, each stride() long with zeros at the end.
  void project(std::span<const float> radiance, sh::RadianceSh& out) const;

 private:
  int degree_;
  std::size_t stride_;
  std::vector<float> basis_;  ///< [k][direction], weighted
};

/// Samples of an emitter from a place in the open: what is left of their noise is under a hundredth.
inline constexpr int arriving_samples = 4096;
/// S[k] = Σ Y_k(ω) E of the light of DirectLight::arriving().
sh::RadianceSh project_arriving(std::span<const rays::ArrivingLight> light, int degree);

}  // namespace ssphh::transport
