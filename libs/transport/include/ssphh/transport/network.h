#pragma once
/// What surfels and probes see of each other: the operators of surfel transport. Lights do not enter, and a
/// moving part changes only the rays that meet it (docs/methods/transport.md).

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/transport/gbuffer.h>
#include <ssphh/transport/solve.h>
#include <ssphh/transport/surfels.h>
#include <ssphh/transport/transport_params.h>

namespace ssphh::transport {

/// What a probe ray sees: a patch, or no_patch, and the albedo of the very point.
struct SeenPatch {
  std::int32_t index;
  std::uint32_t albedo;  ///< pack_albedo

  friend bool operator==(const SeenPatch&, const SeenPatch&) = default;
};

/// What a probe ray sees by way of a pane that mirrors it.
struct MirroredPatch {
  std::uint32_t owner;  ///< probe · directions + direction
  SeenPatch patch;
  vec3 share;  ///< of the patch's light, what the pane and other glass leave of it
};

/// What a ray meets that is no probe's.
struct Sight {
  std::int32_t patch = no_patch;  ///< of the surface; no_patch where nothing is met or known
  vec3 albedo{0};
  vec3 emission{0};  ///< radiance toward the ray's origin
  int group = -1;    ///< of the emission
};

/// A probe ray between two precomputed poses: seen()[owner] with weight 1 − share, `other` with weight share.
struct MixedHit {
  std::uint32_t owner;  ///< probe · directions + direction
  SeenPatch other;
  float share;
};

struct PoseReport {
  std::size_t rays_near_parts = 0;  ///< rays that some part comes near at some time
  std::size_t hits_changed = 0;     ///< probe rays and links that see something else than before
};

class TransportNetwork {
 public:
  /// Keeps a reference to `source`. Throws Error without probes, for parameters out of range, and for a scene
  /// of which the probes see nothing.
  TransportNetwork(const rays::TransportSource& source, std::span<const vec3> positions,
                   const TransportParams& params, float time = 0, const Control& control = {});
  TransportNetwork(const rays::TransportSource&&, std::span<const vec3>, const TransportParams&, float = 0,
                   const Control& = {}) = delete;  // it would be gone
  ~TransportNetwork();
  TransportNetwork(TransportNetwork&&) noexcept;
  TransportNetwork& operator=(TransportNetwork&&) noexcept;

  /// Moves the parts. The result equals a network built at this time, to the bit.
  PoseReport set_time(float time);
  float time() const;

  /// Time interpolation, for animations that repeat: finds the operators at `count` poses, evenly spaced over
  /// the animation, so that set_time_between only blends two of them. Throws Error for fewer than 2 poses.
  void prepare_poses(int count, const Control& control = {});
  /// Like set_time, with links and probe rays blended linearly between the two nearest prepared poses;
  /// samples for direct light are posed exactly. The error falls with the number of poses
  /// (docs/methods/transport.md).
  PoseReport set_time_between(float time);
  /// By owner; empty after set_time.
  const std::vector<MixedHit>& mixed_hits() const;
  /// Bytes of the poses that prepare_poses found, or a session keeps.
  std::size_t pose_bytes() const;

  /// The parameters as resolved: surfel_size is never 0.
  const TransportParams& params() const;
  const ProbeGBuffer& gbuffer() const;
  const SurfelSet& surfels() const;
  std::size_t surfel_count() const { return surfels().count(); }
  /// Each surfel's samples part it into patches, [s · params().samples, …): what is nearest to a sample has
  /// its direct light and the albedo around it. Light that was reflected is the surfel's, the same in all.
  std::size_t patch_count() const { return albedo().size(); }
  std::size_t surfel_of(std::size_t patch) const {
    return patch / static_cast<std::size_t>(params().samples);
  }
  /// Reflectance of each patch.
  const std::vector<vec3>& albedo() const;

  /// Where the direct light of each patch is found. World space, as posed.
  const std::vector<rays::SurfacePoint>& samples() const;
  const std::vector<std::uint8_t>& sample_used() const;
  /// False for the padding of a surfel with fewer samples: never in use.
  bool sample_exists(std::size_t sample) const;

  const LinkRows& links() const;
  /// Bounds of the spectral radius of F ρ in the first and the last pose of the animation.
  const Contraction& contraction() const;

  /// [probe · directions + direction]
  const std::vector<SeenPatch>& seen() const;
  /// By owner.
  const std::vector<MirroredPatch>& seen_mirrored() const;
  /// Distance [m] to what each probe ray sees; infinite where it sees nothing.
  const std::vector<float>& seen_distance() const;
  /// Palette index of the emission that each probe ray sees; empty when no surface emits.
  const std::vector<std::uint16_t>& seen_emission() const;
  const EmissionPalette& palette() const;

  /// Part to world, per part.
  const std::vector<mat4>& poses() const;
  scene::Bounds part_world_bounds(int part) const;

  /// Patches that cosine rays from each point meet, as posed: `rays` per point, no_patch for those that
  /// escape. Ray directions depend on the point's index alone.
  std::vector<std::int32_t> gather(std::span<const rays::SurfacePoint> points, int rays,
                                   const Control& control = {}) const;

  /// What world-space rays meet, as posed.
  std::vector<Sight> look(std::span<const rays::RayQuery> rays) const;

  /// The patch that stands for a surface point of a part (in the part's frame): of the nearest surfel seen
  /// from it.
  int find(int part, const rays::SurfacePoint& point) const;

  /// Links that ended where no surfel is: their light is lost. A few are normal, where the underside of a
  /// part looks into what nothing else sees.
  std::size_t lost_links() const;

  struct Data;

 private:
  friend class GatherLight;
  friend class RelightSession;
  friend class SurfaceGather;
  friend class RecordPlaces;
  Held<Data> data_;
};

}  // namespace ssphh::transport
