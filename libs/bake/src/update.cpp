#include <algorithm>
#include <cmath>

#include <ssphh/bake/gen.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>

namespace ssphh::bake {
namespace {

/// The two halves of a trial have random numbers of their own, other than GEN's and VIZ's.
constexpr std::uint64_t trial_salt = 0x747269616cull;

/// Half a trial: half the face and a sixteenth of the samples, where there are as many.
rays::CubeRequest half_trial(const probes::GeneratorInfo& g, const vec3& position, std::size_t probe,
                             int half) {
  const std::int64_t samples = std::int64_t{g.spp} * g.passes;
  rays::CubeRequest request;
  request.position = position;
  request.face_size = std::max(1, g.face_size / (samples >= 16 ? 2 : 4));
  request.path = {g.max_depth, 1, static_cast<int>(std::clamp<std::int64_t>(samples / 16, 1, 1 << 24)),
                  hash_combine(hash_combine(g.seed, trial_salt),
                               2 * static_cast<std::uint64_t>(probe) + static_cast<std::uint64_t>(half))};
  return request;
}

double paths_of(int face_size, double samples) {
  return 6.0 * face_size * face_size * samples;
}

/// Of two functions, coefficient by coefficient.
class Difference {
 public:
  Difference(const sh::RadianceSh& a, const sh::RadianceSh& b) {
    for (std::size_t k = 0; k < a.values.size(); ++k)
      values_.push_back(glm::dvec3(b.values[k]) - glm::dvec3(a.values[k]));
  }
  friend double product(const Difference& a, const Difference& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.values_.size(); ++k) sum += glm::dot(a.values_[k], b.values_[k]);
    return sum;
  }

 private:
  std::vector<glm::dvec3> values_;
};

/// Square of the light's norm: of the mean of both halves.
double power(const probes::Trial& trial) {
  double sum = 0;
  for (std::size_t g = 0; g < trial.halves[0].size(); ++g) {
    const sh::RadianceSh &a = trial.halves[0][g], &b = trial.halves[1][g];
    for (std::size_t k = 0; k < a.values.size(); ++k) {
      const glm::dvec3 mean = 0.5 * (glm::dvec3(a.values[k]) + glm::dvec3(b.values[k]));
      sum += glm::dot(mean, mean);
    }
  }
  return sum;
}

float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

probes::Trial trial(const rays::RadianceSource& source, const probes::ProbeSet& set, std::size_t probe,
                    const Control& control) {
  require(probe < set.probes.size(), "trial", "there is no probe of that index");
  probes::Trial result;
  for (int half = 0; half < 2; ++half) {
    const rays::CubeRequest request = half_trial(set.generator, set.probes[probe].position, probe, half);
    for (const probes::GroupLight& light : gen(source, request, probes::trial_degree, control)) {
      sh::RadianceSh& sum = result.halves[half].emplace_back(light.reflected);
      if (!light.emitted.empty()) sum += light.emitted;
    }
  }
  return result;
}

float bake_noise(const probes::Trial& trial, const probes::GeneratorInfo& g) {
  double spread2 = 0;
  for (std::size_t i = 0; i < trial.halves[0].size(); ++i) {
    const Difference d(trial.halves[0][i], trial.halves[1][i]);
    spread2 += product(d, d) / 4;
  }
  const rays::CubeRequest half = half_trial(g, vec3(0), 0, 0);
  const double share = 2 * paths_of(half.face_size, half.path.spp) /
                       paths_of(g.face_size, static_cast<double>(g.spp) * g.passes);
  const double light2 = power(trial);
  return light2 > 0 ? static_cast<float>(std::sqrt(spread2 * share / light2)) : 0;
}

float changed_share(const probes::Trial& before, const probes::Trial& now) {
  require(before.halves[0].size() == now.halves[0].size(), "trial",
          "it is of another number of light groups");
  double change2 = 0;
  for (std::size_t g = 0; g < now.halves[0].size(); ++g) {
    change2 += product(Difference(before.halves[0][g], now.halves[0][g]),
                       Difference(before.halves[1][g], now.halves[1][g]));
  }
  const double brighter2 = std::max(power(before), power(now));
  return brighter2 > 0 ? static_cast<float>(std::sqrt(std::max(change2, 0.0) / brighter2)) : 0;
}

std::vector<probes::Trial> make_trials(const rays::RadianceSource& source, const probes::ProbeSet& set,
                                       const Control& control) {
  std::vector<probes::Trial> trials;
  ProgressStage progress(control, "trials", set.probes.size(), "probes");
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    control.check();
    trials.push_back(trial(source, set, i, {nullptr, control.cancel}));
    progress.advance(1);
  }
  return trials;
}

UpdatePlan plan_update(const rays::RadianceSource& source, const probes::ProbeSet& set,
                       std::optional<float> tolerance, const LightScope& scope, const Control& control) {
  if (!set.baseline || set.baseline->trials.size() != set.probes.size())
    throw Error("update", "the probes were baked without a baseline to compare with", "bake them in full");
  if (tolerance && !(*tolerance >= 0))
    throw Error("tolerance", "it must be a share of a probe's light, 0 or more");
  require(std::ranges::equal(set.light_groups, source.light_groups(), {}, &probes::LightGroup::name),
          "update", "the set is of other light groups than the scene");
  scope.require_within(set.probes.size(), set.light_groups.size());
  const Stopwatch watch;
  UpdatePlan plan;
  std::vector<float> noise;
  ProgressStage progress(control, "comparing", set.probes.size(), "probes");
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    control.check();
    const probes::Trial& before = set.baseline->trials[i];
    probes::Trial& now = plan.trials.emplace_back(before);
    if (scope.has_probe(i)) {
      now = trial(source, set, i, {nullptr, control.cancel});
      noise.push_back(bake_noise(now, set.generator));
      for (std::size_t half = 0; half < 2; ++half) {
        for (std::size_t g = 0; g < set.light_groups.size(); ++g)
          if (!scope.has_group(g)) now.halves[half][g] = before.halves[half][g];
      }
    }
    plan.changed.push_back(changed_share(before, now));
    progress.advance(1);
  }
  plan.noise = median(std::move(noise));
  plan.tolerance = tolerance.value_or(std::max(usual_tolerance, plan.noise));
  for (std::size_t i = 0; i < plan.changed.size(); ++i) {
    const bool strict = plan.tolerance == 0 && plan.trials[i] != set.baseline->trials[i];
    if (scope.probes ? scope.has_probe(i) : strict || plan.changed[i] > plan.tolerance)
      plan.probes.push_back(static_cast<std::uint32_t>(i));
  }
  plan.seconds = watch.seconds();
  return plan;
}

void adopt_groups(probes::ProbeSet& set, std::span<const std::string> groups) {
  if (std::ranges::equal(set.light_groups, groups, {}, &probes::LightGroup::name)) return;
  std::vector<std::optional<std::size_t>> source_of;
  std::vector<probes::LightGroup> adopted;
  for (const std::string& name : groups) {
    const auto found = std::ranges::find(set.light_groups, name, &probes::LightGroup::name);
    const bool known = found != set.light_groups.end();
    source_of.push_back(known ? std::optional(static_cast<std::size_t>(found - set.light_groups.begin()))
                              : std::nullopt);
    adopted.push_back(known ? *found : probes::LightGroup{name, vec3(1)});
  }
  const auto rearrange = [&](auto& of_groups, const auto& dark) {
    std::remove_reference_t<decltype(of_groups)> result;
    for (const std::optional<std::size_t>& from : source_of) result.push_back(from ? of_groups[*from] : dark);
    of_groups = std::move(result);
  };
  for (probes::Probe& probe : set.probes)
    rearrange(probe.groups, probes::GroupLight{{}, sh::RadianceSh(set.degree)});
  if (set.surface) {
    rearrange(set.surface->groups, std::vector<probes::PackedRecordLight>(set.surface->points.size()));
    set.surface->direct.resize(set.light_groups.size());
    rearrange(set.surface->direct, std::vector<probes::PackedRecordLight>());
    if (std::ranges::all_of(set.surface->direct, &std::vector<probes::PackedRecordLight>::empty))
      set.surface->direct.clear();
  }
  if (set.baseline) {
    for (probes::Trial& trial : set.baseline->trials) {
      for (std::vector<sh::RadianceSh>& half : trial.halves)
        rearrange(half, sh::RadianceSh(probes::trial_degree));
    }
  }
  set.light_groups = std::move(adopted);
  set.hierarchy.reset();
}

void renew_trials(probes::ProbeSet& set, const UpdatePlan& plan) {
  require(set.baseline && set.baseline->trials.size() == plan.trials.size(), "update",
          "the plan is of other probes");
  for (const std::uint32_t i : plan.probes)
    require(i < plan.trials.size(), "update", "the plan is of other probes");
  for (const std::uint32_t i : plan.probes) set.baseline->trials[i] = plan.trials[i];
}

}  // namespace ssphh::bake
