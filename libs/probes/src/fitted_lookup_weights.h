#pragma once
/// Weights at any point of a surface that stands still, from the fitted points around it.

#include <cstdint>
#include <memory>
#include <vector>

#include <ssphh/probes/fitted_points.h>
#include <ssphh/probes/surface_interpolation.h>

namespace ssphh::probes {

/// The weights of fitted points, interpolated. `elsewhere` serves what moves and where there are no such
/// points.
class FittedLookupWeights final : public LookupWeights {
 public:
  /// Throws Error for points that name a probe which there is not.
  FittedLookupWeights(const FittedPoints& fitted, std::size_t probe_count, SeesProbe sees,
                      std::unique_ptr<LookupWeights> elsewhere);
  ProbeWeights at(const rays::SurfacePoint& point) const override;
  std::size_t bytes() const override;

 private:
  /// Weights of the points that have any, packed.
  struct Weights {
    Weights(const FittedPoints& fitted, std::size_t probe_count);

    std::vector<std::uint32_t> begin;  ///< of each point's weights, and the end
    std::vector<std::uint16_t> probe;
    std::vector<float> weight;
  };
  ProbeWeights join(std::span<const SurfaceShare> shares) const;

  Weights weights_;
  SurfaceInterpolation points_;
  std::unique_ptr<LookupWeights> elsewhere_;
};

}  // namespace ssphh::probes
