#include "commands/relight_check.h"

#include <algorithm>

#include <ssphh/core/log.h>
#include <ssphh/gi/lint.h>

namespace ssphh::app {

void warn_about_places(const std::vector<gi::ProbePlace>& places, const scene::TransportSource& source,
                       const std::vector<vec3>& interest, bool parts_move, const Control& control) {
  gi::ProbeSet set;
  for (const gi::ProbePlace& place : places) {
    gi::Probe& probe = set.probes.emplace_back();
    probe.name = place.name;
    probe.position = place.position;
    probe.radius = place.radius;
  }
  gi::LintParams params;
  params.interest = interest;
  for (const gi::LintProblem& problem : gi::lint_places(set, source, params, control)) {
    const bool swept = problem.kind == gi::ProbeProblem::swept;
    if (problem.kind != gi::ProbeProblem::inside && !(swept && parts_move)) continue;
    log_warning("probe \"{}\" {}", set.probes[static_cast<std::size_t>(problem.probe)].name, problem.message);
  }
}

void warn_about_network(const gi::RelightSession& session) {
  const gi::TransportNetwork& network = session.network();
  const auto directions = static_cast<std::ptrdiff_t>(network.gbuffer().directions.size());
  for (std::size_t i = 0; i < session.places().size(); ++i) {
    const auto begin = network.seen().begin() + static_cast<std::ptrdiff_t>(i) * directions;
    if (std::all_of(begin, begin + directions, [](const auto& patch) { return patch.surfel < 0; }))
      log_warning("probe \"{}\" sees no surface: it holds no light", session.places()[i].name);
  }
  if (network.links().link_count() == 0)
    log_warning("no surface sees another: there is no light from surface to surface, only to the probes");
}

}  // namespace ssphh::app
