#pragma once
/// Surfels: patches of surface that exchange light. Points that rays have hit are clustered by voxel and main
/// direction of the normal, and a cluster is split where two of its members do not see each other: a patch
/// never reaches through a wall. Surfels of moving parts live in the part's frame.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

/// What clustering knows of a point: place and reflectance.
struct ClusterPoint {
  rays::SurfacePoint point;  ///< in the part's frame
  vec3 albedo{0};
};

struct Surfel {
  rays::SurfacePoint point;  ///< its representative: a member that all others see
  vec3 albedo{0};            ///< mean of the members
  int part = 0;
};

inline constexpr int no_surfel = -1;

class SurfelSet {
 public:
  /// `size` [m] is the voxels' edge. Keeps a reference to `source`. Throws Error for a size that makes more
  /// than 2^15 voxels along an axis of a part.
  SurfelSet(const rays::TransportSource& source, float size);
  SurfelSet(const rays::TransportSource&&, float) = delete;  // it would be gone

  float size() const { return size_; }
  const std::vector<Surfel>& surfels() const { return surfels_; }
  std::size_t count() const { return surfels_.size(); }

  /// Clusters points of one part, with their own part as the only obstacle: each joins the first surfel of
  /// its cell that it sees, or founds one. Returns the surfel of each point. New surfels are numbered by
  /// cell, so the result depends on nothing but the order of calls and points.
  std::vector<int> add(int part, std::span<const ClusterPoint> points);

  /// Sets every surfel's albedo to the mean of the points added so far.
  void update_albedo();

  /// At most `count` members of a surfel that lie far apart, of those first added.
  std::vector<rays::SurfacePoint> spread_members(int surfel, int count) const;
  /// At most `count` of the members kept, in the order they were added.
  std::span<const rays::SurfacePoint> members(int surfel) const {
    return members_[static_cast<std::size_t>(surfel)];
  }

  /// Surfels of the point's own cell, then of the 26 around it, nearest representative first. In the part's
  /// frame.
  std::vector<int> candidates(int part, const rays::SurfacePoint& point) const;
  /// Those of its own cell alone, in the order they were founded.
  std::span<const int> cell(int part, const rays::SurfacePoint& point) const;

  /// Segment between two surface points, lifted off the surface by `lift`.
  rays::RayQuery segment(const rays::SurfacePoint& a, const rays::SurfacePoint& b) const;
  float lift() const { return 0.08f * size_; }

 private:
  struct Voxel {
    int x, y, z;
  };
  Voxel voxel(int part, const vec3& position) const;
  static std::uint64_t key(int part, const Voxel& voxel, int bin);

  const rays::TransportSource& source_;
  float size_;
  std::vector<vec3> origin_;  ///< per part
  std::vector<Surfel> surfels_;
  std::vector<glm::dvec3> albedo_sum_;
  std::vector<double> member_count_;
  std::vector<std::vector<rays::SurfacePoint>> members_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

}  // namespace ssphh::transport
