/// What lint says, word by word, and what each of its thresholds and searches is about.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/study/lint.h>

#include "error_message.h"
#include "ray_source.h"
#include "triangle_source.h"

namespace ssphh::study {
namespace {

using test::RaySource;
using test::surface_at;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Walls 2 m away wherever one stands.
const RaySource walls_around([](const vec3&, const vec3& d) { return surface_at(2, d); });

/// Constant radiance 1, and `band1` toward +y.
sh::RadianceSh light(float level, float band1 = 0) {
  sh::RadianceSh f(1);
  f[0] = vec3(level * std::sqrt(4 * pi));
  f[1] = vec3(band1);
  return f;
}

probes::ProbeSet lit_at(const std::vector<vec3>& positions) {
  probes::ProbeSet set;
  set.degree = 1;
  set.light_groups = {{"lamp", vec3(1)}};
  for (const vec3& p : positions) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = "p" + std::to_string(set.probes.size() - 1);
    probe.position = p;
    probe.groups = {{{}, light(1)}};
  }
  probes::merge_groups(set);
  return set;
}

std::vector<std::string> messages(const std::vector<LintProblem>& problems) {
  std::vector<std::string> said;
  for (const LintProblem& p : problems) said.push_back(std::string(name_of(p.kind)) + ": " + p.message);
  return said;
}

TEST(LintMessages, KindsHaveTheNamesThatReportsUse) {
  const std::vector<std::string> names{"not-finite", "inside",   "too-close", "swept",      "unlit",
                                       "unlit-room", "isolated", "negative",  "unseen-room"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(name_of(static_cast<ProbeProblem>(i)), names[i]);
}

TEST(LintMessages, DistancesAreThoseMeasuredAndAskedFor) {
  const RaySource close([](const vec3&, const vec3& d) { return surface_at(0.0125f, d); });
  EXPECT_THAT(messages(lint_places(lit_at({vec3(0), vec3(0.5f, 0, 0)}), close, {})),
              ElementsAre("too-close: is 0.0125 m from a surface; move it to at least 0.025 m",
                          "too-close: is 0.0125 m from a surface; move it to at least 0.025 m"));
  const RaySource backs([](const vec3&, const vec3& d) { return surface_at(1, d, true); });
  EXPECT_THAT(
      messages(lint_places(lit_at({vec3(0)}), backs, {})),
      ElementsAre("inside: lies inside a body: 100 % of the surfaces it sees show their backs; move it out"));
}

TEST(LintMessages, TheClearanceIsOfTheMedianDistanceOfNeighbours) {
  const RaySource close([](const vec3&, const vec3& d) { return surface_at(0.001f, d); });
  const auto asked = [&](const std::vector<vec3>& places) {
    const std::string said = messages(lint_places(lit_at(places), close, {}))[0];
    return said.substr(said.find("least") + 6);
  };
  // Neighbours at 0.2, 0.2 and 0.8 m.
  EXPECT_EQ(asked({vec3(0), vec3(0.2f, 0, 0), vec3(1, 0, 0)}), "0.01 m");
  // Two in one place are no neighbours.
  EXPECT_EQ(asked({vec3(0), vec3(0), vec3(0, 0.4f, 0)}), "0.02 m");
  EXPECT_EQ(asked({vec3(0)}), "0.04 m");
}

TEST(LintMessages, NumbersThatAreNoneAreFoundWhereverTheyHide) {
  const auto found = [&](const std::function<void(probes::ProbeSet&)>& spoil) {
    probes::ProbeSet set = lit_at({vec3(0), vec3(0, 0, 5)});
    set.probes[0].edges = {{1, 0.5f, light(1), {}}};
    spoil(set);
    std::vector<ProbeProblem> kinds;
    for (const LintProblem& p : lint_places(set, walls_around, {})) {
      kinds.push_back(p.kind);
      EXPECT_EQ(p.probe, 0);
      EXPECT_EQ(p.message, "holds a number that is not finite; bake it again");
    }
    return kinds;
  };
  EXPECT_THAT(found([](probes::ProbeSet&) {}), IsEmpty());
  const auto only = ElementsAre(ProbeProblem::not_finite);
  EXPECT_THAT(found([](probes::ProbeSet& s) { s.probes[0].position.z = NAN; }), only);
  EXPECT_THAT(found([](probes::ProbeSet& s) { s.probes[0].radius = INFINITY; }), only);
  EXPECT_THAT(found([](probes::ProbeSet& s) { s.probes[0].groups[0].reflected[1].y = NAN; }), only);
  EXPECT_THAT(found([](probes::ProbeSet& s) {
                s.probes[0].groups[0].emitted = light(1);
                s.probes[0].groups[0].emitted[0].z = INFINITY;
              }),
              only);
  EXPECT_THAT(found([](probes::ProbeSet& s) { s.probes[0].edges[0].transfer = NAN; }), only);
  EXPECT_THAT(found([](probes::ProbeSet& s) { s.probes[0].edges[0].h[3].x = NAN; }), only);
}

TEST(LintMessages, AProbeInTheWayNamesThePart) {
  const test::TriangleSource source(scene::make_builtin("two-rooms"));
  const std::vector<std::string> said = messages(lint_places(lit_at({{0.465f, 1.2f, -0.15f}}), source, {}));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_THAT(said[0], HasSubstr("swept: stands in the way of \"" + source.part_name(1) + "\" at some time"));
}

/// A closed room of 6 m, so that all probes see each other.
test::TriangleSource hall() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.meshes = {scene::flipped(scene::make_box(vec3(-3), vec3(3)))};
  scene.instances = {{0, 0, -1, ""}};
  return test::TriangleSource(scene);
}

TEST(LintMessages, LightIsWhatAnyGroupSendsOrReflects) {
  const test::TriangleSource source = hall();
  LintParams params;
  params.spacing = 2;
  probes::ProbeSet set = lit_at({vec3(-1, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)});
  const auto said = [&] {
    probes::merge_groups(set);
    return messages(lint_probes(set, source, params));
  };
  EXPECT_THAT(said(), IsEmpty());
  set.probes[1].groups[0].reflected = light(0);
  EXPECT_THAT(
      said(),
      ElementsAre("unlit: receives no light; light its surroundings, bake with more depth or samples, "
                  "or remove it"));
  set.probes[1].groups[0].emitted = light(1);
  EXPECT_THAT(said(), IsEmpty()) << "an emitter is light";
  set.probes[1].groups[0].emitted = {};
  set.probes[0].groups[0].reflected = set.probes[2].groups[0].reflected = light(0);
  set.generator.time = 1.5f;
  EXPECT_THAT(
      said(),
      ElementsAre("unlit-room: 3 probes around \"p0\" see each other and no light at all at 1.5 s; put a "
                  "lamp there, bake with the door open, or leave the probes out"));
}

TEST(LintMessages, NegativeIrradianceIsToldInPerCentOfTheMean) {
  // E = π + 2π/3 · √(3/4π) · b y: its lowest over π is 1 − b/√(3π).
  const test::TriangleSource source = hall();
  LintParams params;
  params.spacing = 2;
  probes::ProbeSet set = lit_at({vec3(-1, 0, 0), vec3(1, 0, 0)});
  set.probes[1].groups[0].reflected = light(1, 1.37f * std::sqrt(3 * pi));
  probes::merge_groups(set);
  const std::vector<LintProblem> problems = lint_probes(set, source, params);
  EXPECT_THAT(
      messages(problems),
      ElementsAre(
          "negative: gives an irradiance of down to -37 % of its mean; bake with more samples, move it "
          "away from what is brightly lit, or window it"));
  EXPECT_EQ(problems[0].probe, 1);
  EXPECT_EQ(problems[0].position, vec3(1, 0, 0));
  params.negative_tolerance = 0.38f;
  EXPECT_THAT(lint_probes(set, source, params), IsEmpty());
}

TEST(LintMessages, UnseenPlacesAreCountedAndTheWidestIsNamed) {
  // Two rooms without a door between them, probes in one.
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.meshes = {scene::flipped(scene::make_box(vec3(0), vec3(3, 3, 3))),
                  scene::flipped(scene::make_box(vec3(4, 0, 0), vec3(7, 3, 3)))};
  scene.instances = {{0, 0, -1, ""}, {1, 0, -1, ""}};
  const test::TriangleSource source(scene);
  LintParams params;
  params.spacing = 1;
  params.interest = {vec3(5.5f, 1.5f, 1.5f)};
  probes::ProbeSet set = lit_at({vec3(1, 1.5f, 1.5f), vec3(2, 1.5f, 1.5f)});
  place::PlaceParams alike;
  alike.spacing = 1;
  alike.interest = params.interest;
  for (const probes::Probe& probe : set.probes) alike.interest.push_back(probe.position);
  std::size_t unseen = 0;
  float widest = 0;
  for (const place::PlacedProbe& place : place::place_probes(source, alike).probes) {
    if (place.position.x < 3.5f) continue;
    ++unseen;
    widest = std::max(widest, place.clearance);
  }
  const std::vector<LintProblem> problems = lint_probes(set, source, params);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(messages(problems)[0], "unseen-room: no probe is to be seen from " + std::to_string(unseen) +
                                       " places around here; add one");
  EXPECT_EQ(problems[0].probe, -1);
  EXPECT_GT(problems[0].position.x, 4);
  float clearance = 0;
  for (const place::PlacedProbe& place : place::place_probes(source, alike).probes)
    if (place.position == problems[0].position) clearance = place.clearance;
  EXPECT_EQ(clearance, widest);
}

TEST(LintMessages, ParametersOutOfRangeAreNamedWithTheirValue) {
  const auto said = [&](const LintParams& params) {
    return test::message_of([&] { lint_probes(lit_at({vec3(0)}), walls_around, params); });
  };
  LintParams params;
  params.clearance = -0.5f;
  EXPECT_THAT(said(params), HasSubstr("the clearance must be a number over or equal to 0, not -0.5"));
  params = {};
  params.negative_tolerance = -2;
  EXPECT_THAT(said(params),
              HasSubstr("the tolerance of negative irradiance must be a number over or equal to 0, not -2"));
  params = {};
  params.spacing = INFINITY;
  EXPECT_THAT(said(params), HasSubstr("the spacing must be a number over or equal to 0, not inf"));
  params = {};
  params.clearance = INFINITY;
  EXPECT_THAT(said(params), HasSubstr("clearance"));
  EXPECT_THAT(lint_probes({}, walls_around, {}), IsEmpty());
}

}  // namespace
}  // namespace ssphh::study
