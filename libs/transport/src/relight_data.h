#pragma once
/// What a RelightSession keeps.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/direct_field.h>
#include <ssphh/transport/relight_session.h>
#include <ssphh/transport/surface_gather.h>

#include "network_data.h"
#include "pace.h"
#include "pane_light.h"
#include "probe_light.h"
#include "record_direct.h"
#include "sphl_emission.h"

namespace ssphh::transport {

/// What a source says of itself must hold together.
inline void check_source(const rays::TransportSource& source, std::size_t lights) {
  const auto groups = static_cast<int>(source.light_groups().size());
  const auto is_group = [&](int group) { return group >= 0 && group < groups; };
  for (std::size_t i = 0; i < lights; ++i)
    require(is_group(source.light_group_of(static_cast<int>(i))), "transport source",
            "a light is of a group that there is not");
  const int environment = source.environment_group();
  require(environment == -1 || is_group(environment), "transport source",
          "the environment is of a group that there is not");
}

inline void check_places(const std::vector<scene::ProbePlace>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i].radius >= 0) || !std::isfinite(places[i].radius))
      throw Error(fmt::format("probe {}", i), fmt::format("its radius {} is no length", places[i].radius));
  }
}

inline bool differs(const sh::RadianceSh& a, const sh::RadianceSh& b, float tolerance) {
  if (a.values.size() != b.values.size()) return true;
  const float limit =
      tolerance * std::max(max_component(glm::abs(a.values[0])), max_component(glm::abs(b.values[0])));
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    if (max_component(glm::abs(a.values[k] - b.values[k])) > limit) return true;
  }
  return false;
}

/// E of each patch, direct and reflected; `indirect` is that of surfels.
inline void total(std::span<const Irradiance4> direct, std::span<const Irradiance4> indirect,
                  std::vector<Irradiance4>& sum) {
  sum.resize(direct.size());
  const std::size_t patches = indirect.empty() ? 1 : direct.size() / indirect.size();
  for (std::size_t p = 0; p < sum.size(); ++p) sum[p] = direct[p] + indirect[p / patches];
}
inline std::vector<Irradiance4> total(std::span<const Irradiance4> direct,
                                      std::span<const Irradiance4> indirect) {
  std::vector<Irradiance4> sum;
  total(direct, indirect, sum);
  return sum;
}

/// Which call of update() asked for what.
struct PassClock {
  struct Call {
    std::uint64_t number = 0;
    std::chrono::steady_clock::time_point at{};
  };
  Call last, pass, shown;  ///< the last one that asked for what the pass finds, and for the light there is

  void call() {
    last = {last.number + 1, std::chrono::steady_clock::now()};
    if (shown.at.time_since_epoch().count() == 0) shown.at = last.at;
  }
  LightAge age() const {
    return {last.number - shown.number, std::chrono::duration<double>(last.at - shown.at).count()};
  }
};

struct RelightSession::Data {
  Data(const rays::TransportSource& source_in, std::vector<scene::ProbePlace> places_in,
       const RelightParams& params_in, float time, const Control& control)
      : source(source_in),
        places(std::move(places_in)),
        params(params_in),
        network(source_in, scene::positions_of(places), params_in.transport, time, control),
        projector(params_in.degree, network.gbuffer().directions),
        emitter_view(emitter_directions()),
        emitter_projector(params_in.degree, emitter_view),
        field(network, source_in.light_groups().size()),
        state(rays::lighting_at(source_in, time)),
        group_dirty(source_in.light_groups().size(), true),
        given(state),
        shown(state) {
    check_places(places);
    check_records(params.records);
    check_source(source, state.lights.size());
    if (params.op == probes::LightOperator::path)
      throw Error("relighting", "path tracing is no transport between probes",
                  "use operator surfel or bounce");
    if (params.op == probes::LightOperator::bounce) {
      if (params.poses != 0)
        throw Error("relighting", "operator bounce cannot blend between poses",
                    "pose exactly, or use surfel");
      bounce = std::make_unique<BounceOperator>(network, source, params.degree, params.bounce);
    }
    if (params.poses != 0) {
      network.prepare_poses(params.poses, control);
    } else {
      network.data_->kept.allow(params.kept_pose_bytes);
    }
    emitters.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) emitters[i] = {places[i].position, places[i].radius, {}};
    keep_records(control);
    direct_light.reset();  // all is dark before the first update
    changed_probes.reserve(places.size());
  }

  const rays::TransportSource& source;
  std::vector<scene::ProbePlace> places;
  RelightParams params;
  TransportNetwork network;
  DirectionProjector projector;
  std::vector<vec3> emitter_view;
  DirectionProjector emitter_projector;
  DirectField field;
  Solver solver;
  std::unique_ptr<BounceOperator> bounce;  ///< of that operator alone
  std::unique_ptr<SurfaceGather> gather;   ///< where records are kept

  scene::LightingState state;  ///< of the pass under way, or the last one
  std::vector<bool> group_dirty;
  std::vector<SphlEmitter> emitters;
  std::vector<vec3> emission;  ///< at each sample, from the emitters; empty: none
  bool emission_dirty = false, scale_dirty = false;
  bool unfinished = false;  ///< an update() threw: nothing that it touched can be relied on

  std::unique_ptr<rays::DirectLight> direct_light;
  /// Of patches, surfels, probes and records: what there is, and that of the pass under way.
  struct Light {
    std::vector<Irradiance4> direct, indirect;
    std::vector<sh::RadianceSh> reflected;
    std::vector<probes::RecordLight> records;
  } light, next;
  RecordDirect record_direct;             ///< of params.records.baked
  scene::LightingState direct_state;      ///< in which that was found
  PaneLight pane_light;                   ///< of the pass under way, or the last one
  std::vector<std::uint8_t> direct_held;  ///< of its groups: whether it is that of `shown`

  // Updates.
  scene::LightingState given;  ///< of the last call
  scene::LightingState shown;  ///< of `light`
  /// What an update does, in this order.
  enum class Stage {
    idle,
    place,
    pose,
    pose_records,
    lamps,
    direct,
    emission,
    panes,
    solve,
    project,
    records
  };
  Stage stage = Stage::idle;
  std::size_t done = 0;  ///< of the stage
  std::size_t group = 0,
              chosen = 0;  ///< of the stage `direct`: its group, and how many samples that asks for
  bool is_chosen = false, is_begun = false;  ///< whether they are; whether the solver has begun
  PassClock clock;
  std::vector<scene::Bounds> moved, old_bounds;  ///< of parts, in the world
  std::vector<mat4> old_poses;
  std::vector<Irradiance4> lit;  ///< direct and indirect
  std::vector<vec4> radiosity;
  std::vector<float> scratch;
  std::vector<std::uint8_t> changed;  ///< of each probe, by the passes that this call finished
  std::vector<int> changed_probes;

  // The pass, in relight_pass.cpp.
  /// Begins to find the light of a state; false: it is there already.
  bool begin(const scene::LightingState& wanted);
  /// Goes on with the pass; false: time is over.
  bool go_on(RelightReport& report, const Control& control, Pace& pace);
  bool step(RelightReport& report, const Control& control, Pace& pace);
  bool pose(RelightReport& report, Pace& pace);
  bool pose_gather(Pace& pace);
  bool find_direct(Pace& pace, const Control& control);
  void find_emission();
  /// Notes whose light panes mirror anew, before the marks of `group_dirty` go.
  void mark_panes();
  bool find_pane_light(Pace& pace, const Control& control);
  bool solve(RelightReport& report, const Control& control, Pace& pace);
  bool project(Pace& pace);
  void publish();
  /// Nothing is under way.
  const Data& settled() const {
    require(stage == Stage::idle, "relighting",
            "an update is under way; call update() until its report says that it is finished");
    return *this;
  }
  Data& settled() {
    std::as_const(*this).settled();
    return *this;
  }

  // Records, in relight_records.cpp.
  /// Throws Error for what cannot be kept, so that what is kept stays.
  void check_records(const GatherParams& asked) const;
  void keep_records(const Control& control);
  /// Poses in which light asks for records; the present one is the first.
  std::vector<float> record_times() const;
  /// Everything but the light that is bounced.
  void put_into_pose(float time, const Control& control);
  /// Light at the surfels with every group as bright as another.
  PosedIrradiance light_alike() const;
  /// At these places, in place of those that keep_records() would choose.
  void keep_records_at(std::vector<rays::SurfacePoint> points, const Control& control);
  /// What panes mirror to all records and probes.
  void light_by_panes(const Control& control);
  /// As lit after the last update.
  void light_records();
  /// Brings the direct light up to date without an update.
  void find_direct_for_records();
  void note_direct_held() {
    direct_held.clear();
    for (const int g : record_direct.groups()) direct_held.push_back(direct_holds(g));
  }

  /// Whether the direct light that is kept of a group is that of the last state, but for its factor.
  bool direct_holds(int asked) const {
    if (state.time != direct_state.time) return false;
    if (asked == source.environment_group() && state.environment() != direct_state.environment())
      return false;
    for (std::size_t i = 0; i < state.lights.size(); ++i) {
      if (source.light_group_of(static_cast<int>(i)) == asked && state.lights[i] != direct_state.lights[i])
        return false;
    }
    return true;
  }

  /// Direct irradiance of each patch per group, unscaled.
  std::vector<std::vector<Irradiance4>> direct_by_group() const {
    std::vector<std::vector<Irradiance4>> result(state.group_scales.size());
    for (std::size_t g = 0; g < result.size(); ++g) {
      std::vector<vec3> scales(result.size(), vec3(0));
      scales[g] = vec3(1);
      field.sum(scales, {}, result[g]);
    }
    return result;
  }

  void check_group(int index) const {
    require(index >= 0 && static_cast<std::size_t>(index) < group_dirty.size(), "light group",
            "there is none of that index");
  }
  void check_probe(int probe) const {
    if (probe < 0 || static_cast<std::size_t>(probe) >= places.size())
      throw Error(fmt::format("probe {}", probe), fmt::format("there are {} probes", places.size()));
  }

  std::vector<sh::RadianceSh> emitted(std::size_t probe) const {
    if (!direct_light) return {state.group_scales.size(), sh::RadianceSh(params.degree)};
    return project_emitted(network, source, emitter_projector, emitter_view, places[probe].position,
                           *direct_light);
  }

  bool any_group_dirty() const {
    return std::find(group_dirty.begin(), group_dirty.end(), true) != group_dirty.end();
  }

  /// What must be found anew to come from the last state to the next one, all of it after an update() that
  /// threw.
  void note_changes(const scene::LightingState& wanted) {
    if (unfinished) group_dirty.assign(group_dirty.size(), true);
    for (std::size_t i = 0; i < wanted.lights.size(); ++i) {
      if (wanted.lights[i] != state.lights[i]) group_dirty[source.light_group_of(static_cast<int>(i))] = true;
    }
    const int environment = source.environment_group();
    if (environment >= 0 && wanted.environment() != state.environment()) group_dirty[environment] = true;
    scale_dirty = unfinished || wanted.group_scales != state.group_scales;
    emission_dirty = unfinished || wanted.emission != state.emission;
  }

  /// Reflected light of all probes under another direct light, from darkness.
  std::vector<sh::RadianceSh> reflected_under(std::span<const Irradiance4> other, SolveReport& report) const {
    std::vector<sh::RadianceSh> result;
    if (bounce) {
      const BounceReport bounced = bounce->solve(other, result);
      report = {.iterations = bounced.iterations, .residual = 0, .converged = bounced.converged};
      return result;
    }
    project_reflected(network, projector, lit_under(other, report), result);
    return result;
  }

  /// E of every patch, direct and reflected, under another direct light, from darkness.
  std::vector<Irradiance4> lit_under(std::span<const Irradiance4> other, SolveReport& report) const {
    std::vector<Irradiance4> bounced;
    report = Solver().solve(network.links(), network.albedo(), other, chebyshev_bound(network.contraction()),
                            params.solve, bounced);
    return total(other, bounced);
  }
};

}  // namespace ssphh::transport
