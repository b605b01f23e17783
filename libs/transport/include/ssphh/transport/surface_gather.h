#pragma once
/// What points of still surfaces see of the surfels: a sparse row for each, by which surface records follow
/// lamps and doors (docs/methods/transport.md#records).

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <ssphh/probes/surface_records.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/transport_params.h>

namespace ssphh::transport {

class HemisphereParts;
struct BrightPoint;

class SurfaceGather {
 public:
  /// Traces the rays: some into every part of a point's hemisphere, more to where surfels may be seen that
  /// `direct`, [light group][patch], makes bright; none: evenly. It decides on noise alone: any light can be
  /// asked for later. The points stand still in every pose; the network must outlive the gather. Throws Error
  /// for more than 65536 points, for a number of rays out of range, and Cancelled. Takes up to 16 bytes a
  /// ray, 96 where moving parts come near it.
  SurfaceGather(const TransportNetwork& network, std::vector<rays::SurfacePoint> points, int rays,
                std::span<const std::vector<Irradiance4>> direct = {}, const Control& control = {});
  SurfaceGather(const TransportNetwork&&, std::vector<rays::SurfacePoint>, int,
                std::span<const std::vector<Irradiance4>> = {}, const Control& = {}) = delete;

  /// Looks again along the rays that moving parts come near, in the network's pose. The result equals a
  /// gather made in this pose: to the bit without `direct`, else within noise, for doors decide what is seen
  /// of what is bright.
  void update_pose();
  /// Looks again along the rays [begin, end) of moving_rays() alone.
  void update_pose(std::size_t begin, std::size_t end);
  std::size_t moving_rays() const { return moving_.size(); }

  /// Takes over the points of another gather of the same network, after its own.
  void append(SurfaceGather&& other);

  const std::vector<rays::SurfacePoint>& points() const { return points_; }
  /// How far surfaces are from each point: the harmonic mean over its cosine rays [m], infinite where all
  /// escape (Ward 1988: the light of a point holds for a share of it).
  const std::vector<float>& openness() const { return openness_; }
  /// Light of each point, when each patch gets `irradiance`, direct and reflected.
  void light(std::span<const Irradiance4> irradiance, std::vector<probes::RecordLight>& out) const;
  /// Light of the points [begin, end) alone, by the radiosity of each patch, albedo times irradiance; `out`
  /// has room for each of the points.
  void light(std::span<const vec4> radiosity, std::size_t begin, std::size_t end,
             std::span<probes::RecordLight> out) const;
  std::size_t bytes() const;

 private:
  friend class RelightSession;
  /// The patch that each moving ray meets in the last pose, no_patch where it escapes.
  void get_patches(std::span<std::int32_t> out) const;
  /// As update_pose(), of a pose in which they were got.
  void set_patches(std::span<const std::int32_t> patches);

  /// Rays of one point that meet one patch: their share, and the sum of their slopes against the normal
  /// along both tangents.
  struct Link {
    std::uint32_t patch;
    float weight;
    vec2 slope;
  };
  /// A ray that some part comes near at some time.
  struct Moving {
    rays::RayQuery ray;  ///< t_max: distance of what stands still
    vec3 normal;         ///< of that
    std::int32_t patch;
    std::optional<vec3> from;  ///< of what a pane mirrors: the way to ray.origin starts here
    Link link;                 ///< as posed; of no weight where the ray escapes
    float weight;              ///< where it does not

    void set_patch(std::int32_t met) {
      link.weight = met == no_patch ? 0 : weight;
      link.patch = met == no_patch ? 0 : static_cast<std::uint32_t>(met);
    }
  };
  struct Row {
    std::vector<Link> links;
    std::vector<Moving> moving;
    float openness;
  };
  using Rows = std::vector<Row>;
  void trace(std::uint32_t rays, std::span<const std::vector<Irradiance4>> direct, Rows& rows,
             const Control& control);
  Row trace_point(std::uint32_t p, const HemisphereParts& parts, std::uint32_t count,
                  std::span<const BrightPoint> bright);

  const TransportNetwork* network_;
  std::vector<rays::SurfacePoint> points_;
  std::vector<float> openness_;
  std::vector<Link> links_;
  std::vector<std::size_t> first_;         ///< of each point's links, and the end
  std::vector<Moving> moving_;             ///< by point
  std::vector<std::size_t> first_moving_;  ///< likewise
};

/// Adds to the light of points, one for each.
using AddRecordLight =
    std::function<void(std::span<const rays::SurfacePoint>, std::vector<probes::RecordLight>&)>;

/// Light of the network in a pose: direct irradiance [light group][patch], as of SurfaceGather, that of each
/// patch by all light, and of each surfel by what was reflected, by which points are judged.
struct PosedIrradiance {
  std::vector<std::vector<Irradiance4>> direct;
  std::vector<Irradiance4> lit, reflected;
};
/// Puts the network into the pose of a time [s] and returns its light there.
using LightOfPose = std::function<PosedIrradiance(float)>;

/// Gathers at places of the network's static surfels, and with baked groups of all other still surfaces: at
/// first far apart, then wherever points do not predict each other's light within a few per cent or that of
/// surfels within a quarter, surfaces are nearer than points, or no point is seen, down to an even spread of
/// at most params.points; below that where light alone asks for it, while there are fewer; then at no more
/// than as many again where surfels or their patches see none. So in the pose of each of `times` [s], one
/// after the other; what `add_more` adds to the light of the points, all of them so far, counts in the first.
/// The network is left in the last pose. Throws as SurfaceGather does, and Error for no time.
std::unique_ptr<SurfaceGather> gather_where_needed(const TransportNetwork& network,
                                                   const GatherParams& params, std::span<const float> times,
                                                   const LightOfPose& light_at, const Control& control = {},
                                                   const AddRecordLight& add_more = {});

}  // namespace ssphh::transport
