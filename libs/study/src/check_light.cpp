#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

#include "checks.h"

namespace ssphh::study {
namespace {

/// All lamps switched on as they were baked: a lamp that is dimmed to 0 is no fault of the probe.
bool unlit(const probes::Probe& probe) {
  return std::ranges::all_of(probe.groups, [](const probes::GroupLight& light) {
    const bool dark_emitters = light.emitted.empty() || sh::mean(light.emitted) == vec3(0);
    return dark_emitters && (light.reflected.empty() || sh::mean(light.reflected) == vec3(0));
  });
}

/// Lowest E(n) over the mean of E, of the worst channel; 0 for a dark probe.
float lowest_share(const sh::RadianceSh& light) {
  const vec3 mean = pi * sh::mean(light);
  const vec3 lowest = sh::minimum(sh::irradiance_from_radiance(light));
  float worst = 0;
  for (int c = 0; c < 3; ++c) {
    if (mean[c] > 0) worst = std::min(worst, lowest[c] / mean[c]);
  }
  return worst;
}

bool usable(const probes::Probe& probe) {
  return !probe.reflected.empty() && std::ranges::all_of(probe.reflected.values, is_finite);
}

}  // namespace

void check_light(const LintContext& context, const std::vector<int>& rooms,
                 std::vector<LintProblem>& problems) {
  const std::vector<probes::Probe>& probes = context.set.probes;

  // A room of which all probes are unlit is one problem.
  std::map<int, std::vector<std::size_t>> by_room;
  for (std::size_t i = 0; i < probes.size(); ++i) by_room[rooms[i]].push_back(i);
  for (const auto& [room, members] : by_room) {
    const bool dark = std::ranges::all_of(members, [&](std::size_t i) { return unlit(probes[i]); });
    if (dark && members.size() > 1) {
      problems.push_back(
          {ProbeProblem::unlit_room, -1, probes[members[0]].position,
           fmt::format("{} probes around \"{}\" see each other and no light at all at {:g} s; put a lamp "
                       "there, bake with the door open, or leave the probes out",
                       members.size(), probes[members[0]].name, context.set.generator.time)});
      continue;
    }
    for (const std::size_t i : members) {
      if (!unlit(probes[i])) continue;
      problems.push_back({ProbeProblem::unlit, static_cast<int>(i), probes[i].position,
                          "receives no light; light its surroundings, bake with more depth or samples, or "
                          "remove it"});
    }
  }

  // What surfaces look up must not be far under zero for any normal.
  std::vector<float> share(probes.size(), 0);
  parallel_for(
      probes.size(), 1,
      [&](std::size_t i) {
        if (usable(probes[i])) share[i] = lowest_share(probes[i].reflected);
      },
      context.control);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (-share[i] <= context.params.negative_tolerance) continue;
    problems.push_back({ProbeProblem::negative, static_cast<int>(i), probes[i].position,
                        fmt::format("gives an irradiance of down to {:.0f} % of its mean; bake with more "
                                    "samples, move it away from what is brightly lit, or window it",
                                    100 * share[i])});
  }
}

}  // namespace ssphh::study
