#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/sphere.h>
#include <ssphh/gi/relight_session.h>
#include <ssphh/gi/transport/direct_field.h>

#include "transport/probe_light.h"
#include "transport/sphl_emission.h"

namespace ssphh::gi {
namespace {

std::vector<vec3> positions_of(const std::vector<ProbePlace>& places) {
  std::vector<vec3> positions;
  for (const ProbePlace& place : places) positions.push_back(place.position);
  return positions;
}

/// Runs `body`, adds its time and rays.
template <class Body>
void measure(const scene::TransportSource& source, double& ms, std::uint64_t* rays, const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t before = source.rays_traced();
  body();
  if (rays) *rays += source.rays_traced() - before;
  ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool differs(const sh::RadianceSh& a, const sh::RadianceSh& b, float tolerance) {
  if (a.values.size() != b.values.size()) return true;
  const float limit =
      tolerance * std::max(max_component(glm::abs(a.values[0])), max_component(glm::abs(b.values[0])));
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    if (max_component(glm::abs(a.values[k] - b.values[k])) > limit) return true;
  }
  return false;
}

std::vector<Irradiance4> total(std::span<const Irradiance4> direct, std::span<const Irradiance4> indirect) {
  std::vector<Irradiance4> sum(direct.size());
  for (std::size_t s = 0; s < sum.size(); ++s) sum[s] = direct[s] + indirect[s];
  return sum;
}

}  // namespace

struct RelightSession::Data {
  Data(const scene::TransportSource& source_in, std::vector<ProbePlace> places_in,
       const RelightParams& params_in, float time, const Control& control)
      : source(source_in),
        places(std::move(places_in)),
        params(params_in),
        network(source_in, positions_of(places), params_in.transport, time, control),
        projector(params_in.degree, network.gbuffer().directions),
        emitter_view(emitter_directions()),
        emitter_projector(params_in.degree, emitter_view),
        field(network, source_in.light_groups().size()),
        lights(source_in.lights(time)),
        light_set(lights.size(), false),
        group_dirty(source_in.light_groups().size(), true),
        group_scale(source_in.light_groups().size(), vec3(1)),
        pending_time(time) {
    if (params.op == LightOperator::path)
      throw Error("relighting", "path tracing is no transport between probes",
                  "use operator surfel or bounce");
    if (params.op == LightOperator::bounce) {
      if (params.poses != 0)
        throw Error("relighting", "operator bounce cannot blend between poses",
                    "pose exactly, or use surfel");
      bounce = std::make_unique<BounceOperator>(network, source, params.degree, params.bounce);
    }
    if (params.poses != 0) network.prepare_poses(params.poses, control);
    emitters.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) emitters[i] = {places[i].position, places[i].radius, {}};
  }

  const scene::TransportSource& source;
  std::vector<ProbePlace> places;
  RelightParams params;
  TransportNetwork network;
  DirectionProjector projector;
  std::vector<vec3> emitter_view;
  DirectionProjector emitter_projector;
  DirectField field;
  Solver solver;
  std::unique_ptr<BounceOperator> bounce;  ///< of that operator alone

  std::vector<scene::LightState> lights;
  std::vector<bool> light_set;  ///< by the user: stays when the time changes
  std::vector<bool> group_dirty;
  std::vector<vec3> group_scale;
  std::vector<SphlEmitter> emitters;
  std::vector<vec3> emission;  ///< at each sample, from the emitters; empty: none
  bool emission_dirty = false, scale_dirty = false;
  float pending_time;
  float environment_rotation = 0;

  std::unique_ptr<scene::DirectLight> direct_light;
  std::vector<Irradiance4> direct, indirect;
  std::vector<sh::RadianceSh> reflected, before;

  std::vector<sh::RadianceSh> emitted(std::size_t probe) const {
    return project_emitted(network, source, emitter_projector, emitter_view, places[probe].position,
                           *direct_light);
  }

  bool any_group_dirty() const {
    return std::find(group_dirty.begin(), group_dirty.end(), true) != group_dirty.end();
  }

  /// Poses the parts and the lights on animated nodes; returns the world bounds that parts left or entered.
  std::vector<scene::Bounds> move_parts(RelightReport& report) {
    std::vector<scene::Bounds> moved;
    const std::vector<mat4> old_poses = network.poses();
    std::vector<scene::Bounds> old_bounds;
    for (int p = 0; p < source.part_count(); ++p) old_bounds.push_back(network.part_world_bounds(p));
    const PoseReport pose =
        params.poses == 0 ? network.set_time(pending_time) : network.set_time_between(pending_time);
    if (bounce) bounce->update_pose();
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
    const std::vector<scene::LightState> posed = source.lights(pending_time);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (light_set[i] || posed[i] == lights[i]) continue;
      lights[i] = posed[i];
      group_dirty[static_cast<std::size_t>(source.light_group_of(static_cast<int>(i)))] = true;
    }
    return moved;
  }

  void update_direct(const std::vector<scene::Bounds>& moved) {
    if (any_group_dirty() || !moved.empty() || !direct_light)
      direct_light = source.direct_light(lights, network.poses(), environment_rotation);
    for (std::size_t g = 0; g < group_dirty.size(); ++g) {
      if (group_dirty[g]) {
        field.update_all(static_cast<int>(g), *direct_light);
      } else if (!moved.empty()) {
        field.update_moved(static_cast<int>(g), *direct_light, moved);
      }
      group_dirty[g] = false;
    }
    if (emission_dirty || (!moved.empty() && !emission.empty())) {
      emission.clear();
      for (const SphlEmitter& emitter : emitters) {
        if (emitter.leaving.empty()) continue;
        emission.resize(network.samples().size(), vec3(0));
        add_emission(network, source, emitter, emission);
      }
      emission_dirty = false;
    }
    field.sum(group_scale, emission, direct);
    scale_dirty = false;
  }

  /// Lets the direct light bounce: `indirect`, or with bounce the probes themselves.
  SolveReport solve(bool first) {
    if (bounce) {
      before = reflected;
      return summary(
          bounce->solve(direct, reflected, params.warm_start && !first && params.bounce.applications == 0));
    }
    if (!params.warm_start) indirect.clear();
    return solver.solve(network.links(), network.albedo(), direct, network.contraction().upper, params.solve,
                        indirect);
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
    std::vector<Irradiance4> bounced;
    report = Solver().solve(network.links(), network.albedo(), other, network.contraction().upper,
                            params.solve, bounced);
    project_reflected(network, projector, total(other, bounced), result);
    return result;
  }
};

RelightSession::RelightSession(const scene::TransportSource& source, std::vector<ProbePlace> places,
                               const RelightParams& params, float time, const Control& control)
    : data_(std::make_unique<Data>(source, std::move(places), params, time, control)) {}

RelightSession::~RelightSession() = default;

void RelightSession::set_light(int light, const scene::LightState& state) {
  Data& d = *data_;
  if (light < 0 || static_cast<std::size_t>(light) >= d.lights.size())
    throw Error(fmt::format("light {}", light), fmt::format("the scene has {} lights", d.lights.size()));
  bool finite = is_finite(state.color) && std::isfinite(state.intensity);
  for (int c = 0; c < 4; ++c) finite = finite && is_finite(vec3(state.world[c]));
  if (!finite || state.intensity < 0)
    throw Error(fmt::format("light {}", light),
                "its place, colour and intensity must be finite, the last not negative");
  const auto index = static_cast<std::size_t>(light);
  d.light_set[index] = true;
  if (d.lights[index] == state) return;
  d.lights[index] = state;
  d.group_dirty[static_cast<std::size_t>(d.source.light_group_of(light))] = true;
}

const scene::LightState& RelightSession::light(int light) const {
  return data_->lights.at(static_cast<std::size_t>(light));
}

void RelightSession::set_group_scale(int group, const vec3& scale) {
  Data& d = *data_;
  if (group < 0 || static_cast<std::size_t>(group) >= d.group_scale.size())
    throw Error(fmt::format("light group {}", group),
                fmt::format("the scene has {} groups", d.group_scale.size()));
  if (!is_finite(scale) || glm::any(glm::lessThan(scale, vec3(0))))
    throw Error(fmt::format("light group {}", group), "its factor must be finite and not negative");
  vec3& slot = d.group_scale[static_cast<std::size_t>(group)];
  d.scale_dirty |= slot != scale;
  slot = scale;
}

void RelightSession::set_environment_rotation(float rotation) {
  Data& d = *data_;
  if (!std::isfinite(rotation)) throw Error("environment", "its rotation must be a finite angle");
  const int group = d.source.environment_group();
  if (group < 0 || rotation == d.environment_rotation) return;
  d.environment_rotation = rotation;
  d.group_dirty[static_cast<std::size_t>(group)] = true;
}

void RelightSession::set_time(float time) {
  if (!std::isfinite(time)) throw Error("time", "it must be a finite number of seconds");
  data_->pending_time = time;
}

void RelightSession::set_emission(int probe, const sh::RadianceSh& leaving) {
  Data& d = *data_;
  if (probe < 0 || static_cast<std::size_t>(probe) >= d.places.size())
    throw Error(fmt::format("probe {}", probe), fmt::format("there are {} probes", d.places.size()));
  for (const vec3& v : leaving.values) {
    if (!is_finite(v)) throw Error(fmt::format("probe {}", probe), "its emission is not finite");
  }
  sh::RadianceSh& slot = d.emitters[static_cast<std::size_t>(probe)].leaving;
  d.emission_dirty |= slot != leaving;
  slot = leaving;
}

RelightReport RelightSession::update() {
  Data& d = *data_;
  RelightReport report;
  const bool first = d.reflected.empty();
  const bool posed = d.pending_time != d.network.time();
  if (!first && !posed && !d.any_group_dirty() && !d.scale_dirty && !d.emission_dirty) return report;

  std::vector<scene::Bounds> moved;
  if (posed) measure(d.source, report.pose_ms, &report.pose_rays, [&] { moved = d.move_parts(report); });
  measure(d.source, report.direct_ms, &report.direct_rays, [&] { d.update_direct(moved); });
  measure(d.source, report.solve_ms, nullptr, [&] { report.solve = d.solve(first); });
  measure(d.source, report.project_ms, nullptr, [&] {
    if (!d.bounce) {
      d.before.swap(d.reflected);
      project_reflected(d.network, d.projector, total(d.direct, d.indirect), d.reflected);
    }
    for (std::size_t i = 0; i < d.reflected.size(); ++i) {
      if (first || differs(d.reflected[i], d.before[i], d.params.changed))
        report.changed_probes.push_back(static_cast<int>(i));
    }
  });
  return report;
}

const std::vector<ProbePlace>& RelightSession::places() const {
  return data_->places;
}
const std::vector<sh::RadianceSh>& RelightSession::reflected() const {
  return data_->reflected;
}

sh::RadianceSh RelightSession::emitted(int probe) const {
  const Data& d = *data_;
  const auto i = static_cast<std::size_t>(probe);
  sh::RadianceSh sum(d.params.degree);
  if (!d.direct_light) return sum;
  std::vector<sh::RadianceSh> groups = d.emitted(i);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g] *= d.group_scale[g];
    sum += groups[g];
  }
  for (std::size_t j = 0; j < d.emitters.size(); ++j) {
    if (j == i || d.emitters[j].leaving.empty()) continue;
    if (sees(d.network, d.source, d.places[i].position, d.emitters[j]))
      add_seen_emission(d.places[i].position, d.emitters[j], sum);
  }
  return sum;
}

std::vector<std::vector<Irradiance4>> RelightSession::direct_by_group() const {
  const Data& d = *data_;
  std::vector<std::vector<Irradiance4>> result(d.group_scale.size());
  for (std::size_t g = 0; g < result.size(); ++g) {
    std::vector<vec3> scales(result.size(), vec3(0));
    scales[g] = vec3(1);
    d.field.sum(scales, {}, result[g]);
  }
  return result;
}

std::vector<std::vector<sh::RadianceSh>> RelightSession::reflected_by_group(const Control& control,
                                                                            SolveReport* slowest) const {
  const Data& d = *data_;
  SolveReport most;
  const std::vector<std::vector<Irradiance4>> direct = direct_by_group();
  const std::size_t groups = direct.size();
  std::vector<std::vector<sh::RadianceSh>> result(groups);
  ProgressStage progress(control, "solving", groups, "light groups");
  for (std::size_t g = 0; g < groups; ++g) {
    control.check();
    SolveReport solve;
    result[g] = d.reflected_under(direct[g], solve);
    const bool converged = most.converged && solve.converged;
    if (solve.iterations > most.iterations) most = solve;
    most.converged = converged;
    progress.advance(1);
  }
  if (slowest) *slowest = most;
  return result;
}

std::vector<std::vector<sh::RadianceSh>> RelightSession::emitted_by_group() const {
  const Data& d = *data_;
  std::vector<std::vector<sh::RadianceSh>> result(d.group_scale.size());
  for (std::size_t i = 0; i < d.places.size(); ++i) {
    const std::vector<sh::RadianceSh> groups = d.emitted(i);
    for (std::size_t g = 0; g < groups.size(); ++g) result[g].push_back(groups[g]);
  }
  return result;
}

sh::RadianceSh RelightSession::emission_profile(const vec3& center, float radius, int degree,
                                                int rays) const {
  const Data& d = *data_;
  if (d.bounce) throw Error("emission profile", "operator bounce does not light surfels", "use surfel");
  if (!is_finite(center) || !(radius > 0) || !std::isfinite(radius))
    throw Error("emission profile", "its sphere must have a finite centre and a positive radius");
  if (degree < 0 || degree > sh::max_degree || rays < 1)
    throw Error("emission profile",
                fmt::format("degree {} and {} rays per direction make no sense", degree, rays));
  const int count = 16 * sh::coefficient_count(degree);
  std::vector<vec3> directions;
  std::vector<scene::RayQuery> beams;
  for (int q = 0; q < count; ++q) {
    directions.push_back(spherical_fibonacci(q, count));
    const Frame frame = Frame::around(directions.back());
    for (int r = 0; r < rays; ++r) {
      // Points of a Fibonacci spiral, uniform on the disc.
      const float distance = radius * std::sqrt((static_cast<float>(r) + 0.5f) / static_cast<float>(rays));
      const float angle = 2.3999632f * static_cast<float>(r);
      const vec3 offset = distance * (std::cos(angle) * frame.x + std::sin(angle) * frame.y);
      const float half_way = std::sqrt(std::max(radius * radius - distance * distance, 0.0f));
      beams.push_back({center + offset + half_way * frame.z, -frame.z, 2 * half_way});
    }
  }
  const std::vector<Sight> sights = d.network.look(beams);
  const DirectionProjector basis(degree, directions);
  std::vector<float> radiance(3 * basis.stride(), 0.0f);
  for (std::size_t q = 0; q < directions.size(); ++q) {
    vec3 mean(0);
    for (std::size_t r = q * static_cast<std::size_t>(rays); r < (q + 1) * static_cast<std::size_t>(rays);
         ++r) {
      const Sight& sight = sights[r];
      if (sight.group >= 0) mean += d.group_scale[static_cast<std::size_t>(sight.group)] * sight.emission;
      if (sight.surfel == no_surfel || d.direct.empty()) continue;
      const auto s = static_cast<std::size_t>(sight.surfel);
      mean += sight.albedo * (1 / pi) * vec3(d.direct[s] + d.indirect[s]);
    }
    mean /= static_cast<float>(rays);
    for (std::size_t c = 0; c < 3; ++c)
      radiance[c * basis.stride() + q] = mean[static_cast<glm::length_t>(c)];
  }
  sh::RadianceSh profile(degree);
  basis.project(radiance, profile);
  return profile;
}

const std::vector<Irradiance4>& RelightSession::surfel_irradiance() const {
  return data_->indirect;
}
const std::vector<Irradiance4>& RelightSession::surfel_direct() const {
  return data_->direct;
}
const TransportNetwork& RelightSession::network() const {
  return data_->network;
}

ProbeSet lookup_set(const std::vector<ProbePlace>& places, const std::vector<sh::RadianceSh>& reflected) {
  ProbeSet set;
  set.degree = reflected.front().degree();
  set.light_groups.push_back({"all"});
  for (std::size_t i = 0; i < places.size(); ++i) {
    Probe probe;
    probe.name = places[i].name;
    probe.position = places[i].position;
    probe.radius = places[i].radius;
    probe.groups.push_back({{}, reflected[i]});
    set.probes.push_back(std::move(probe));
  }
  merge_groups(set);
  return set;
}

}  // namespace ssphh::gi
