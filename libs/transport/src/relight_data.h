#pragma once
/// What a RelightSession keeps, and the stages of an update.

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/transport/direct_field.h>
#include <ssphh/transport/relight_session.h>

#include "probe_light.h"
#include "record_direct.h"
#include "sphl_emission.h"

namespace ssphh::transport {

inline std::vector<vec3> positions_of(const std::vector<ProbePlace>& places) {
  std::vector<vec3> positions;
  for (const ProbePlace& place : places) positions.push_back(place.position);
  return positions;
}

/// Runs `body`, adds its time and rays.
template <class Body>
void measure(const rays::TransportSource& source, double& ms, std::uint64_t* rays, const Body& body) {
  const Stopwatch watch;
  const std::uint64_t before = source.rays_traced();
  body();
  if (rays) *rays += source.rays_traced() - before;
  ms += watch.milliseconds();
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

inline void check_places(const std::vector<ProbePlace>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i].radius >= 0) || !std::isfinite(places[i].radius))
      throw Error(fmt::format("probe {}", i), fmt::format("its radius {} is no length", places[i].radius));
  }
}

inline std::vector<Irradiance4> total(std::span<const Irradiance4> direct,
                                      std::span<const Irradiance4> indirect) {
  std::vector<Irradiance4> sum(direct.size());
  for (std::size_t s = 0; s < sum.size(); ++s) sum[s] = direct[s] + indirect[s];
  return sum;
}

struct RelightSession::Data {
  Data(const rays::TransportSource& source_in, std::vector<ProbePlace> places_in,
       const RelightParams& params_in, float time, const Control& control)
      : source(source_in),
        places(std::move(places_in)),
        params(params_in),
        network(source_in, positions_of(places), params_in.transport, time, control),
        projector(params_in.degree, network.gbuffer().directions),
        emitter_view(emitter_directions()),
        emitter_projector(params_in.degree, emitter_view),
        field(network, source_in.light_groups().size()),
        state(rays::lighting_at(source_in, time)),
        group_dirty(source_in.light_groups().size(), true) {
    check_places(places);
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
    if (params.poses != 0) network.prepare_poses(params.poses, control);
    emitters.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) emitters[i] = {places[i].position, places[i].radius, {}};
    keep_records(control);
    direct_light.reset();  // all is dark before the first update
    direct.clear();
  }

  const rays::TransportSource& source;
  std::vector<ProbePlace> places;
  RelightParams params;
  TransportNetwork network;
  DirectionProjector projector;
  std::vector<vec3> emitter_view;
  DirectionProjector emitter_projector;
  DirectField field;
  Solver solver;
  std::unique_ptr<BounceOperator> bounce;  ///< of that operator alone
  std::unique_ptr<SurfaceGather> gather;   ///< where records are kept

  scene::LightingState state;  ///< that the last update() was asked for
  std::vector<bool> group_dirty;
  std::vector<SphlEmitter> emitters;
  std::vector<vec3> emission;  ///< at each sample, from the emitters; empty: none
  bool emission_dirty = false, scale_dirty = false;
  bool unfinished = false;  ///< an update() threw: nothing that it touched can be relied on

  std::unique_ptr<rays::DirectLight> direct_light;
  std::vector<Irradiance4> direct, indirect;
  std::vector<sh::RadianceSh> reflected, before;
  std::vector<probes::RecordLight> record_light;
  RecordDirect record_direct;         ///< of params.records.baked
  scene::LightingState direct_state;  ///< in which that was found

  void keep_records(const Control& control) {
    gather.reset();
    record_light.clear();
    record_direct = RecordDirect(params.records.baked);
    if (params.records.points == 0) return;
    if (params.records.points < 0)
      throw Error("surface records", fmt::format("{} is no number of points", params.records.points));
    for (const int group : params.records.baked)
      require(group >= 0 && static_cast<std::size_t>(group) < state.group_scales.size(), "light group",
              "there is none of that index");
    update_direct({});
    const std::vector<vec3> scales = alike(direct_by_group());
    const auto extend = [&](std::span<const rays::SurfacePoint> points) {
      record_direct.extend(*direct_light, points, params.records.rays, control);
    };
    AddRecordLight add_direct;
    if (!params.records.baked.empty()) {
      add_direct = [&](std::span<const rays::SurfacePoint> points, auto& light) {
        extend(points);
        record_direct.add_to(light, scales);
      };
    }
    const std::vector<float> times = record_times();
    const auto light_at = [&](float time) {
      put_into_pose(time);
      return light_alike();
    };
    try {
      gather = gather_where_needed(network, params.records, times, light_at, control, add_direct);
      put_into_pose(times[0]);
    } catch (...) {
      state.time = times[0];
      unfinished = true;
      throw;
    }
    extend(gather->points());
    direct_state = state;
  }

  /// Poses in which light asks for records; the present one is the first.
  std::vector<float> record_times() const {
    std::vector<float> times = {state.time};
    const int poses = params.records.poses;
    for (int i = 0; poses > 1 && i < poses && source.part_count() > 1 && source.duration() > 0; ++i) {
      const float time = source.duration() * static_cast<float>(i) / static_cast<float>(poses - 1);
      if (time != times[0]) times.push_back(time);
    }
    return times;
  }

  /// Everything but the light that is bounced.
  void put_into_pose(float time) {
    if (time == state.time) return;
    state.time = time;
    RelightReport unread;
    update_direct(move_parts(unread));
  }

  /// Light at the surfels with every group as bright as another.
  PosedIrradiance light_alike() const {
    PosedIrradiance light{direct_by_group(), {}};
    const std::vector<vec3> scales = alike(light.direct);
    std::vector<Irradiance4> sum(network.surfel_count(), Irradiance4(0));
    for (std::size_t g = 0; g < scales.size(); ++g) {
      if (scales[g].x == 0) continue;
      for (std::size_t s = 0; s < sum.size(); ++s) sum[s] += scales[g].x * light.direct[g][s];
    }
    SolveReport report;
    light.lit = lit_under(sum, report);
    return light;
  }

  /// At these places, in place of those that keep_records() would choose.
  void keep_records_at(std::vector<rays::SurfacePoint> points, const Control& control) {
    record_direct = RecordDirect(params.records.baked);
    update_direct({});
    gather = std::make_unique<SurfaceGather>(network, std::move(points), params.records.rays,
                                             direct_by_group(), control);
    record_direct.extend(*direct_light, gather->points(), params.records.rays, control);
    direct_state = state;
  }

  /// As lit after the last update.
  void light_records() {
    if (!gather || reflected.empty()) return;
    if (bounce) solve_surfels();
    gather->light(total(direct, indirect), record_light);
  }

  /// Whether the direct light that is kept of a group is that of the last state, but for its factor.
  bool direct_holds(int group) const {
    if (state.time != direct_state.time) return false;
    if (group == source.environment_group() &&
        state.environment_rotation != direct_state.environment_rotation)
      return false;
    for (std::size_t i = 0; i < state.lights.size(); ++i) {
      if (source.light_group_of(static_cast<int>(i)) == group && state.lights[i] != direct_state.lights[i])
        return false;
    }
    return true;
  }

  /// Factors that make each group's direct light as bright as another's.
  static std::vector<vec3> alike(std::span<const std::vector<Irradiance4>> by_group) {
    std::vector<vec3> scales;
    for (const std::vector<Irradiance4>& group : by_group) {
      double all = 0;
      for (const Irradiance4& e : group) all += static_cast<double>(luminance(vec3(e)));
      scales.emplace_back(all > 0 ? static_cast<float>(static_cast<double>(group.size()) / all) : 0.0f);
    }
    return scales;
  }

  /// Direct irradiance at each surfel per group, unscaled.
  std::vector<std::vector<Irradiance4>> direct_by_group() const {
    std::vector<std::vector<Irradiance4>> result(state.group_scales.size());
    for (std::size_t g = 0; g < result.size(); ++g) {
      std::vector<vec3> scales(result.size(), vec3(0));
      scales[g] = vec3(1);
      field.sum(scales, {}, result[g]);
    }
    return result;
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
  void note_changes(const scene::LightingState& next) {
    if (unfinished) group_dirty.assign(group_dirty.size(), true);
    for (std::size_t i = 0; i < next.lights.size(); ++i) {
      if (next.lights[i] != state.lights[i])
        group_dirty[static_cast<std::size_t>(source.light_group_of(static_cast<int>(i)))] = true;
    }
    const int environment = source.environment_group();
    if (environment >= 0 && next.environment_rotation != state.environment_rotation)
      group_dirty[static_cast<std::size_t>(environment)] = true;
    scale_dirty = unfinished || next.group_scales != state.group_scales;
    emission_dirty = unfinished || next.emission != state.emission;
  }

  /// Poses the parts; returns the world bounds that they left or entered.
  std::vector<scene::Bounds> move_parts(RelightReport& report) {
    std::vector<scene::Bounds> moved;
    const std::vector<mat4> old_poses = network.poses();
    std::vector<scene::Bounds> old_bounds;
    for (int p = 0; p < source.part_count(); ++p) old_bounds.push_back(network.part_world_bounds(p));
    const PoseReport pose =
        params.poses == 0 ? network.set_time(state.time) : network.set_time_between(state.time);
    if (bounce) bounce->update_pose();
    if (gather) gather->update_pose();
    report.hits_changed = pose.hits_changed;
    for (int p = 1; p < source.part_count(); ++p) {
      const auto index = static_cast<std::size_t>(p);
      if (network.poses()[index] == old_poses[index]) continue;
      moved.push_back(old_bounds[index]);
      moved.push_back(network.part_world_bounds(p));
      for (std::size_t g = 0; g < group_dirty.size(); ++g) {
        if (source.group_emits_from(static_cast<int>(g), p)) group_dirty[g] = true;
      }
    }
    return moved;
  }

  void place_emission() {
    for (SphlEmitter& emitter : emitters) emitter.leaving = {};
    for (const scene::SphlEmission& given : state.emission)
      emitters[static_cast<std::size_t>(given.probe)].leaving = given.leaving;
  }

  void update_direct(const std::vector<scene::Bounds>& moved) {
    if (any_group_dirty() || !moved.empty() || !direct_light) {
      direct_light = source.direct_light(state.lights, network.poses(), state.environment_rotation);
      require(direct_light != nullptr, "transport source", "it gives no direct light");
    }
    for (std::size_t g = 0; g < group_dirty.size(); ++g) {
      if (group_dirty[g]) {
        field.update_all(static_cast<int>(g), *direct_light);
      } else if (!moved.empty()) {
        field.update_moved(static_cast<int>(g), *direct_light, moved);
      }
      group_dirty[g] = false;
    }
    if (emission_dirty) place_emission();
    if (emission_dirty || (!moved.empty() && !emission.empty())) {
      emission.clear();
      for (const SphlEmitter& emitter : emitters) {
        if (emitter.leaving.empty()) continue;
        emission.resize(network.samples().size(), vec3(0));
        add_emission(network, source, emitter, emission);
      }
      emission_dirty = false;
    }
    field.sum(state.group_scales, emission, direct);
    scale_dirty = false;
  }

  /// Lets the direct light bounce: `indirect`, or with bounce the probes themselves; records need both.
  SolveReport solve(bool first) {
    SolveReport report;
    if (bounce) {
      before = reflected;
      report = summary(
          bounce->solve(direct, reflected, params.warm_start && !first && params.bounce.applications == 0));
      if (!gather) return report;
    }
    const SolveReport solved = solve_surfels();
    return bounce ? report : solved;
  }
  SolveReport solve_surfels() {
    if (!params.warm_start) indirect.clear();
    return solver.solve(network.links(), network.albedo(), direct, chebyshev_bound(network.contraction()),
                        params.solve, indirect);
  }
  static SolveReport summary(const BounceReport& report) {
    return {.iterations = report.iterations, .residual = 0, .converged = report.converged};
  }

  /// Reflected light of all probes under another direct light, from darkness.
  std::vector<sh::RadianceSh> reflected_under(std::span<const Irradiance4> other, SolveReport& report) const {
    std::vector<sh::RadianceSh> result;
    if (bounce) {
      report = summary(bounce->solve(other, result));
      return result;
    }
    project_reflected(network, projector, lit_under(other, report), result);
    return result;
  }

  /// E at every surfel, direct and reflected, under another direct light, from darkness.
  std::vector<Irradiance4> lit_under(std::span<const Irradiance4> other, SolveReport& report) const {
    std::vector<Irradiance4> bounced;
    report = Solver().solve(network.links(), network.albedo(), other, chebyshev_bound(network.contraction()),
                            params.solve, bounced);
    return total(other, bounced);
  }
};

}  // namespace ssphh::transport
