/// The light that a session keeps at surfaces.

#include "relight_data.h"

namespace ssphh::transport {
namespace {

/// Factors that make each group's direct light as bright as another's.
std::vector<vec3> alike(std::span<const std::vector<Irradiance4>> by_group) {
  std::vector<vec3> scales;
  for (const std::vector<Irradiance4>& group : by_group) {
    double all = 0;
    for (const Irradiance4& e : group) all += static_cast<double>(luminance(vec3(e)));
    scales.emplace_back(all > 0 ? static_cast<float>(static_cast<double>(group.size()) / all) : 0.0f);
  }
  return scales;
}

}  // namespace

void RelightSession::Data::find_direct_for_records() {
  if (unfinished) group_dirty.assign(group_dirty.size(), true);
  if (any_group_dirty() || !direct_light) {
    source.renew_direct_light(direct_light, state.lights, network.poses(), state.environment());
    require(direct_light != nullptr, "transport source", "it gives no direct light");
  }
  mark_panes();
  for (std::size_t g = 0; g < group_dirty.size(); ++g) {
    if (group_dirty[g]) field.update_all(static_cast<int>(g), *direct_light);
    group_dirty[g] = false;
  }
}

std::vector<float> RelightSession::Data::record_times() const {
  std::vector<float> times = {state.time};
  const int poses = params.records.poses;
  for (int i = 0; poses > 1 && i < poses && source.part_count() > 1 && source.duration() > 0; ++i) {
    const float time = source.duration() * static_cast<float>(i) / static_cast<float>(poses - 1);
    if (time != times[0]) times.push_back(time);
  }
  return times;
}

void RelightSession::Data::put_into_pose(float time, const Control& control) {
  if (time == state.time) return;
  state.time = time;
  moved.clear();
  RelightReport unread;
  Pace pace(control);
  for (stage = Stage::place; stage != Stage::emission; done = 0) step(unread, control, pace);
  stage = Stage::idle;
}

PosedIrradiance RelightSession::Data::light_alike() const {
  PosedIrradiance light_now{direct_by_group(), {}, {}};
  const std::vector<vec3> scales = alike(light_now.direct);
  std::vector<Irradiance4> sum(network.patch_count(), Irradiance4(0));
  for (std::size_t g = 0; g < scales.size(); ++g) {
    if (scales[g].x == 0) continue;
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += scales[g].x * light_now.direct[g][p];
  }
  Solver().solve(network.links(), network.albedo(), sum, chebyshev_bound(network.contraction()), params.solve,
                 light_now.reflected);
  light_now.lit = total(sum, light_now.reflected);
  return light_now;
}

void RelightSession::Data::check_records(const GatherParams& asked) const {
  if (asked.points < 0 || static_cast<std::size_t>(asked.points) > most_records)
    throw Error("surface records",
                fmt::format("{} points, at most {} can be kept", asked.points, most_records));
  if (asked.points > 0 && (asked.rays < 4 || asked.rays > 1 << 16))
    throw Error("gather rays", fmt::format("{} is outside 4..65536", asked.rays));
  for (const int baked : asked.baked) check_group(baked);
}

void RelightSession::Data::keep_records(const Control& control) {
  gather.reset();
  light.records.clear();
  record_direct = RecordDirect(params.records.baked);
  direct_held.clear();
  if (params.records.points == 0) return;
  find_direct_for_records();
  const std::vector<vec3> scales = alike(direct_by_group());
  const auto extend = [&](std::span<const rays::SurfacePoint> points) {
    record_direct.extend(*direct_light, points, params.records.rays, control);
  };
  AddRecordLight add_direct;
  RecordDirect by_panes = records_by_panes(*direct_light, state.group_scales.size());
  if (!params.records.baked.empty() || !by_panes.groups().empty()) {
    add_direct = [&](std::span<const rays::SurfacePoint> points, auto& to) {
      extend(points);
      record_direct.add_to(to, scales);
      by_panes.extend(*direct_light, points, params.records.rays, control);
      by_panes.add_to(to, scales);
    };
  }
  const std::vector<float> times = record_times();
  const auto light_at = [&](float time) {
    put_into_pose(time, control);
    return light_alike();
  };
  try {
    std::unique_ptr<SurfaceGather> made =
        gather_where_needed(network, params.records, times, light_at, control, add_direct);
    put_into_pose(times[0], control);
    if (times.size() > 1) made->update_pose();
    gather = std::move(made);
  } catch (...) {
    state.time = times[0];
    stage = Stage::idle;
    unfinished = true;
    throw;
  }
  network.data_->kept.set_records(gather->moving_rays());
  extend(gather->points());
  light_by_panes(control);
  direct_state = state;
  note_direct_held();
}

void RelightSession::Data::light_by_panes(const Control& control) {
  pane_light.mark_all();
  done = 0;
  Pace pace(control);
  find_pane_light(pace, control);
  done = 0;
}

void RelightSession::Data::keep_records_at(std::vector<rays::SurfacePoint> points, const Control& control) {
  record_direct = RecordDirect(params.records.baked);
  find_direct_for_records();
  gather = std::make_unique<SurfaceGather>(network, std::move(points), params.records.rays, direct_by_group(),
                                           control);
  network.data_->kept.set_records(gather->moving_rays());
  record_direct.extend(*direct_light, gather->points(), params.records.rays, control);
  light_by_panes(control);
  direct_state = state;
  note_direct_held();
}

void RelightSession::Data::light_records() {
  if (!gather || light.reflected.empty()) return;
  if (bounce) {
    if (!params.warm_start) light.indirect.clear();
    solver.solve(network.links(), network.albedo(), light.direct, chebyshev_bound(network.contraction()),
                 params.solve, light.indirect);
  }
  gather->light(total(light.direct, light.indirect), light.records);
  pane_light.add_to(light.records, state.group_scales);
}

}  // namespace ssphh::transport
