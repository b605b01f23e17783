/// What an update does, in pieces.

#include <ssphh/core/stopwatch.h>

#include "relight_data.h"

namespace ssphh::transport {
namespace {

// Of a stage that has little time: what the first piece takes.
constexpr std::size_t least_samples = 128, least_probes = 8, least_records = 512, least_pose_rays = 256;

/// Runs `body`, adds its time and rays; returns what it does.
template <class Body>
bool measure(const rays::TransportSource& source, double& ms, std::uint64_t* rays, const Body& body) {
  const Stopwatch watch;
  const std::uint64_t before = source.rays_traced();
  const bool done = body();
  if (rays) *rays += source.rays_traced() - before;
  ms += watch.milliseconds();
  return done;
}

SolveReport summary(const BounceReport& report) {
  return {.iterations = report.iterations, .residual = 0, .converged = report.converged};
}

}  // namespace

bool RelightSession::Data::begin(const scene::LightingState& wanted) {
  note_changes(wanted);
  const bool posed = unfinished || wanted.time != network.time();
  if (!light.reflected.empty() && !posed && !any_group_dirty() && !scale_dirty && !emission_dirty)
    return false;
  unfinished = true;
  state = wanted;
  clock.pass = clock.last;
  moved.clear();
  stage = posed ? Stage::place : Stage::lamps;
  done = 0;
  return true;
}

bool RelightSession::Data::go_on(RelightReport& report, const Control& control, Pace& pace) {
  try {
    while (stage != Stage::idle) {
      control.check();
      if (!step(report, control, pace)) return false;
      done = 0;
      if (stage != Stage::idle && pace.over()) return false;
    }
  } catch (...) {
    stage = Stage::idle;  // and still unfinished
    throw;
  }
  return true;
}

/// A stage, or as much of it as there is time for; true: it is done and the next one is to come.
bool RelightSession::Data::step(RelightReport& report, const Control& control, Pace& pace) {
  switch (stage) {
    case Stage::idle:
      return true;
    case Stage::place:
    case Stage::pose:
    case Stage::pose_records:
      return measure(source, report.pose_ms, &report.pose_rays, [&] { return pose(report, pace); });
    case Stage::lamps:
    case Stage::direct:
    case Stage::emission:
    case Stage::panes:
      return measure(source, report.direct_ms, &report.direct_rays,
                     [&] { return find_direct(pace, control); });
    case Stage::solve:
      return measure(source, report.solve_ms, nullptr, [&] { return solve(report, control, pace); });
    case Stage::project:
    case Stage::records:
      return measure(source, report.project_ms, nullptr, [&] { return project(pace); });
  }
  return true;
}

/// Poses the parts; keeps the world bounds that they leave and enter in `moved`.
bool RelightSession::Data::pose(RelightReport& report, Pace& pace) {
  const auto parts = static_cast<std::size_t>(source.part_count());
  if (stage == Stage::place) {
    old_poses = network.poses();
    old_bounds.clear();
    for (std::size_t p = 0; p < parts; ++p)
      old_bounds.push_back(network.part_world_bounds(static_cast<int>(p)));
    network.data_->pose_work.step = PoseWork::Step::parts;
    stage = Stage::pose;
  }
  if (stage == Stage::pose) {
    if (!network.data_->go_on_to(state.time, params.poses != 0, pace)) return false;
    report.hits_changed = network.data_->pose_work.report.hits_changed;
    if (bounce) bounce->update_pose();
    stage = Stage::pose_records;
    return true;
  }
  if (gather && !pose_gather(pace)) return false;
  for (std::size_t p = 1; p < parts; ++p) {
    if (network.poses()[p] == old_poses[p]) continue;
    moved.push_back(old_bounds[p]);
    moved.push_back(network.part_world_bounds(static_cast<int>(p)));
    for (std::size_t g = 0; g < group_dirty.size(); ++g) {
      if (source.group_emits_from(static_cast<int>(g), static_cast<int>(p))) group_dirty[g] = true;
    }
  }
  stage = Stage::lamps;
  return true;
}

bool RelightSession::Data::pose_gather(Pace& pace) {
  KeptPoses& kept = network.data_->kept;
  if (kept.has_current() && kept.has_records()) {
    gather->set_patches(kept.current().records);
    return true;
  }
  if (!pace.go_on(done, gather->moving_rays(), least_pose_rays,
                  [&](std::size_t begin, std::size_t end) { gather->update_pose(begin, end); }))
    return false;
  if (kept.has_current()) {
    gather->get_patches(kept.current().records);
    kept.note_records();
  }
  return true;
}

bool RelightSession::Data::find_direct(Pace& pace, const Control& control) {
  if (stage == Stage::lamps) {
    if (any_group_dirty() || !moved.empty() || !direct_light) {
      source.renew_direct_light(direct_light, state.lights, network.poses(), state.environment());
      require(direct_light != nullptr, "transport source", "it gives no direct light");
    }
    mark_panes();
    group = 0;
    is_chosen = false;
    stage = Stage::direct;
    return true;
  }
  if (stage == Stage::emission) {
    find_emission();
    field.sum(state.group_scales, emission, next.direct);
    stage = Stage::panes;
    return true;
  }
  if (stage == Stage::panes) {
    if (!find_pane_light(pace, control)) return false;
    stage = Stage::solve;
    is_begun = false;
    return true;
  }
  for (; group < group_dirty.size(); ++group) {
    const int g = static_cast<int>(group);
    if (!is_chosen) {
      if (!group_dirty[group] && moved.empty()) continue;
      chosen = group_dirty[group] ? field.choose_all(g) : field.choose_moved(g, *direct_light, moved);
      is_chosen = true;
    }
    if (!pace.go_on(done, chosen, least_samples,
                    [&](std::size_t begin, std::size_t end) { field.find(g, *direct_light, begin, end); }))
      return false;
    group_dirty[group] = false;
    is_chosen = false;
    done = 0;
  }
  stage = Stage::emission;
  return true;
}

void RelightSession::Data::mark_panes() {
  if (pane_light.empty()) pane_light.reset(*direct_light, group_dirty.size());
  for (std::size_t g = 0; g < group_dirty.size(); ++g) {
    if (group_dirty[g] || !moved.empty()) pane_light.mark(g);
  }
}

bool RelightSession::Data::find_pane_light(Pace& pace, const Control& control) {
  const std::vector<vec3>& positions = network.gbuffer().positions;
  PaneLight::Lit lit_by{positions, params.degree, {}, params.records.rays};
  if (gather) lit_by.records = gather->points();
  return pane_light.find(*direct_light, lit_by, done, pace, control);
}

void RelightSession::Data::find_emission() {
  if (emission_dirty) {
    for (SphlEmitter& emitter : emitters) emitter.leaving = {};
    for (const scene::SphlEmission& given_emission : state.emission)
      emitters[given_emission.probe].leaving = given_emission.leaving;
  }
  if (!emission_dirty && (moved.empty() || emission.empty())) return;
  emission.clear();
  for (const SphlEmitter& emitter : emitters) {
    if (emitter.leaving.empty()) continue;
    emission.resize(network.samples().size(), vec3(0));
    add_emission(network, source, emitter, emission);
  }
}

/// Lets the direct light bounce: next.indirect, or with bounce the probes themselves; records need both.
bool RelightSession::Data::solve(RelightReport& report, const Control& control, Pace& pace) {
  const bool first = light.reflected.empty();
  if (!is_begun) {
    if (bounce) {
      next.reflected = light.reflected;
      report.solve = summary(bounce->solve(next.direct, next.reflected,
                                           params.warm_start && !first && params.bounce.applications == 0));
    }
    next.indirect.clear();
    if (!bounce || gather) {
      if (params.warm_start) next.indirect = light.indirect;
      solver.begin(network.links(), network.albedo(), next.direct, chebyshev_bound(network.contraction()),
                   params.solve, next.indirect);
      is_begun = true;
    }
  }
  while (is_begun && !solver.iterate()) {
    control.check();
    if (pace.over()) return false;
  }
  if (!bounce) report.solve = solver.report();
  stage = Stage::project;
  return true;
}

bool RelightSession::Data::project(Pace& pace) {
  if (stage == Stage::project) {
    if (!bounce) {
      if (done == 0) {
        total(next.direct, next.indirect, lit);
        if (next.reflected.empty()) next.reflected.assign(places.size(), sh::RadianceSh(params.degree));
      }
      if (!pace.go_on(done, places.size(), least_probes, [&](std::size_t begin, std::size_t end) {
            project_reflected(network, projector, lit, begin, end, scratch, next.reflected);
          }))
        return false;
      for (std::size_t g = 0; g < group_dirty.size(); ++g)
        pane_light.add_to(g, state.group_scales[g], next.reflected);
    }
    stage = Stage::records;
    if (gather) return true;
  }
  if (gather) {
    if (done == 0) {
      total(next.direct, next.indirect, lit);
      radiosity.resize(lit.size());
      for (std::size_t s = 0; s < lit.size(); ++s) radiosity[s] = vec4(network.albedo()[s], 0) * lit[s];
      next.records.resize(gather->points().size());
    }
    if (!pace.go_on(done, next.records.size(), least_records, [&](std::size_t begin, std::size_t end) {
          gather->light(radiosity, begin, end, next.records);
        }))
      return false;
    pane_light.add_to(next.records, state.group_scales);
  }
  publish();
  return true;
}

void RelightSession::Data::publish() {
  const bool first = light.reflected.empty();
  changed.resize(places.size(), 0);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    if (first || differs(next.reflected[i], light.reflected[i], params.changed)) changed[i] = 1;
  }
  std::swap(light, next);
  shown = state;
  note_direct_held();
  clock.shown = clock.pass;
  stage = Stage::idle;
  emission_dirty = scale_dirty = unfinished = false;
}

}  // namespace ssphh::transport
