#pragma once
/// How much each of many points on surfaces that stand still counts at a place near them: what fitted weights
/// and surface records are looked up by.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include <ssphh/geometry/balls.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/probes/surface_records.h>
#include <ssphh/probes/surface_spacing.h>

namespace ssphh::probes {

/// A lookup between points takes no more of them.
inline constexpr std::size_t most_surface_points = 24;
inline constexpr std::uint32_t no_surface_point = ~std::uint32_t{0};

/// Where each point counts at all.
geometry::Balls surface_reach(std::span<const rays::SurfacePoint> points, std::span<const float> spacings);
/// How high one can rise straight from a point: `most` metres, else the highest of ever lower tries, each 0.7
/// of the one before, or 0 where all above `least` are in vain.
float headroom(const rays::SurfacePoint& point, float most, float least, const SeesProbe& sees);
/// Whether two points of one surface see each other: above bulges of that surface and above bumps of a
/// twentieth of the spacing, but not above what stands on it, nor through a slit: a quarter of the spacing
/// above the surface, or `room` where less headroom is above one of them, they must see each other, too.
bool see_along_surface(const rays::SurfacePoint& a, const rays::SurfacePoint& b, float spacing, float room,
                       const SeesProbe& sees);

/// How narrow it is before a point: 0 where at most three quarters of its light come from nearer than half a
/// spacing, else one more for each halving of that distance, 4 at most. What lies behind a picture's frame
/// says little of the wall beside it; and what a kerb, low beside the distance, lights from nearer than an
/// eighth of it, little of the road.
int surface_cover(const rays::SurfacePoint& point, float spacing, const SeesProbe& sees);
struct SurfaceShare {
  std::uint32_t point;
  float weight;  ///< may be negative
};
using SurfaceShares = std::array<SurfaceShare, most_surface_points>;

/// A linear fit in the tangent plane over the points around x that face about its way and that x sees, taken
/// at x; as far from their weighted mean as no more than ¼ of the weight is negative: extrapolation
/// toward a corner is wanted, but no overshoot. Each point reaches three of its own spacings
/// (surface_spacings): where they are sparse, farther. Safe to call from several threads.
class SurfaceInterpolation {
 public:
  /// Copies the points. Throws Error without `sees`, and for a point that is not finite.
  SurfaceInterpolation(std::span<const rays::SurfacePoint> points, SeesProbe sees);

  /// The points that count at `at`, with a sum of 1, in `shares`; none for what moves, and where no point
  /// reaches. What would change the sum by less than a thousandth is left out, and the point `without`.
  std::span<const SurfaceShare> at(const rays::SurfacePoint& at, SurfaceShares& shares,
                                   std::uint32_t without = no_surface_point) const;
  /// Whether any record lights `at`; then E of its normal, not negative. `light` is of each point.
  bool irradiance(const rays::SurfacePoint& at, std::span<const RecordLight> light, vec3& out) const;
  /// The same of a place that none of them sees and that is covered, as the foot of a pot where it touches
  /// the table, which probes see as little: by those around it. false elsewhere.
  bool irradiance_beside(const rays::SurfacePoint& at, std::span<const RecordLight> light, vec3& out) const;

  float spacing(std::size_t point) const { return points_[point].spacing; }  ///< [m]
  const vec3& position(std::size_t point) const { return points_[point].position; }
  std::size_t count() const { return points_.size(); }
  std::size_t bytes() const;

 private:
  struct Point {
    vec3 position;
    float spacing;        ///< of surface_spacings [m]
    glm::i16vec3 normal;  ///< times 32767
    std::uint8_t cover;   ///< of surface_cover
    std::uint8_t room;    ///< headroom() in 255ths of the most that see_along_surface asks for
  };
  SurfaceInterpolation(std::span<const rays::SurfacePoint> points, std::span<const float> spacings,
                       SeesProbe sees);

  struct Candidates {
    std::size_t count = 0;
    float finest = std::numeric_limits<float>::infinity(), coarsest = 0;  ///< spacings
  };
  /// Those that reach a place and face its way, the weightiest first, whether it sees them or not.
  Candidates candidates(const rays::SurfacePoint& at, SurfaceShares& shares, std::uint32_t without) const;
  /// The fit over those of the first `count` shares whose points count.
  template <class Counts>
  std::span<const SurfaceShare> fitted(const rays::SurfacePoint& at, std::size_t count, SurfaceShares& shares,
                                       const Counts& counts) const;

  /// Of a covered place, those around it, whether it sees them or not; none elsewhere.
  std::span<const SurfaceShare> beside(const rays::SurfacePoint& at, SurfaceShares& shares) const;

  std::vector<Point> points_;
  geometry::Balls reach_;
  SeesProbe sees_;
};

}  // namespace ssphh::probes
