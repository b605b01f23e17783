#pragma once
/// Lookup weights fitted to light transport, for points that do not move (after Silvennoinen & Lehtinen,
/// Real-Time Global Illumination by Precomputed Local Reconstruction from Sparse Radiance Probes, SIGGRAPH
/// Asia 2017): per point the non-negative weights of its nearest visible probes that reproduce the irradiance
/// of training lights best. WeightMethod::fitted looks them up (lookup_weights.h).

#include <memory>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/fitted_points.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

struct FitParams {
  int probes = 12;           ///< nearest visible probes per point and pose, 1..16
  int training_lights = 24;  ///< isotropic lights at probes that lie far apart
  float own_weight = 3;      ///< of a light of the scene relative to a training light, over 0
  int gather_rays = 256;     ///< cosine rays by which a point's true irradiance is found
  float ridge = 1e-3f;       ///< pull toward equal weights, relative to the fit's own scale
  int degree = 2;            ///< bands of the probes' irradiance
};

/// Direct irradiance of every patch of a network from one light: what weights are fitted to.
using SurfelLight = std::vector<Irradiance4>;

/// A fit to one or several poses of the doors at once.
class WeightFit {
 public:
  /// The points stand still. Throws Error for parameters out of range.
  WeightFit(std::vector<rays::SurfacePoint> points, const FitParams& params = {});
  ~WeightFit();
  WeightFit(WeightFit&&) noexcept;

  /// Takes the network's pose in: the light of the training lights and of `lights` (the scene's own, each a
  /// group) at points and probes, and the probes that the points see. `source` is the network's. All poses
  /// need the same probes.
  void add_pose(const TransportNetwork& network, const rays::TransportSource& source,
                std::span<const SurfelLight> lights = {}, const Control& control = {});
  /// The weights that serve all poses taken in together.
  probes::FittedPoints solve(const Control& control = {}) const;

 private:
  struct Data;
  Held<Data> data_;
};

/// A fit in the network's pose alone.
probes::FittedPoints fit_weights(const TransportNetwork& network, const rays::TransportSource& source,
                                 std::span<const rays::SurfacePoint> points, const FitParams& params = {},
                                 std::span<const SurfelLight> lights = {}, const Control& control = {});

/// Weights v ≥ 0 that minimise |A v − b|² + ridge · trace(AᵀA)/n · |v − prior|², rows of A of length n: the
/// active-set method of Lawson & Hanson (Solving Least Squares Problems, 1974, ch. 23) on the normal
/// equations. Columns of zeros get their prior.
std::vector<double> fit_non_negative(std::span<const double> rows, std::span<const double> targets,
                                     std::span<const double> prior, double ridge);

/// Places for fitted points that cover all static surfels: at most `per_surfel` of each one's samples.
std::vector<rays::SurfacePoint> surfel_points(const TransportNetwork& network, int per_surfel = 1);

/// At most `count` of the points, spread evenly over place and the six directions that normals face, in their
/// order; all, if there are no more. Where `levels` are given, those of level k stand 2ᵏ times as far apart
/// as those of level 0. Throws Error for a count under 1, and where not every point has its level.
std::vector<rays::SurfacePoint> spread_points(std::span<const rays::SurfacePoint> points, int count,
                                              std::span<const int> levels = {});

}  // namespace ssphh::transport
