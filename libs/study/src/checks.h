#pragma once

#include <ssphh/place/site.h>
#include <ssphh/study/lint.h>

namespace ssphh::study {

/// What one lint shares between its checks.
struct LintContext {
  const probes::ProbeSet& set;
  const rays::TransportSource& source;
  const LintParams& params;
  const Control& control;
  place::SiteRules rules;
};

/// Coefficients, inside, too close, in the way of moving parts.
void check_places(const LintContext& context, std::vector<LintProblem>& problems);

/// Unlit probes and rooms, negative lobes.
void check_light(const LintContext& context, const std::vector<int>& rooms,
                 std::vector<LintProblem>& problems);

/// For each probe the lowest index of those it is connected with by sight, over other probes if need be: a
/// room, as doors stand when the set was baked. Adds the isolated ones, for which doors do not count.
std::vector<int> find_rooms(const LintContext& context, std::vector<LintProblem>& problems);

/// Places that see no probe.
void check_coverage(const LintContext& context, std::vector<LintProblem>& problems);

}  // namespace ssphh::study
