#pragma once
/// Probes that follow moving lamps and doors, frame by frame: `surfel` or `bounce` transport kept warm. Holds
/// no files and draws nothing.
///
///   const trace::TransportScene source(scene);
///   transport::RelightSession session(source, places);
///   scene::LightingState state = rays::lighting_at(source, 0.4f);  // the doors' time
///   state.lights[0].intensity = 20;
///   const transport::RelightReport report = session.update(state);
///   session.reflected()[i];  // what surfaces look up
///
/// A session is one thread's at a time: no call beside another, but for several at once of those that are
/// const and do not say that they find something anew. Threads that read light while another updates it take
/// it from core/snapshots.h (docs/embed.md#a-game-loop). Updates work on all threads that parallel loops have
/// (core/executor.h).

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/transport_params.h>

namespace ssphh::rays {
class TransportSource;
}
namespace ssphh::scene {
struct LightingState;  // scene/lighting_state.h
}

namespace ssphh::transport {

class SurfaceGather;
class TransportNetwork;

struct RelightParams {
  TransportParams transport;
  SolveParams solve;
  int poses = 0;  ///< 0: parts are posed exactly; K ≥ 2: blended between K poses of the animation
  /// What exact poses may keep of what their rays met, so that those of an animation that repeats cast none
  /// again: the same bits without. Taken when a part first moves; 0: nothing.
  std::size_t kept_pose_bytes = std::size_t{64} << 20;
  int degree = 4;          ///< of the probes' functions
  float changed = 1e-3f;   ///< a probe changed when a coefficient did by more than this share of its mean
  bool warm_start = true;  ///< false: every update starts from darkness, so its bits tell nothing of the past
  probes::LightOperator op = probes::LightOperator::surfel;  ///< surfel or bounce
  BounceParams bounce = {};
  GatherParams records = {};  ///< of the light kept at surfaces
};

/// How long ago an update() asked for the light that there is; 0 of both: the last one did.
struct LightAge {
  std::uint64_t updates = 0;
  double seconds = 0;  ///< wall time
};

/// One update. Times in milliseconds, rays as traced, what this call did; the rest tells of all that it
/// finished.
struct RelightReport {
  double pose_ms = 0, direct_ms = 0, solve_ms = 0, project_ms = 0;
  std::uint64_t pose_rays = 0, direct_rays = 0;
  SolveReport solve;
  std::size_t hits_changed = 0;
  std::span<const int> changed_probes;  ///< ascending; the session's, until its next update()
  bool finished = true;  ///< false: time was over before all was done; the next update() goes on
  LightAge age;          ///< of the light now

  double total_ms() const { return pose_ms + direct_ms + solve_ms + project_ms; }
};

/// A budget of update(): as long as it takes.
inline constexpr double unlimited_ms = std::numeric_limits<double>::infinity();

/// Direct light of a light group that records keep (GatherParams::baked).
struct KeptDirect {
  int group;
  std::span<const probes::RecordLight> light;  ///< of each of the gather's points, unscaled
  /// Whether it is that of the last update(): lamps, poses and the surroundings are as they were when it was
  /// found. If not, direct light must be sampled.
  bool holds;
};

class RelightSession {
 public:
  /// Keeps a reference to `source`. Throws Error as TransportNetwork does, for an operator that is none of
  /// transport, and for blended poses with bounce. The first update() lights everything.
  RelightSession(const rays::TransportSource& source, std::vector<scene::ProbePlace> places,
                 const RelightParams& params = {}, float time = 0, const Control& control = {});
  RelightSession(const rays::TransportSource&&, std::vector<scene::ProbePlace>, const RelightParams& = {},
                 float = 0, const Control& = {}) = delete;  // it would be gone
  ~RelightSession();
  RelightSession(RelightSession&&) noexcept;
  RelightSession& operator=(RelightSession&&) noexcept;

  /// Brings the probes up to date with the state; does only what changed since the last call. Factors of
  /// groups cost no ray; emission bounces like any other light (`matrix` transport). Throws Error for a state
  /// that scene::check_lighting refuses, and Cancelled when asked to stop. When it throws, the probes stay as
  /// they were, and the next call does all that this one should have done.
  ///
  /// When `budget_ms` milliseconds are over it stops, after a piece of work at least, and the next call goes
  /// on: the light stays the finished one of before until all of the new one is there, `finished` says
  /// whether it is, `age` how old it is. A state that was begun is finished first; then that of the call is,
  /// the states of calls between are passed over. The light has the bits that unlimited updates to the states
  /// begun would give. Pieces are rays, probes and bounces by the hundred, some 0.1 ms each in a flat; of
  /// `bounce` the solution is one piece.
  ///
  /// From the second update of a kind on (lamps, doors, factors) it allocates nothing, if the source does not
  /// either (TransportSource::renew_direct_light); doors with `bounce`, and emission, still do.
  RelightReport update(const scene::LightingState& state, const Control& control = {},
                       double budget_ms = unlimited_ms);

  /// The state that the last update() was asked for, also where it threw; at first the source's own.
  const scene::LightingState& lighting() const;
  /// The state whose light this is, that of the last update() that was finished; at first the source's own.
  const scene::LightingState& shown() const;
  /// How old that light is. Of no light: since the first update().
  LightAge age() const;
  /// Whether an update ran out of time and the next one goes on. What finds light anew throws Error then:
  /// emitted(), arriving(), emission_profile(), what is by group, keep_records() and keep_records_at();
  /// network() is on its way.
  bool under_way() const;
  const std::vector<scene::ProbePlace>& places() const;
  /// S_loop: reflected light alone, for surfaces that get direct light from elsewhere. None before the first
  /// finished update(); all other light is dark then.
  const std::vector<sh::RadianceSh>& reflected() const;
  /// Emitters that probe i sees directly; S_full = reflected + emitted. Found when asked for, by at
  /// most 16,384 rays: none where nothing can be met that emits.
  sh::RadianceSh emitted(int probe) const;
  /// Direct irradiance of each patch per group, unscaled.
  std::vector<std::vector<Irradiance4>> direct_by_group() const;
  /// Per group, unscaled: the light as a bake stores it. Solves anew for each group; `slowest` tells
  /// of the one that took most iterations, converged if all did.
  std::vector<std::vector<sh::RadianceSh>> reflected_by_group(const Control& control = {},
                                                              SolveReport* slowest = nullptr) const;
  /// Emitters as each probe sees them, likewise; found as emitted() is.
  std::vector<std::vector<sh::RadianceSh>> emitted_by_group() const;

  /// Emission profile of whatever stands in a sphere, as lit after the last update(): the radiance that
  /// leaves the sphere into each direction, averaged over its disc; empty space in it is dark. As
  /// LightingState::emission of a probe with this radius it stands in for the thing itself (paper §5, Figure
  /// 12: a fire, a car with its lamps). `rays` per direction; 16 · (degree + 1)² directions. Throws Error
  /// with bounce, which does not light surfels.
  sh::RadianceSh emission_profile(const vec3& center, float radius, int degree, int rays = 256) const;

  /// Keeps records of light as asked for, from now on and of the last update(); 0 points: none. Throws Error
  /// as SurfaceGather does, for a light group that there is not, and Cancelled; for what it refuses at once,
  /// records stay as they were.
  void keep_records(const GatherParams& params, const Control& control = {});
  /// Keeps records at these points, as they stand in the pose of now; likewise.
  void keep_records_at(std::vector<rays::SurfacePoint> points, const GatherParams& params,
                       const Control& control = {});
  /// Where the light of surfaces that stand still is kept; null: nowhere.
  const SurfaceGather* gather() const;
  /// Reflected light of each of the gather's points after the last update().
  const std::vector<probes::RecordLight>& record_light() const;
  /// Groups whose direct light is kept beside it, and what is kept of the i-th of them. Found when records
  /// are: updates do not find it anew.
  std::size_t kept_direct_count() const;
  KeptDirect kept_direct(std::size_t i) const;
  /// What a group's emitters send straight to probe i, sampled. Throws Error before the first update(), and
  /// for an index out of range.
  sh::RadianceSh arriving(int group, int probe) const;
  /// Names, in the order of the state's factors.
  const std::vector<std::string>& light_groups() const;
  /// The records as a bake stores them: per group, unscaled, and merged by the state's factors.
  probes::SurfaceRecords records_by_group(const Control& control = {}) const;

  /// Irradiance at a surface point by light of emitters that panes mirror, of the last update().
  vec3 mirrored(const rays::SurfacePoint& at) const;
  /// Direct irradiance there of the groups of which records hold it, of the last update().
  vec3 kept_direct(const rays::SurfacePoint& at) const;

  /// Indirect irradiance at each surfel; with bounce empty unless records are kept.
  const std::vector<Irradiance4>& surfel_irradiance() const;
  /// Irradiance of each patch straight from emitters, and mirrored by panes.
  const std::vector<Irradiance4>& patch_direct() const;
  /// E of each patch, direct and indirect.
  std::vector<Irradiance4> patch_irradiance() const;
  const TransportNetwork& network() const;

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::transport
