#pragma once
/// How much each of many points on surfaces that stand still counts at a place near them: what fitted weights
/// and surface records are looked up by.

#include <array>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/probes/surface_records.h>

namespace ssphh::probes {

/// So many of the nearest points a lookup between them takes. Twice as many give the same errors.
inline constexpr std::size_t most_surface_points = 12;

/// Median distance of points from the nearest one that lights the same surface [m]; infinite where there is
/// none: what lookups between them measure distances in.
float surface_spacing(std::span<const rays::SurfacePoint> points);

/// Whether two points of one surface see each other: above bulges of that surface, but not above what stands
/// on it.
bool see_along_surface(const rays::SurfacePoint& a, const rays::SurfacePoint& b, float spacing,
                       const SeesProbe& sees);

/// How narrow it is before a point: 0 where at most three quarters of its light come from nearer than half a
/// spacing, else one more for each halving of that distance, 4 at most. What lies behind a picture's frame
/// says little of the wall beside it.
int surface_cover(const rays::SurfacePoint& point, float spacing, const SeesProbe& sees);
/// What such a point keeps of its weight at this distance.
float cover_factor(int cover, float distance2, float spacing);

struct SurfaceShare {
  std::uint32_t point;
  float weight;  ///< may be negative
};
using SurfaceShares = std::array<SurfaceShare, most_surface_points>;

/// A linear fit in the tangent plane over the points near x that face about its way and that x sees, taken at
/// x; as far from their weighted mean as no point counts less than −¼ of what it counts in the mean:
/// extrapolation toward a corner is wanted, but no overshoot. Safe to call from several threads.
class SurfaceInterpolation {
 public:
  /// Copies the points. Throws Error without `sees`.
  SurfaceInterpolation(std::span<const rays::SurfacePoint> points, SeesProbe sees);

  /// The points that count at `at`, with a sum of 1, in `shares`; none for what moves, and where no point is
  /// near.
  std::span<const SurfaceShare> at(const rays::SurfacePoint& at, SurfaceShares& shares) const;
  /// Whether any record lights `at`; then E of its normal, not negative. `light` is of each point.
  bool irradiance(const rays::SurfacePoint& at, std::span<const RecordLight> light, vec3& out) const;

  std::size_t count() const { return position_.size(); }
  std::size_t bytes() const;

 private:
  std::vector<vec3> position_;
  std::vector<glm::i16vec3> normal_;  ///< times 32767
  std::vector<std::uint8_t> cover_;
  geometry::NearestPoints near_;
  float spacing_;
  SeesProbe sees_;
};

}  // namespace ssphh::probes
