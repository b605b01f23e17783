#include "relight_data.h"

namespace ssphh::transport {

RelightSession::RelightSession(const rays::TransportSource& source, std::vector<scene::ProbePlace> places,
                               const RelightParams& params, float time, const Control& control)
    : data_(std::make_unique<Data>(source, std::move(places), params, time, control)) {}

RelightSession::~RelightSession() = default;

RelightSession::RelightSession(RelightSession&&) noexcept = default;
RelightSession& RelightSession::operator=(RelightSession&&) noexcept = default;

RelightReport RelightSession::update(const scene::LightingState& state, const Control& control,
                                     double budget_ms) {
  Data& d = *data_;
  scene::check_lighting(state, {d.state.lights.size(), d.state.group_scales.size(), d.places.size()});
  require(budget_ms >= 0, "update", "its budget must be milliseconds from 0 on");
  d.clock.call();
  d.given = state;
  d.changed.assign(d.places.size(), 0);
  d.changed_probes.clear();
  RelightReport report;
  Pace pace(control, budget_ms);
  // What was begun comes first; if this call asks for it again, it is as young as this call.
  if (d.stage != Data::Stage::idle && state == d.state) d.clock.pass = d.clock.last;
  report.finished = d.go_on(report, control, pace);
  if (report.finished && d.begin(state)) report.finished = !pace.over() && d.go_on(report, control, pace);
  if (!d.light.reflected.empty() && state == d.shown) d.clock.shown = d.clock.last;
  for (std::size_t i = 0; i < d.changed.size(); ++i) {
    if (d.changed[i]) d.changed_probes.push_back(static_cast<int>(i));
  }
  report.changed_probes = d.changed_probes;
  report.age = d.clock.age();
  return report;
}

const scene::LightingState& RelightSession::lighting() const {
  return data_->given;
}
const scene::LightingState& RelightSession::shown() const {
  return data_->shown;
}
LightAge RelightSession::age() const {
  return data_->clock.age();
}
bool RelightSession::under_way() const {
  return data_->stage != Data::Stage::idle;
}
const std::vector<scene::ProbePlace>& RelightSession::places() const {
  return data_->places;
}
const std::vector<sh::RadianceSh>& RelightSession::reflected() const {
  return data_->light.reflected;
}

sh::RadianceSh RelightSession::emitted(int probe) const {
  const Data& d = data_->settled();
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
  return data_->settled().direct_by_group();
}

std::vector<std::vector<sh::RadianceSh>> RelightSession::reflected_by_group(const Control& control,
                                                                            SolveReport* slowest) const {
  const Data& d = data_->settled();
  SolveReport most;
  const std::vector<std::vector<Irradiance4>> direct = direct_by_group();
  const std::size_t groups = direct.size();
  std::vector<std::vector<sh::RadianceSh>> result(groups);
  ProgressStage progress(control, "solving", groups, "light groups");
  for (std::size_t g = 0; g < groups; ++g) {
    control.check();
    SolveReport solve;
    result[g] = d.reflected_under(direct[g], solve);
    if (!d.bounce) d.pane_light.add_to(g, vec3(1), result[g]);
    const auto slowness = [](const SolveReport& r) { return std::pair(!r.converged, r.iterations); };
    if (slowness(solve) > slowness(most)) most = solve;
    progress.advance(1);
  }
  if (slowest) *slowest = most;
  return result;
}

std::vector<std::vector<sh::RadianceSh>> RelightSession::emitted_by_group() const {
  const Data& d = data_->settled();
  std::vector<std::vector<sh::RadianceSh>> result(d.state.group_scales.size());
  for (std::size_t i = 0; i < d.places.size(); ++i) {
    const std::vector<sh::RadianceSh> groups = d.emitted(i);
    for (std::size_t g = 0; g < groups.size(); ++g) result[g].push_back(groups[g]);
  }
  return result;
}

void RelightSession::keep_records(const GatherParams& params, const Control& control) {
  Data& d = data_->settled();
  d.check_records(params);
  d.params.records = params;
  d.keep_records(control);
  d.light_records();
}

void RelightSession::keep_records_at(std::vector<rays::SurfacePoint> points, const GatherParams& params,
                                     const Control& control) {
  Data& d = data_->settled();
  GatherParams checked = params;
  checked.points = static_cast<int>(std::min(points.size(), most_records + 1));
  d.check_records(checked);
  for (const rays::SurfacePoint& point : points)
    require(is_finite(point.position) && is_finite(point.normal), "surface records",
            "a point is not a finite number");
  d.params.records = params;
  d.keep_records_at(std::move(points), control);
  d.light_records();
}

const SurfaceGather* RelightSession::gather() const {
  return data_->gather.get();
}
const std::vector<probes::RecordLight>& RelightSession::record_light() const {
  return data_->light.records;
}

probes::SurfaceRecords RelightSession::records_by_group(const Control& control) const {
  const Data& d = data_->settled();
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
    std::vector<vec3> alone(by_group.size(), vec3(0));
    alone[g] = vec3(1);
    d.pane_light.add_to(light, alone);
    records.groups.push_back(packed(light));
  }
  const std::vector<int>& direct = d.record_direct.groups();
  if (!direct.empty()) records.direct.resize(by_group.size());
  for (std::size_t k = 0; k < direct.size(); ++k)
    records.direct[direct[k]] = packed(d.record_direct.found(k));
  probes::merge_groups(records, d.state.group_scales);
  return records;
}

const std::vector<std::string>& RelightSession::light_groups() const {
  return data_->source.light_groups();
}

std::size_t RelightSession::kept_direct_count() const {
  const Data& d = *data_;
  return d.gather ? d.record_direct.groups().size() : 0;
}

KeptDirect RelightSession::kept_direct(std::size_t i) const {
  require(i < kept_direct_count(), "surface records", "they keep direct light of no such group");
  const Data& d = *data_;
  return {d.record_direct.groups()[i], d.record_direct.found(i), d.direct_held[i] != 0};
}

sh::RadianceSh RelightSession::arriving(int group, int probe) const {
  const Data& d = data_->settled();
  d.check_probe(probe);
  d.check_group(group);
  require(d.direct_light != nullptr, "relighting", "all is dark before the first update");
  return project_arriving(d.direct_light->arriving(group, d.places[probe].position, arriving_samples),
                          d.params.degree);
}

vec3 RelightSession::mirrored(const rays::SurfacePoint& at) const {
  const Data& d = data_->settled();
  vec3 sum(0), found;
  if (!d.direct_light || !d.direct_light->mirrors()) return sum;
  for (std::size_t g = 0; g < d.shown.group_scales.size(); ++g) {
    d.direct_light->mirrored(static_cast<int>(g), {&at, 1}, {&found, 1});
    sum += d.shown.group_scales[g] * found;
  }
  return sum;
}

vec3 RelightSession::kept_direct(const rays::SurfacePoint& at) const {
  constexpr int samples = 64;
  const Data& d = data_->settled();
  vec3 sum(0);
  if (!d.direct_light || !d.gather) return sum;
  for (const int g : d.record_direct.groups()) {
    const rays::IrradianceByNormal found = d.direct_light->irradiance_by_normal(g, at, samples);
    sum += d.shown.group_scales[g] * glm::max(found * vec4(at.normal, 1), vec3(0));
  }
  return sum;
}

const std::vector<Irradiance4>& RelightSession::surfel_irradiance() const {
  return data_->light.indirect;
}
const std::vector<Irradiance4>& RelightSession::patch_direct() const {
  return data_->light.direct;
}
std::vector<Irradiance4> RelightSession::patch_irradiance() const {
  return total(data_->light.direct, data_->light.indirect);
}
const TransportNetwork& RelightSession::network() const {
  return data_->network;
}

}  // namespace ssphh::transport
