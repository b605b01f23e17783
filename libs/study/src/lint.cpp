#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "checks.h"

namespace ssphh::study {
namespace {

/// Median distance of a probe to its nearest neighbour; infinite for one probe.
float median_distance(const probes::ProbeSet& set) {
  std::vector<float> nearest(set.probes.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    for (std::size_t j = 0; j < set.probes.size(); ++j) {
      const float d = glm::distance(set.probes[i].position, set.probes[j].position);
      if (i != j && d > 0) nearest[i] = std::min(nearest[i], d);
    }
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

void check(const LintParams& p) {
  const auto fail = [](const char* what, float value) {
    throw Error("probe lint",
                fmt::format("the {} must be a number over or equal to 0, not {:g}", what, value));
  };
  if (!(p.clearance >= 0) || !std::isfinite(p.clearance)) fail("clearance", p.clearance);
  if (!(p.negative_tolerance >= 0)) fail("tolerance of negative irradiance", p.negative_tolerance);
  if (!(p.spacing >= 0) || !std::isfinite(p.spacing)) fail("spacing", p.spacing);
}

place::SiteRules rules_for(const probes::ProbeSet& set, const rays::TransportSource& source,
                           const LintParams& params) {
  place::SiteRules rules;
  rules.clearance = params.clearance > 0 ? params.clearance : std::min(0.04f, 0.05f * median_distance(set));
  rules.back_limit = place::calibrated_back_limit(source, params.interest);
  return rules;
}

}  // namespace

std::vector<LintProblem> lint_probes(const probes::ProbeSet& set, const rays::TransportSource& source,
                                     const LintParams& params, const Control& control) {
  check(params);
  if (set.probes.empty()) return {};
  const LintContext context{set, source, params, control, rules_for(set, source, params)};

  std::vector<LintProblem> problems;
  check_places(context, problems);
  const std::vector<int> rooms = find_rooms(context, problems);
  check_light(context, rooms, problems);
  check_coverage(context, problems);
  std::ranges::stable_sort(problems, [](const LintProblem& a, const LintProblem& b) {
    return std::pair(a.kind, a.probe) < std::pair(b.kind, b.probe);
  });
  return problems;
}

std::vector<LintProblem> lint_places(const probes::ProbeSet& set, const rays::TransportSource& source,
                                     const LintParams& params, const Control& control) {
  check(params);
  if (set.probes.empty()) return {};
  std::vector<LintProblem> problems;
  check_places({set, source, params, control, rules_for(set, source, params)}, problems);
  return problems;
}

}  // namespace ssphh::study
