#include <algorithm>

#include <fmt/format.h>

#include <ssphh/place/sweep.h>

#include "checks.h"

namespace ssphh::study {
namespace {

bool finite(const sh::RadianceSh& function) {
  return std::ranges::all_of(function.values, is_finite);
}

bool finite(const probes::Probe& probe) {
  bool ok = is_finite(probe.position) && std::isfinite(probe.radius);
  for (const probes::GroupLight& light : probe.groups)
    ok = ok && finite(light.emitted) && finite(light.reflected);
  for (const probes::Edge& edge : probe.edges) ok = ok && std::isfinite(edge.transfer) && finite(edge.h);
  return ok;
}

}  // namespace

void check_places(const LintContext& context, std::vector<LintProblem>& problems) {
  const place::Sweep sweep(context.source, context.rules.clearance);
  std::vector<vec3> positions;
  for (const probes::Probe& probe : context.set.probes) {
    positions.push_back(is_finite(probe.position) ? probe.position : vec3(0));
  }
  const std::vector<place::Site> sites =
      place::look_around(context.source, positions, place::fan_size, context.control);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const probes::Probe& probe = context.set.probes[i];
    const auto report = [&](ProbeProblem kind, std::string message) {
      problems.push_back({kind, static_cast<int>(i), positions[i], std::move(message)});
    };
    if (!finite(probe)) {
      report(ProbeProblem::not_finite, "holds a number that is not finite; bake it again");
      continue;
    }
    if (place::inside_body(sites[i], context.rules)) {
      report(ProbeProblem::inside,
             fmt::format("lies inside a body: {:.0f} % of the surfaces it sees show their backs; move it out",
                         100 * sites[i].back));
    } else if (sites[i].nearest < context.rules.clearance) {
      report(ProbeProblem::too_close, fmt::format("is {:.3g} m from a surface; move it to at least {:.3g} m",
                                                  sites[i].nearest, context.rules.clearance));
    }
    if (const std::string* part = sweep.passes(positions[i], context.rules.clearance)) {
      report(ProbeProblem::swept,
             fmt::format("stands in the way of \"{}\" at some time; move it out of its way", *part));
    }
  }
}

}  // namespace ssphh::study
