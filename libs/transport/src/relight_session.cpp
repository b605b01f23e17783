#include "relight_data.h"

namespace ssphh::transport {

RelightSession::RelightSession(const rays::TransportSource& source, std::vector<ProbePlace> places,
                               const RelightParams& params, float time, const Control& control)
    : data_(std::make_unique<Data>(source, std::move(places), params, time, control)) {}

RelightSession::~RelightSession() = default;

RelightSession::RelightSession(RelightSession&&) noexcept = default;
RelightSession& RelightSession::operator=(RelightSession&&) noexcept = default;

RelightReport RelightSession::update(const scene::LightingState& state, const Control& control) {
  Data& d = *data_;
  scene::check_lighting(state, {d.state.lights.size(), d.state.group_scales.size(), d.places.size()});
  RelightReport report;
  const bool first = d.reflected.empty();
  d.note_changes(state);
  const bool posed = d.unfinished || state.time != d.network.time();
  if (!first && !posed && !d.any_group_dirty() && !d.scale_dirty && !d.emission_dirty) return report;

  d.unfinished = true;
  d.state = state;
  std::vector<scene::Bounds> moved;
  control.check();
  if (posed) measure(d.source, report.pose_ms, &report.pose_rays, [&] { moved = d.move_parts(report); });
  control.check();
  measure(d.source, report.direct_ms, &report.direct_rays, [&] { d.update_direct(moved); });
  control.check();
  measure(d.source, report.solve_ms, nullptr, [&] { report.solve = d.solve(first); });
  measure(d.source, report.project_ms, nullptr, [&] {
    if (!d.bounce) {
      d.before.swap(d.reflected);
      project_reflected(d.network, d.projector, total(d.direct, d.indirect), d.reflected);
    }
    if (d.gather) d.gather->light(total(d.direct, d.indirect), d.record_light);
    for (std::size_t i = 0; i < d.reflected.size(); ++i) {
      if (first || differs(d.reflected[i], d.before[i], d.params.changed))
        report.changed_probes.push_back(static_cast<int>(i));
    }
  });
  d.unfinished = false;
  return report;
}

const scene::LightingState& RelightSession::lighting() const {
  return data_->state;
}
const std::vector<ProbePlace>& RelightSession::places() const {
  return data_->places;
}
const std::vector<sh::RadianceSh>& RelightSession::reflected() const {
  return data_->reflected;
}

sh::RadianceSh RelightSession::emitted(int probe) const {
  const Data& d = *data_;
  d.check_probe(probe);
  const auto i = static_cast<std::size_t>(probe);
  sh::RadianceSh sum(d.params.degree);
  if (!d.direct_light) return sum;
  std::vector<sh::RadianceSh> groups = d.emitted(i);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g] *= d.state.group_scales[g];
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
  return data_->direct_by_group();
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
  std::vector<std::vector<sh::RadianceSh>> result(d.state.group_scales.size());
  for (std::size_t i = 0; i < d.places.size(); ++i) {
    const std::vector<sh::RadianceSh> groups = d.emitted(i);
    for (std::size_t g = 0; g < groups.size(); ++g) result[g].push_back(groups[g]);
  }
  return result;
}

void RelightSession::keep_records(const GatherParams& params, const Control& control) {
  Data& d = *data_;
  d.params.records = params;
  d.keep_records(control);
  d.light_records();
}

void RelightSession::keep_records_at(std::vector<rays::SurfacePoint> points, const GatherParams& params,
                                     const Control& control) {
  Data& d = *data_;
  d.params.records = params;
  d.keep_records_at(std::move(points), control);
  d.light_records();
}

const SurfaceGather* RelightSession::gather() const {
  return data_->gather.get();
}
const std::vector<probes::RecordLight>& RelightSession::record_light() const {
  return data_->record_light;
}

probes::SurfaceRecords RelightSession::records_by_group(const Control& control) const {
  const Data& d = *data_;
  require(d.gather != nullptr, "surface records", "the session keeps none");
  probes::SurfaceRecords records;
  records.points = d.gather->points();
  std::vector<probes::RecordLight> light;
  const std::vector<std::vector<Irradiance4>> by_group = direct_by_group();
  const auto packed = [&](const std::vector<probes::RecordLight>& of_points) {
    std::vector<probes::PackedRecordLight> group;
    for (std::size_t i = 0; i < of_points.size(); ++i)
      group.push_back(probes::pack(of_points[i], records.points[i].normal));
    return group;
  };
  for (std::size_t g = 0; g < by_group.size(); ++g) {
    control.check();
    SolveReport report;
    d.gather->light(d.lit_under(by_group[g], report), light);
    records.groups.push_back(packed(light));
  }
  const std::vector<int>& direct = d.record_direct.groups();
  if (!direct.empty()) records.direct.resize(by_group.size());
  for (std::size_t k = 0; k < direct.size(); ++k)
    records.direct[static_cast<std::size_t>(direct[k])] = packed(d.record_direct.found(k));
  probes::merge_groups(records, d.state.group_scales);
  return records;
}

const std::vector<std::string>& RelightSession::light_groups() const {
  return data_->source.light_groups();
}

std::vector<KeptDirect> RelightSession::kept_direct() const {
  const Data& d = *data_;
  std::vector<KeptDirect> kept;
  if (!d.gather) return kept;
  for (std::size_t k = 0; k < d.record_direct.groups().size(); ++k) {
    const int group = d.record_direct.groups()[k];
    kept.push_back({group, d.record_direct.found(k), d.direct_holds(group)});
  }
  return kept;
}

sh::RadianceSh RelightSession::arriving(int group, int probe) const {
  const Data& d = *data_;
  d.check_probe(probe);
  require(d.direct_light != nullptr, "relighting", "all is dark before the first update");
  return project_arriving(
      d.direct_light->arriving(group, d.places[static_cast<std::size_t>(probe)].position, arriving_samples),
      d.params.degree);
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

}  // namespace ssphh::transport
