#pragma once
/// Where a point's cosine rays go: some into every part of its hemisphere, more to where bright surfels may
/// be seen. Few even rays meet a patch of sun on the floor; neighbours then differ by chance, in blotches.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

#include "network_data.h"

namespace ssphh::transport {

/// Parts of a hemisphere that get the same light from an even surrounding: rings by sectors of the projected
/// disc (sample_cosine_hemisphere).
class HemisphereParts {
 public:
  /// As many as half of the rays fill, 4 at least.
  explicit HemisphereParts(std::uint32_t rays);

  std::size_t count() const { return static_cast<std::size_t>(rings_) * sectors_; }
  /// The part that a direction in the surface's frame falls into, z above 0.
  std::size_t part_of(const vec3& local) const;
  /// Direction `index` in a part, of a rank-1 sequence that `salt` shifts.
  vec3 direction(std::size_t part, std::uint32_t index, std::uint64_t salt) const;
  /// Lends half of each part's weight to the eight around it: what lies at an edge shines into both.
  void spread(std::vector<float>& weights) const;

 private:
  std::uint32_t rings_, sectors_;
};

/// What is bright, as seen from one place.
struct BrightPoint {
  rays::SurfacePoint point;
  float flux;  ///< patch_flux()
};

/// Of each patch: its share of the light that leaves all of them at first, summed over light groups, each as
/// bright as another. `direct` is [group][patch].
std::vector<float> patch_flux(const TransportNetwork::Data& d,
                              std::span<const std::vector<Irradiance4>> direct);

/// Orders points so that neighbours in the list are neighbours in space.
std::vector<std::uint32_t> spatial_order(std::span<const rays::SurfacePoint> points);

/// What shines brightest onto points that stand together: what one of them sees, and what rays of some meet.
std::vector<BrightPoint> bright_points(const TransportNetwork::Data& d, std::span<const float> flux,
                                       std::span<const rays::SurfacePoint> together);

/// How many of the rays each part gets, one at least.
std::vector<std::uint32_t> rays_of_parts(const HemisphereParts& parts, std::uint32_t rays,
                                         const rays::SurfacePoint& point,
                                         std::span<const BrightPoint> bright);

}  // namespace ssphh::transport
