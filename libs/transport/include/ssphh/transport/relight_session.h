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

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/sh/coefficients.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/surface_gather.h>

namespace ssphh::transport {

struct ProbePlace {
  std::string name;
  vec3 position{0};
  float radius = 0.1f;  ///< of the sphere that emits LightingState::emission
};

/// Those of whatever has a name, a position and a radius: probes, SPHLs, what place_probes() finds.
template <class Probes>
std::vector<ProbePlace> places_of(const Probes& probes) {
  std::vector<ProbePlace> places;
  for (const auto& probe : probes) places.push_back({probe.name, probe.position, probe.radius});
  return places;
}

struct RelightParams {
  TransportParams transport;
  SolveParams solve;
  int poses = 0;           ///< 0: parts are posed exactly; K ≥ 2: blended between K poses of the animation
  int degree = 4;          ///< of the probes' functions
  float changed = 1e-3f;   ///< a probe changed when a coefficient did by more than this share of its mean
  bool warm_start = true;  ///< false: every update starts from darkness, so its bits tell nothing of the past
  probes::LightOperator op = probes::LightOperator::surfel;  ///< surfel or bounce
  BounceParams bounce = {};
  GatherParams records = {};  ///< of the light kept at surfaces
};

/// One update. Times in milliseconds, rays as traced.
struct RelightReport {
  double pose_ms = 0, direct_ms = 0, solve_ms = 0, project_ms = 0;
  std::uint64_t pose_rays = 0, direct_rays = 0;
  SolveReport solve;
  std::size_t hits_changed = 0;
  std::vector<int> changed_probes;

  double total_ms() const { return pose_ms + direct_ms + solve_ms + project_ms; }
};

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
  RelightSession(const rays::TransportSource& source, std::vector<ProbePlace> places,
                 const RelightParams& params = {}, float time = 0, const Control& control = {});
  RelightSession(const rays::TransportSource&&, std::vector<ProbePlace>, const RelightParams& = {}, float = 0,
                 const Control& = {}) = delete;  // it would be gone
  ~RelightSession();
  RelightSession(RelightSession&&) noexcept;
  RelightSession& operator=(RelightSession&&) noexcept;

  /// Brings the probes up to date with the state; does only what changed since the last call. Factors of
  /// groups cost no ray; emission bounces like any other light (`matrix` transport). Throws Error for a state
  /// that scene::check_lighting refuses, and Cancelled when asked to stop. When it throws, the probes stay as
  /// they were, and the next call does all that this one should have done. Allocates nothing where nothing
  /// changed.
  RelightReport update(const scene::LightingState& state, const Control& control = {});

  /// The state that the last update() was asked for, also where it threw; at first the source's own.
  const scene::LightingState& lighting() const;
  const std::vector<ProbePlace>& places() const;
  /// S_loop: reflected light alone, for surfaces that get direct light from elsewhere. None before the first
  /// update(); all other light is dark then.
  const std::vector<sh::RadianceSh>& reflected() const;
  /// Emitters that probe i sees directly; S_full = reflected + emitted. Found when asked for, by at
  /// most 16,384 rays: none where nothing can be met that emits.
  sh::RadianceSh emitted(int probe) const;
  /// Direct irradiance at each surfel per group, unscaled.
  std::vector<std::vector<Irradiance4>> direct_by_group() const;
  /// Per group, unscaled: the light as a bake stores it. Solves anew for each group; `slowest` tells
  /// of the one that took most iterations, converged if all did.
  std::vector<std::vector<sh::RadianceSh>> reflected_by_group(const Control& control = {},
                                                              SolveReport* slowest = nullptr) const;
  std::vector<std::vector<sh::RadianceSh>> emitted_by_group() const;

  /// Emission profile of whatever stands in a sphere, as lit after the last update(): the radiance that
  /// leaves the sphere into each direction, averaged over its disc; empty space in it is dark. As
  /// LightingState::emission of a probe with this radius it stands in for the thing itself (paper §5, Figure
  /// 12: a fire, a car with its lamps). `rays` per direction; 16 · (degree + 1)² directions. Throws Error
  /// with bounce, which does not light surfels.
  sh::RadianceSh emission_profile(const vec3& center, float radius, int degree, int rays = 256) const;

  /// Keeps records of light as asked for, from now on and of the last update(); 0 points: none. Throws Error
  /// as SurfaceGather does, and Cancelled.
  void keep_records(const GatherParams& params, const Control& control = {});
  /// The same at these points, as they stand in the pose of now.
  void keep_records_at(std::vector<rays::SurfacePoint> points, const GatherParams& params,
                       const Control& control = {});
  /// Where the light of surfaces that stand still is kept; null: nowhere.
  const SurfaceGather* gather() const;
  /// Of each of the gather's points: reflected light after the last update().
  const std::vector<probes::RecordLight>& record_light() const;
  /// Direct light beside it. Found when records are: updates do not find it anew.
  std::vector<KeptDirect> kept_direct() const;
  /// What a group's emitters send straight to probe i, sampled. Throws Error before the first update().
  sh::RadianceSh arriving(int group, int probe) const;
  /// Names, in the order of the state's factors.
  const std::vector<std::string>& light_groups() const;
  /// The records as a bake stores them: per group, unscaled, and merged by the state's factors.
  probes::SurfaceRecords records_by_group(const Control& control = {}) const;

  /// Indirect irradiance at each surfel; with bounce empty unless records are kept.
  const std::vector<Irradiance4>& surfel_irradiance() const;
  const std::vector<Irradiance4>& surfel_direct() const;
  const TransportNetwork& network() const;

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::transport
