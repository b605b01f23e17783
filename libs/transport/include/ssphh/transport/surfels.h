#pragma once
/// Surfels: patches of surface that exchange light. Points that rays have hit are clustered by voxel and main
/// direction of the normal, and a cluster is split where two of its members do not see each other: a patch
/// never reaches through a wall. Surfels of moving parts live in the part's frame.

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <ssphh/transport/surfel_sizes.h>

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
  int level = 0;     ///< of its voxel: doublings of the finest size
  float height = 0;  ///< where sight toward it ends, above the representative [m]
};

/// Where rays leave a surface: this share of the usual voxels' edge above it.
inline constexpr float link_lift = 2e-3f;

inline constexpr int no_surfel = -1;
/// What rays meet where they meet no patch of a surfel (network.h).
inline constexpr int no_patch = -1;

class SurfelSet {
 public:
  /// `sizes` are the voxels' edges; a moving part has one, `part_levels[part]` (the finest where the list
  /// ends). Keeps a reference to `source`. Throws Error for a usual size that makes more than 2^15 voxels
  /// along an axis of a part.
  SurfelSet(const rays::TransportSource& source, SurfelSizes sizes, std::vector<int> part_levels = {});
  SurfelSet(const rays::TransportSource& source, float size) : SurfelSet(source, SurfelSizes(size)) {}
  SurfelSet(const rays::TransportSource&&, SurfelSizes, std::vector<int> = {}) = delete;  // it would be gone
  SurfelSet(const rays::TransportSource&&, float) = delete;

  /// The edge of voxels that are neither near lamps nor far from probes [m].
  float size() const { return sizes_.usual(); }
  /// The edge of the largest voxels that hold a surfel [m].
  float coarsest() const;
  const SurfelSizes& sizes() const { return sizes_; }
  /// The level of a part's point: doublings of the finest voxels' edge.
  int level(int part, const vec3& position) const;
  float size(int level) const { return sizes_.size(level); }
  const std::vector<Surfel>& surfels() const { return surfels_; }
  std::size_t count() const { return surfels_.size(); }

  /// Clusters points of one part, with their own part as the only obstacle: each joins the first surfel of
  /// its cell that it sees, or founds one. Returns the surfel of each point. New surfels are numbered by
  /// cell, so the result depends on nothing but the order of calls and points.
  std::vector<int> add(int part, std::span<const ClusterPoint> points);

  /// Sets every surfel's albedo to the mean of the points added so far.
  void update_albedo();

  /// Whether the members kept lie in one plane: such a surfel is a piece of one sheet.
  bool is_flat(int surfel) const;
  /// At most `count` places of a surfel, spread evenly over the area that its voxel cuts out of its
  /// representative's plane; none where something hides them from closer than a tenth of the voxel's edge.
  std::vector<ClusterPoint> spread_places(int surfel, int count) const;
  /// At most `count` members of a surfel, of those first added, in different places: each stands for as many
  /// of them, which lie together. So a recess counts as much as rays find of it.
  std::vector<ClusterPoint> spread_members(int surfel, int count) const;
  /// At most `count` points that stand for a surfel: places of a flat one, unless nearly all of
  /// it is hidden; else members.
  std::vector<ClusterPoint> spread_samples(int surfel, int count) const;
  /// At most `count` of the members kept, in the order they were added.
  std::span<const ClusterPoint> members(int surfel) const { return members_[surfel]; }

  /// Surfels of the point's own cell, then of those around it (of the next finer and coarser voxels, too),
  /// nearest representative first: the first of them that fit into `out`. In the part's frame.
  std::span<const int> candidates(int part, const rays::SurfacePoint& point, std::span<int> out) const;
  /// Surfels of the point's own cell alone, in the order they were founded.
  std::span<const int> cell(int part, const rays::SurfacePoint& point) const;

  float lift(int level = 0) const { return 0.08f * size(level); }
  /// Where sight from a point begins, above it [m]: the lift of its part's voxels there, or half of what is
  /// free of the part's own surfaces: in a fold no sight begins beyond the other side.
  float height(int part, const rays::SurfacePoint& point) const;
  /// Segment between two surface points, from so far above the one to so far above the other [m].
  static rays::RayQuery segment(const rays::SurfacePoint& a, float height_a, const rays::SurfacePoint& b,
                                float height_b);

 private:
  struct Voxel {
    int level, x, y, z;
  };
  struct Key {
    std::uint32_t part_and_level;
    std::uint64_t place_and_bin;
    auto operator<=>(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  Voxel voxel(int part, int level, const vec3& position) const;
  static Key key(int part, const Voxel& voxel, int bin);
  Key key(int part, const rays::SurfacePoint& point) const;
  static int level_of(const Key& key) { return static_cast<int>(key.part_and_level & 0xff); }
  const std::vector<int>* find_cell(const Key& key) const;
  /// Which surfel of a cell that is there a point so far above its surface joins: the first that sees it.
  int owner(const rays::SurfacePoint& point, float above, const Key& cell) const;

  const rays::TransportSource* source_;
  SurfelSizes sizes_;
  std::vector<int> part_levels_;
  std::array<bool, SurfelSizes::most_level + 1> has_level_{};  ///< where any surfel is
  std::vector<vec3> origin_;                                   ///< per part
  std::vector<Surfel> surfels_;
  std::vector<glm::dvec3> albedo_sum_;
  std::vector<double> member_count_;
  std::vector<std::vector<ClusterPoint>> members_;
  std::unordered_map<Key, std::vector<int>, KeyHash> cells_;
};

}  // namespace ssphh::transport
