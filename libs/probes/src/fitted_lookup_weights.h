#pragma once
/// Weights at any point of a surface that stands still, from the fitted points around it.

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/fitted_points.h>

namespace ssphh::probes {

/// A linear fit in the tangent plane over the fitted points near x that face about its way and that x sees,
/// taken at x; as far from their weighted mean as no point counts less than −¼ of what it counts in the mean:
/// extrapolation toward a corner is wanted, but no overshoot. `elsewhere` serves what moves and where there
/// are no such points.
class FittedLookupWeights final : public LookupWeights {
 public:
  /// Throws Error for points that name a probe which there is not.
  FittedLookupWeights(const FittedPoints& fitted, std::size_t probe_count, SeesProbe sees,
                      std::unique_ptr<LookupWeights> elsewhere);
  ProbeWeights at(const rays::SurfacePoint& point) const override;
  std::size_t bytes() const override;

 private:
  /// The points that have weights, packed.
  struct Points {
    Points(const FittedPoints& fitted, std::size_t probe_count);

    std::vector<vec3> position;
    std::vector<glm::i16vec3> normal;  ///< times 32767
    std::vector<std::uint32_t> begin;  ///< of each point's weights, and the end
    std::vector<std::uint16_t> probe;
    std::vector<float> weight;
  };

  /// A point that serves, and how much.
  struct Share {
    std::size_t point;
    float weight;
    vec3 place;  ///< 1 and the tangential offset in spacings
  };
  static void fit_linearly(std::span<Share> shares);
  ProbeWeights join(std::span<const Share> shares) const;

  Points points_;
  geometry::NearestPoints near_;
  float spacing_;
  SeesProbe sees_;
  std::unique_ptr<LookupWeights> elsewhere_;
};

}  // namespace ssphh::probes
