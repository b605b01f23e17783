#include "relight_data.h"

namespace ssphh::gi {

RelightSession::RelightSession(const scene::TransportSource& source, std::vector<ProbePlace> places,
                               const RelightParams& params, float time, const Control& control)
    : data_(std::make_unique<Data>(source, std::move(places), params, time, control)) {}

RelightSession::~RelightSession() = default;

void RelightSession::set_light(int light, const scene::LightState& state) {
  Data& d = *data_;
  d.check_light(light);
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
  data_->check_light(light);
  return data_->lights[static_cast<std::size_t>(light)];
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
  d.check_probe(probe);
  if (!leaving.empty()) {
    sh::require_degree(leaving.degree(), "emission");
    require(static_cast<std::size_t>(sh::coefficient_count(leaving.degree())) == leaving.values.size(),
            "emission", "its coefficients are not those of a degree");
  }
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
  if (d.unfinished) d.forget_everything();
  const bool posed = d.unfinished || d.pending_time != d.network.time();
  if (!first && !posed && !d.any_group_dirty() && !d.scale_dirty && !d.emission_dirty) return report;

  d.unfinished = true;
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
  d.unfinished = false;
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
  d.check_probe(probe);
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

const std::vector<Irradiance4>& RelightSession::surfel_irradiance() const {
  return data_->indirect;
}
const std::vector<Irradiance4>& RelightSession::surfel_direct() const {
  return data_->direct;
}
const TransportNetwork& RelightSession::network() const {
  return data_->network;
}

}  // namespace ssphh::gi
