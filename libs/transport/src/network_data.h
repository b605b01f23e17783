#pragma once

#include <optional>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/transport/network.h>

#include "kept_poses.h"
#include "pace.h"

namespace ssphh::transport {

/// A ray that some part comes near at some time, or whose surfel it may hide.
struct MovingRay {
  rays::RayQuery ray;             ///< world; t_max is the distance of the static hit
  vec3 normal{0};                 ///< of the static hit
  std::int32_t patch = no_patch;  ///< that it meets when no part is in the way
  std::uint32_t albedo = 0;
  std::uint32_t owner = 0;   ///< probe ray, or surfel that a link leaves
  std::uint32_t sample = 0;  ///< of a link: where it starts
  std::uint16_t emission = 0;
  float share = 1;                ///< of a link: what arrives of its light, past glass
  std::optional<vec3> from = {};  ///< of what a pane mirrors: the way to ray.origin starts here

  /// The way before `ray`.
  std::optional<rays::RayQuery> way_before() const {
    if (!from) return std::nullopt;
    return rays::RayQuery{*from, ray.origin - *from, 1};
  }
};

/// A moving part where it is now.
struct PlacedPart {
  int part;
  scene::Bounds bounds;  ///< in its frame
  mat4 to_world{1}, to_part{1};
};

/// The part of the operators that moves, at one time.
struct PreparedPose {
  float time = 0;
  std::vector<Link> links;
  std::vector<std::pair<std::size_t, std::size_t>> rows;  ///< first link and count, per surfel
  std::vector<Resolved> hits;                             ///< per moving hit
};

/// How far the parts have come on their way to a pose, and what that takes: kept between poses, so that later
/// ones allocate nothing.
struct PoseWork {
  enum class Step { parts, hits, links, sights, rows } step = Step::parts;
  std::size_t done = 0;  ///< of the step's rays
  PoseReport report;

  std::vector<mat4> poses;
  std::vector<PlacedPart> placed;
  std::vector<std::uint8_t> changed, counted, lost;
  std::vector<std::int32_t> target;  ///< of the moving links, then of the parts' links
  std::vector<rays::RayQuery> world;
  std::vector<rays::RayHit> hits;
  std::vector<Link> links;
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
};

struct TransportNetwork::Data {
  Data(const rays::TransportSource& source_in, const TransportParams& params_in)
      : source(source_in), params(params_in), surfels(source_in, params_in.surfel_size) {}

  const rays::TransportSource& source;
  TransportParams params;
  float time = 0;
  ProbeGBuffer gbuffer;
  SurfelSet surfels;
  std::size_t static_count = 0;  ///< surfels of part 0; those of moving parts follow
  std::vector<vec3> albedo;      ///< of each patch

  // Samples, `params.samples` per surfel.
  std::vector<rays::SurfacePoint> local_samples, samples;  ///< in the part's frame; as posed
  std::vector<std::uint8_t> sample_exists, sample_used;
  std::vector<std::uint32_t> hidden_samples;  ///< of part 0, that a moving part may cut off from their surfel

  // Links.
  std::vector<Link> fixed, moving;
  LinkRows rows;
  Contraction contraction;
  std::vector<MovingRay> moving_links;     ///< by owner
  std::vector<rays::RayQuery> part_links;  ///< of the parts' surfels, in their frames; params.link_rays each
  std::size_t lost_links = 0;

  // Probes.
  std::vector<SeenPatch> seen;
  std::vector<float> seen_distance;
  std::vector<std::uint16_t> seen_emission;
  std::vector<MovingRay> moving_hits;
  std::vector<MirroredPatch> seen_mirrored;
  std::vector<MovingRay> moving_mirrored;  ///< owner: index into seen_mirrored
  std::vector<MixedHit> mixed_hits;
  std::vector<PreparedPose> prepared;  ///< by time

  // Pose.
  std::vector<scene::Bounds> swept;  ///< per part, all that it ever occupies, world space
  std::vector<mat4> poses;
  std::vector<PlacedPart> placed;
  PoseWork pose_work;
  KeptPoses kept;

  void check_part(int part) const {
    require(part >= 0 && static_cast<std::size_t>(part) < poses.size(), "part",
            "there is none of that index");
  }
  std::size_t sample_count() const { return static_cast<std::size_t>(params.samples); }
  const Surfel& surfel_of(std::int32_t patch) const {
    return surfels.surfels()[static_cast<std::size_t>(patch) / sample_count()];
  }
  /// The patch of a surfel that holds a point, in the part's frame. Before samples are chosen, its first.
  std::int32_t patch_at(int surfel, const vec3& point) const;
  /// Samples of a surfel that are no padding.
  std::size_t used_samples(std::size_t surfel) const;
  rays::SurfacePoint to_world(int part, const rays::SurfacePoint& point) const;
  /// From a static surfel to one of its samples.
  rays::RayQuery sample_segment(std::size_t sample) const;
  bool parts_block(const rays::RayQuery& world_segment) const;
  bool blocked(const rays::RayQuery& world_segment) const;
  /// Whether another body touches a part's surface there, or lies over it: nothing lights the point, and rays
  /// from it would start within that body.
  bool covered(int part, const rays::SurfacePoint& world_point) const;
  /// A patch, or no_patch. Of a point of part 0: as find(0, point) with no part in the way.
  int find_static(const rays::SurfacePoint& point) const;
  int find(int part, const rays::SurfacePoint& point) const;
  /// Whether some part may come into the ray's way, also before a pane that mirrors it, or between its hit
  /// and the hit's surfel.
  bool near_parts(const MovingRay& ray) const;
  /// The first part that the ray meets before t_max; shortens t_max.
  bool meet_part(rays::RayQuery& ray, rays::RayHit& hit, int& part) const;
  /// What world-space rays meet, as posed: calls visit(ray, hit in the part's frame, patch or no_patch),
  /// from several threads. `hits` is scratch.
  template <class Visit>
  void see(std::span<const rays::RayQuery> rays, std::vector<rays::RayHit>& hits, const Visit& visit) const {
    hits.resize(rays.size());
    source.intersect(0, rays, hits);
    parallel_for(rays.size(), 64, [&](std::size_t i) {
      int patch = no_patch;
      see_one(rays[i], hits[i], patch);
      visit(i, hits[i], patch);
    });
  }
  /// The same of one ray, whose hit with part 0 is `hit`.
  void see_one(rays::RayQuery ray, rays::RayHit& hit, int& patch) const;
  Resolved resolve(const MovingRay& unobstructed) const;
  /// What the way meets that some part has come into.
  std::optional<Resolved> resolve_part(rays::RayQuery way) const;
  template <class Sees>
  int find_nearest(int part, const rays::SurfacePoint& point, const Sees& sees) const;

  // Patches, in network_patches.cpp.
  /// Samples of all surfels that have none yet.
  void choose_samples();
  /// Of each patch, over the points found on it.
  void find_patch_albedo();
  /// What probes' rays see was found before there were patches.
  void find_seen_patches();

  void build(std::span<const vec3> positions, float start_time, const Control& control);
  /// Goes on toward the pose of `time`, exact or blended between prepared ones, a piece at least; true: it is
  /// reached.
  bool go_on_to(float time, bool between, Pace& pace);
  void place_parts(float time);
  void place_samples();
  /// Finds which samples are free of other bodies.
  void pose_samples();
  bool pose_hits(Pace& pace);
  void pose_mirrored();
  bool pose_links(Pace& pace);
  bool pose_part_links(Pace& pace);
  void pose_rows();
  /// Takes over a pose that is kept: all but its rows; false: it is not.
  bool recall_pose();
  void keep_pose();
  void blend_poses();
  /// Makes the work's links the moving part of the rows.
  void set_moving();
  void set_hit(std::uint32_t owner, const Resolved& found);
};

/// Ray of a point's cosine-distributed fan: point `index` of a rank-1 sequence (Roberts 2018, R2), shifted by
/// `salt` so that neighbours differ. Starts `lift` above the surface.
rays::RayQuery fan_ray(const rays::SurfacePoint& from, float lift, std::uint32_t index, std::size_t salt);

/// The ray in another frame.
rays::RayQuery transformed(const rays::RayQuery& ray, const mat4& matrix);

/// Whether the ray meets the box before t_max.
bool meets(const rays::RayQuery& ray, const scene::Bounds& box);
bool meets_any(const rays::RayQuery& ray, const std::vector<scene::Bounds>& boxes);

/// Sweeps the parts over the animation.
std::vector<scene::Bounds> swept_bounds(const rays::TransportSource& source);

}  // namespace ssphh::transport
