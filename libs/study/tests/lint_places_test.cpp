/// Which places of probes are said to be wrong: every threshold from both sides.

#include <gtest/gtest.h>

#include <ssphh/study/lint.h>

#include "ray_source.h"

namespace ssphh::study {
namespace {

using test::RaySource;
using test::surface_at;

/// Backs within the cap around +z of so large a share of the sphere, fronts around it, all `distance` away;
/// nothing below the plane z = `horizon`.
RaySource cap_of_backs(float share, float distance = 2, float horizon = -1) {
  return RaySource([=](const vec3&, const vec3& d) {
    if (d.z < horizon) return rays::RayHit{};
    return surface_at(distance, d, d.z > 1 - 2 * share);
  });
}

/// Probes half a metre apart: the clearance is 5 % of that.
probes::ProbeSet two_probes() {
  probes::ProbeSet set;
  for (int i = 0; i < 2; ++i) {
    probes::Probe probe;
    probe.position = vec3(0.5f * static_cast<float>(i), 0, 0);
    set.probes.push_back(probe);
  }
  return set;
}

TEST(LintPlaces, AProbeThatSeesMoreThanAQuarterOfBacksIsInside) {
  const probes::ProbeSet set = two_probes();
  EXPECT_TRUE(lint_places(set, cap_of_backs(0.24f), {}).empty());
  EXPECT_TRUE(lint_places(set, cap_of_backs(0.12f, 2, 0), {}).empty()) << "half of its view open";
  for (const RaySource& source : {cap_of_backs(0.27f), cap_of_backs(0.135f, 2, 0)}) {
    const std::vector<LintProblem> problems = lint_places(set, source, {});
    ASSERT_EQ(problems.size(), 2u);
    for (const LintProblem& problem : problems) {
      EXPECT_EQ(problem.kind, ProbeProblem::inside);
      EXPECT_NE(problem.message.find(" 27 %"), std::string::npos) << problem.message;
    }
  }
  // A camera that sees backs itself says that these are none of a body.
  LintParams params;
  params.interest = {vec3(0)};
  EXPECT_TRUE(lint_places(set, cap_of_backs(0.27f), params).empty());
}

TEST(LintPlaces, AProbeNearerThanATwentiethOfTheSpacingIsTooClose) {
  probes::ProbeSet set = two_probes();
  const auto kinds = [&](float distance, const LintParams& params = {}) {
    std::vector<ProbeProblem> found;
    for (const LintProblem& problem : lint_places(set, cap_of_backs(0, distance), params))
      found.push_back(problem.kind);
    return found;
  };
  using Found = std::vector<ProbeProblem>;
  const Found both(2, ProbeProblem::too_close);
  EXPECT_EQ(kinds(0.0252f), Found{});
  EXPECT_EQ(kinds(0.0248f), both);
  set.probes[1].position.x = 10;  // but 4 cm are always enough
  EXPECT_EQ(kinds(0.0402f), Found{});
  EXPECT_EQ(kinds(0.0398f), both);
  LintParams params;
  params.clearance = 0.2f;
  EXPECT_EQ(kinds(0.19f, params), both);
  EXPECT_EQ(kinds(0.21f, params), Found{});
}

}  // namespace
}  // namespace ssphh::study
