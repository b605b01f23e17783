#pragma once
/// Lookup weights fitted to light transport, for points that do not move (after Silvennoinen & Lehtinen,
/// Real-Time Global Illumination by Precomputed Local Reconstruction from Sparse Radiance Probes, SIGGRAPH
/// Asia 2017): per point the non-negative weights of its nearest visible probes that reproduce the irradiance
/// of training lights best. No visibility ray is needed when they are used.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/probe_set.h>
#include <ssphh/gi/transport/network.h>

namespace ssphh::gi {

struct FitParams {
  int probes = 12;           ///< nearest visible probes per point, 1..16
  int training_lights = 24;  ///< isotropic lights at probes that lie far apart
  int gather_rays = 256;     ///< cosine rays by which a point's true irradiance is found
  float ridge = 1e-3f;       ///< pull toward equal weights, relative to the fit's own scale
  int degree = 2;            ///< bands of the probes' irradiance
};

/// Fits in the pose of the network; `source` is the network's. Throws Error for parameters out of range.
FittedPoints fit_weights(const TransportNetwork& network, const scene::TransportSource& source,
                         std::span<const scene::SurfacePoint> points, const FitParams& params = {},
                         const Control& control = {});

/// Weights v ≥ 0 that minimise |A v − b|² + ridge · trace(AᵀA)/n · |v − prior|², rows of A of length n: the
/// active-set method of Lawson & Hanson (Solving Least Squares Problems, 1974, ch. 23) on the normal
/// equations. Columns of zeros get their prior.
std::vector<double> fit_non_negative(std::span<const double> rows, std::span<const double> targets,
                                     std::span<const double> prior, double ridge);

/// Places for fitted points that cover all static surfels: at most `per_surfel` of each one's samples.
std::vector<scene::SurfacePoint> surfel_points(const TransportNetwork& network, int per_surfel = 1);

/// Indirect light from fitted points: each near one that x sees and that faces about its way gives the
/// irradiance of its weights toward the normal asked for; a linear fit over them, kept within their range, is
/// taken at x. Where there are none, and for glossy lobes, an IrradianceLookup by `params`. Copies what it
/// needs; `source` must outlive it. Throws Error as IrradianceLookup does, and for weights that name a probe
/// which the set lacks.
class FittedLookup final : public scene::IndirectLight {
 public:
  FittedLookup(const ProbeSet& set, const FittedPoints& fitted, const scene::RadianceSource& source,
               const LookupParams& params = {});
  ~FittedLookup() override;
  vec3 irradiance(const vec3& x, const vec3& n) const override;
  vec3 glossy(const vec3& x, const vec3& n, const vec3& r, float roughness) const override;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::gi
