#pragma once
/// Weights at any point of a surface that stands still, from the fitted points around it.

#include <memory>

#include <ssphh/gi/fitted_points.h>
#include <ssphh/gi/nearest.h>

namespace ssphh::gi {

/// A linear fit in the tangent plane over the fitted points near x that face about its way and that x sees,
/// taken at x; as far from their weighted mean as no point counts less than −¼ of what it counts in the mean:
/// extrapolation toward a corner is wanted, but no overshoot. `elsewhere` serves what moves and where there
/// are no such points.
class FittedLookupWeights final : public LookupWeights {
 public:
  /// Throws Error for points that name a probe which there is not.
  FittedLookupWeights(const FittedPoints& fitted, std::size_t probe_count, SeesProbe sees,
                      std::unique_ptr<LookupWeights> elsewhere);
  ProbeWeights at(const scene::SurfacePoint& point) const override;

 private:
  FittedPoints points_;  ///< those that have weights
  NearestPoints near_;
  float spacing_;
  SeesProbe sees_;
  std::unique_ptr<LookupWeights> elsewhere_;
};

}  // namespace ssphh::gi
