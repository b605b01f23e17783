// Lint finds what was planted, and nothing in a set without faults.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/lint.h>

#include "triangle_source.h"

namespace ssphh::study {
namespace {

/// Constant radiance, of another colour in each channel, with `tilt` of band 1 toward +y in blue alone.
sh::RadianceSh coloured_light(float level, float tilt = 0) {
  sh::RadianceSh f(2);
  f[0] = level * 3.5449077f * vec3(1, 2, 0.5f);
  f[1] = vec3(0, 0, 0.5f * tilt);
  return f;
}

probes::ProbeSet probes_at(const std::vector<vec3>& positions) {
  probes::ProbeSet set;
  set.degree = 2;
  set.light_groups = {{"lamp", vec3(1)}};
  for (const vec3& p : positions) {
    probes::Probe probe;
    probe.name = "probe " + std::to_string(set.probes.size());
    probe.position = p;
    probe.groups = {{{}, coloured_light(1)}};
    set.probes.push_back(std::move(probe));
  }
  probes::merge_groups(set);
  return set;
}

/// builtin:two-rooms with its SPHLs, lit: nothing to complain about.
class Lint : public testing::Test {
 protected:
  Lint() {
    std::vector<vec3> positions;
    for (const scene::ProbePlace& place : scene::sphl_places(scene_)) positions.push_back(place.position);
    set_ = probes_at(positions);
    params_.interest = place::place_params(scene_).interest;
    params_.spacing = 1;
  }
  std::vector<LintProblem> run() {
    probes::merge_groups(set_);
    return lint_probes(set_, source_, params_);
  }
  void expect_only(ProbeProblem kind, int probe) {
    const std::vector<LintProblem> problems = run();
    ASSERT_EQ(problems.size(), 1u) << (problems.empty()
                                           ? ""
                                           : problems[0].message + "\n" + problems.back().message);
    EXPECT_EQ(name_of(problems[0].kind), name_of(kind));
    EXPECT_EQ(problems[0].probe, probe);
    EXPECT_FALSE(problems[0].message.empty());
  }

  scene::Scene scene_ = scene::make_builtin("two-rooms");
  test::TriangleSource source_{scene_};
  probes::ProbeSet set_;
  LintParams params_;
};

TEST_F(Lint, ASoundSetIsClean) {
  EXPECT_THAT(run(), testing::IsEmpty());
}

TEST_F(Lint, WhatPlacementMakesIsClean) {
  place::PlaceParams place = place::place_params(scene_);
  place.spacing = 1;
  place.manual.clear();
  std::vector<vec3> positions;
  for (const place::PlacedProbe& probe : place::place_probes(source_, place).probes)
    positions.push_back(probe.position);
  set_ = probes_at(positions);
  EXPECT_THAT(run(), testing::IsEmpty());
}

TEST_F(Lint, ProbeInAWall) {
  set_.probes[3].position = {0.01f, 2.7f, 1.2f};
  const std::vector<LintProblem> problems = run();
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].kind, ProbeProblem::inside);
  EXPECT_EQ(problems[0].probe, 3);
  EXPECT_EQ(problems[0].position, set_.probes[3].position);
}

TEST_F(Lint, ProbeTooCloseToTheCeiling) {
  set_.probes[1].position.y = 2.98f;
  expect_only(ProbeProblem::too_close, 1);
  params_.clearance = 0.01f;
  EXPECT_THAT(run(), testing::IsEmpty());
}

TEST_F(Lint, ProbeInTheDoorsWay) {
  // In the middle of the leaf's sweep: 0.5 m from its hinge at 45°.
  set_.probes[3].position = {0.115f + 0.35f, 1.2f, -0.5f + 0.35f};
  expect_only(ProbeProblem::swept, 3);
}

TEST_F(Lint, UnlitProbe) {
  set_.probes[2].groups[0].reflected = coloured_light(0);
  expect_only(ProbeProblem::unlit, 2);
  // A lamp that is switched off leaves a probe as good as it is.
  set_.probes[2].groups[0].reflected = coloured_light(1);
  set_.light_groups[0].scale = vec3(0);
  EXPECT_THAT(run(), testing::IsEmpty());
}

TEST_F(Lint, UnlitRoomBehindTheDoor) {
  // Shut at time 0 and open at 1, so that room B is a room of its own, or one with A.
  for (const std::size_t i : {3u, 4u, 5u}) set_.probes[i].groups[0].reflected = coloured_light(0);
  const std::vector<LintProblem> problems = run();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, ProbeProblem::unlit_room);
  EXPECT_EQ(problems[0].probe, -1);
  EXPECT_EQ(problems[0].position, set_.probes[3].position);
  set_.generator.time = 1;
  const std::vector<LintProblem> open = run();
  ASSERT_EQ(open.size(), 3u);
  for (const LintProblem& problem : open) EXPECT_EQ(problem.kind, ProbeProblem::unlit);
}

TEST_F(Lint, NegativeIrradiance) {
  // E(n) = π L + (2π/3) 0.4886 t n·y: under zero by 5 % of its mean for t = 1.05 · 3.0700.
  constexpr float zero = 1.5f / 0.48860251f;
  set_.probes[4].groups[0].reflected = coloured_light(1, 1.05f * zero);
  EXPECT_THAT(run(), testing::IsEmpty()) << "5 % is within the tolerance of 10 %";
  set_.probes[4].groups[0].reflected = coloured_light(1, 1.15f * zero);
  expect_only(ProbeProblem::negative, 4);
  params_.negative_tolerance = 0.16f;
  EXPECT_THAT(run(), testing::IsEmpty());
}

TEST_F(Lint, NumbersThatAreNone) {
  set_.probes[5].groups[0].reflected[3].y = NAN;
  expect_only(ProbeProblem::not_finite, 5);
}

TEST_F(Lint, RoomWithoutProbes) {
  // No probe east of the doorway's far side; room B cannot be seen from A's corners behind the wall.
  set_ = probes_at({{-3.6f, 1.5f, 1.7f}, {-3.6f, 1.5f, 1.2f}});
  const std::vector<LintProblem> problems = run();
  ASSERT_FALSE(problems.empty());
  for (const LintProblem& problem : problems) {
    EXPECT_EQ(problem.kind, ProbeProblem::unseen_room);
    EXPECT_GT(problem.position.x, 0) << "all of room A is in sight";
  }
}

TEST_F(Lint, IsolatedProbe) {
  // One in each room, on the two sides of the same wall.
  set_ = probes_at({{-0.5f, 1.5f, 1.5f}, {0.5f, 1.5f, 1.5f}});
  const std::vector<LintProblem> problems = run();
  int isolated = 0;
  for (const LintProblem& problem : problems) isolated += problem.kind == ProbeProblem::isolated ? 1 : 0;
  EXPECT_EQ(isolated, 2);
}

TEST_F(Lint, EveryKindHasAName) {
  for (int i = 0; i <= static_cast<int>(ProbeProblem::unseen_room); ++i) {
    EXPECT_GT(name_of(static_cast<ProbeProblem>(i)).size(), 3u);
  }
}

TEST_F(Lint, RefusesParametersOutOfRange) {
  params_.clearance = NAN;
  EXPECT_THROW(run(), Error);
  params_.clearance = 0;
  params_.spacing = -1;
  EXPECT_THROW(run(), Error);
}

}  // namespace
}  // namespace ssphh::study
