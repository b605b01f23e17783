#include "commands/relight_check.h"

#include <algorithm>

#include <ssphh/core/log.h>
#include <ssphh/study/lint.h>

namespace ssphh::app {

void warn_about_places(const std::vector<transport::ProbePlace>& places, const rays::TransportSource& source,
                       const std::vector<vec3>& interest, bool parts_move, const Control& control) {
  probes::ProbeSet set;
  for (const transport::ProbePlace& place : places) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = place.name;
    probe.position = place.position;
    probe.radius = place.radius;
  }
  study::LintParams params;
  params.interest = interest;
  for (const study::LintProblem& problem : study::lint_places(set, source, params, control)) {
    const bool swept = problem.kind == study::ProbeProblem::swept;
    if (problem.kind != study::ProbeProblem::inside && !(swept && parts_move)) continue;
    log_warning("probe \"{}\" {}", set.probes[static_cast<std::size_t>(problem.probe)].name, problem.message);
  }
}

void warn_about_network(const transport::RelightSession& session) {
  const transport::TransportNetwork& network = session.network();
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
