// Automatic placement, on scenes whose free space is known in closed form.

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>

#include "draft.h"
#include "relocate.h"
#include "scene_of.h"
#include "triangle_source.h"

namespace ssphh::place {
namespace {

using test::TriangleSource;

enum class Where { room_a, room_b, doorway, wall };

/// Of builtin:two-rooms: room A x −4.075…−0.075, B x 0.075…4.075, y 0…3, z −2…2, doorway z ±0.45, y 0…2.1.
Where where(const vec3& p) {
  if (p.y <= 0 || p.y >= 3 || std::abs(p.z) >= 2 || std::abs(p.x) >= 4.075f) return Where::wall;
  if (p.x < -0.075f) return Where::room_a;
  if (p.x > 0.075f) return Where::room_b;
  return std::abs(p.z) < 0.45f && p.y < 2.1f ? Where::doorway : Where::wall;
}

std::map<Where, int> census(const Placement& placement) {
  std::map<Where, int> count;
  for (const PlacedProbe& probe : placement.probes) ++count[where(probe.position)];
  return count;
}

PlaceParams params_of(const scene::Scene& scene, float spacing, bool manual = true) {
  PlaceParams params = place_params(scene);
  params.spacing = spacing;
  if (!manual) params.manual.clear();
  return params;
}

/// The scene of a test and its source.
struct Given {
  scene::Scene scene;
  TriangleSource source;
  explicit Given(scene::Scene s) : scene(std::move(s)), source(scene) {}
  explicit Given(const char* name) : Given(scene::make_builtin(name)) {}
};

class TwoRooms : public testing::TestWithParam<float> {};

TEST_P(TwoRooms, EveryProbeStandsInARoomOrTheDoorway) {
  const Given given("two-rooms");
  const Placement placement = place_probes(given.source, params_of(given.scene, GetParam(), false));
  std::map<Where, int> count = census(placement);
  EXPECT_EQ(count[Where::wall], 0);
  // As many as cells of the grid's size fit, and refinement on top; the furniture-free rooms are mirror
  // images.
  const float volume = 4 * 3 * 4 / std::pow(GetParam(), 3.0f);
  EXPECT_GT(count[Where::room_a], 0.6 * volume);
  EXPECT_GT(count[Where::room_b], 0.6 * volume);
  EXPECT_GE(count[Where::doorway], 1) << "a passage of 0.9 m";
}

TEST_P(TwoRooms, EdgesCrossTheWallOnlyThroughTheDoorway) {
  const Given given("two-rooms");
  const Placement placement = place_probes(given.source, params_of(given.scene, GetParam()));
  int crossing = 0;
  for (const PlacedEdge& edge : placement.edges) {
    ASSERT_LT(edge.a, edge.b);
    ASSERT_LT(edge.b, placement.probes.size());
    const vec3 a = placement.probes[edge.a].position, b = placement.probes[edge.b].position;
    if (a.x * b.x >= 0) continue;
    ++crossing;
    for (const float plane : {-0.075f, 0.075f}) {
      if ((a.x - plane) * (b.x - plane) >= 0) continue;
      const vec3 p = a + (b - a) * ((plane - a.x) / (b.x - a.x));
      EXPECT_LE(std::abs(p.z), 0.4501f);
      EXPECT_LE(p.y, 2.1001f);
    }
  }
  EXPECT_GT(crossing, 0);
}

TEST_P(TwoRooms, ProbesKeepTheirDistance) {
  const Given given("two-rooms");
  const Placement placement = place_probes(given.source, params_of(given.scene, GetParam(), false));
  EXPECT_LE(placement.clearance, 0.04f);
  for (const PlacedProbe& probe : placement.probes) {
    const vec3& p = probe.position;
    const float inner = std::abs(p.x) - 0.075f;
    float nearest = std::min({p.y, 3 - p.y, 2 - std::abs(p.z), 4.075f - std::abs(p.x)});
    if (p.y > 2.1f || std::abs(p.z) > 0.45f) nearest = std::min(nearest, inner);
    // 128 rays find a wall's distance to a few per cent.
    EXPECT_GE(nearest, 0.95f * placement.clearance) << probe.name;
    EXPECT_FLOAT_EQ(probe.radius, std::min(0.1f * probe.spacing, 0.8f * probe.clearance));
  }
}

TEST_P(TwoRooms, NoProbeStandsInTheDoorsWay) {
  const Given given("two-rooms");
  const Placement placement = place_probes(given.source, params_of(given.scene, GetParam(), false));
  // The leaf is 4 cm thick and 1 m wide, 2.15 m high, and turns by 100° about (0.115, −0.5) in x, z.
  for (const PlacedProbe& probe : placement.probes) {
    const vec3& p = probe.position;
    if (p.y > 2.15f) continue;
    const float radius = glm::length(vec2(p.x - 0.115f, p.z + 0.5f));
    const float angle = glm::degrees(std::atan2(p.x - 0.115f, p.z + 0.5f));
    EXPECT_FALSE(radius < 1 && angle > 0 && angle < 100) << probe.name << ": " << radius << " m, " << angle;
  }
}

INSTANTIATE_TEST_SUITE_P(Spacings, TwoRooms, testing::Values(0.7f, 1.0f));

TEST(Place, TheDoorIsFlaggedOnEdgesThatItBlocks) {
  const Given given("two-rooms");
  const Placement placement = place_probes(given.source, params_of(given.scene, 0.7f));
  int crossing = 0, moving = 0;
  for (const PlacedEdge& edge : placement.edges) {
    const vec3 a = placement.probes[edge.a].position, b = placement.probes[edge.b].position;
    moving += edge.moving ? 1 : 0;
    // Shut, the leaf covers the whole doorway from x = 0.075 to 0.115.
    if (std::min(a.x, b.x) >= 0.075f || std::max(a.x, b.x) <= 0.115f) continue;
    ++crossing;
    EXPECT_TRUE(edge.moving);
  }
  EXPECT_GT(crossing, 0);
  EXPECT_LT(moving, static_cast<int>(placement.edges.size()) / 2) << "most are far from the door";
}

TEST(Place, TheSameWithAnyNumberOfThreads) {
  const Given given("two-rooms");
  const PlaceParams params = params_of(given.scene, 1.0f);
  set_thread_count(1);
  const Placement one = place_probes(given.source, params);
  set_thread_count(0);
  EXPECT_EQ(place_probes(given.source, params), one);
}

TEST(Place, ManualProbesStayAsTheyAre) {
  const Given given("two-rooms");
  const PlaceParams params = params_of(given.scene, 1.0f);
  const Placement placement = place_probes(given.source, params);
  ASSERT_GT(placement.probes.size(), params.manual.size());
  for (std::size_t i = 0; i < params.manual.size(); ++i) {
    EXPECT_EQ(placement.probes[i].name, params.manual[i].name);
    EXPECT_EQ(placement.probes[i].position, params.manual[i].position);
    EXPECT_EQ(placement.probes[i].radius, params.manual[i].radius);
    EXPECT_EQ(placement.probes[i].kind, PlaceKind::manual);
  }
  for (std::size_t i = params.manual.size(); i < placement.probes.size(); ++i) {
    EXPECT_NE(placement.probes[i].kind, PlaceKind::manual);
    EXPECT_THAT(placement.probes[i].name, testing::StartsWith("auto "));
  }
}

TEST(Place, ANumberOfProbesIsKeptAndSpread) {
  const Given given("two-rooms");
  for (const int count : {8, 40}) {
    PlaceParams params = params_of(given.scene, 0, false);
    params.count = count;
    const Placement placement = place_probes(given.source, params);
    EXPECT_EQ(placement.probes.size(), static_cast<std::size_t>(count));
    std::map<Where, int> found = census(placement);
    EXPECT_GE(found[Where::room_a], count / 4);
    EXPECT_GE(found[Where::room_b], count / 4);
  }
}

TEST(Place, WithoutASpacingAHundredOrTwo) {
  for (const char* name : {"two-rooms", "cornell"}) {
    const Given given(name);
    const Placement placement = place_probes(given.source, params_of(given.scene, 0, false));
    EXPECT_GE(placement.probes.size(), 100u) << name;
    EXPECT_LE(placement.probes.size(), 200u) << name;
  }
}

TEST(Place, CornellKeepsClearOfItsBoxes) {
  const Given given("cornell");
  const Placement placement = place_probes(given.source, params_of(given.scene, 0.3f, false));
  EXPECT_GT(placement.counts.inside, 0u) << "the grid meets the boxes";
  const auto in_box = [](const vec3& p, const vec3& centre, float degrees, float half, float height) {
    const float a = glm::radians(-degrees);
    const vec3 d = p - centre;
    const vec2 local(std::cos(a) * d.x + std::sin(a) * d.z, -std::sin(a) * d.x + std::cos(a) * d.z);
    return std::abs(local.x) < half && std::abs(local.y) < half && p.y < height;
  };
  for (const PlacedProbe& probe : placement.probes) {
    const vec3& p = probe.position;
    EXPECT_LT(std::max(std::abs(p.x), std::abs(p.z)), 1) << probe.name;
    EXPECT_FALSE(in_box(p, {-0.335f, 0, -0.29f}, 17, 0.3f, 1.2f)) << probe.name;
    EXPECT_FALSE(in_box(p, {0.33f, 0, 0.375f}, -17, 0.3f, 0.6f)) << probe.name;
  }
}

TEST(Place, AClosetThatTheGridMissesGetsAProbe) {
  // A room of 4 m and, joined by nothing, a closet of 0.5 m: too small for a spacing of 2 m to hit for sure.
  const Given given(scene_of({scene::flipped(scene::make_box({0, 0, 0}, {4, 4, 4})),
                              scene::flipped(scene::make_box({4.9f, 0, 0}, {5.7f, 0.8f, 0.8f}))}));
  PlaceParams params;
  params.spacing = 2;
  params.levels = 2;
  params.interest = {{2, 2, 2}, {5.3f, 0.4f, 0.4f}};
  const Placement placement = place_probes(given.source, params);
  const auto in_closet = [](const PlacedProbe& p) { return p.position.x > 4.9f; };
  EXPECT_TRUE(std::any_of(placement.probes.begin(), placement.probes.end(), in_closet));
}

TEST(Place, WhereNobodyIsThereAreNoProbes) {
  const Given given(scene_of({scene::flipped(scene::make_box({0, 0, 0}, {4, 3, 4})),
                              scene::flipped(scene::make_box({4.5f, 0, 0}, {8, 3, 4}))}));
  PlaceParams params;
  params.spacing = 1;
  params.interest = {{2, 1.5f, 2}};
  const Placement seen = place_probes(given.source, params);
  for (const PlacedProbe& probe : seen.probes) EXPECT_LT(probe.position.x, 4) << probe.name;
  EXPECT_GT(seen.counts.unreachable, 0u);
  // With no camera or lamp at all, both rooms are of a size.
  params.interest.clear();
  const Placement both = place_probes(given.source, params);
  EXPECT_GT(both.probes.size(), seen.probes.size());
}

TEST(Place, ProbesInOpenAirAreRemoved) {
  // A floor with a low body in one corner and a mast of 30 m: most of the bounds is air.
  const Given given(scene_of({scene::make_quad({0, 0, 20}, {20, 0, 0}, {0, 0, -20}),
                              scene::make_box({0.5f, 0.1f, 0.5f}, {1, 30, 1})}));
  PlaceParams params;
  params.spacing = 2;
  params.interest = {{10, 1, 10}};
  const Placement placement = place_probes(given.source, params);
  EXPECT_GT(placement.counts.open_air, 100u);
  for (const PlacedProbe& probe : placement.probes) {
    const float to_mast = glm::length(glm::max(vec2(probe.position.x, probe.position.z) - 1.0f, vec2(0)));
    // A ray of the fan may miss the mast; nothing farther than the reach of two spacings can be near.
    EXPECT_LE(std::min(probe.position.y, to_mast), 4.0f) << probe.name;
  }
}

TEST(Place, ScenesWoundTheWrongWayRoundKeepTheirProbes) {
  const Given given(scene_of({scene::make_box({0, 0, 0}, {4, 3, 4})}));
  PlaceParams params;
  params.spacing = 1;
  params.interest = {{2, 1.5f, 2}};
  const Placement placement = place_probes(given.source, params);
  EXPECT_GE(placement.probes.size(), 24u);
  ASSERT_EQ(placement.warnings.size(), 1u);
  EXPECT_THAT(placement.warnings[0], testing::HasSubstr("backs"));
  // Nobody says that the box is a room: it is a body then, and they stand around it.
  params.interest.clear();
  for (const PlacedProbe& probe : place_probes(given.source, params).probes) {
    const vec3 inside = glm::clamp(probe.position, vec3(0), {4, 3, 4});
    EXPECT_GT(glm::distance(inside, probe.position), 0) << probe.name;
  }
}

TEST(Relocate, OutOfAWallToItsNearerSide) {
  // A wall of 0.2 m in a room.
  const Given given(scene_of({scene::flipped(scene::make_box({-3, 0, -3}, {3, 3, 3})),
                              scene::make_box({-0.1f, 0, -2}, {0.1f, 2.5f, 2})}));
  const SiteRules rules{0.04f, 0.25f};
  const vec3 in_wall(0.06f, 1.2f, 0.3f);
  const Site site = look_around(given.source, in_wall);
  EXPECT_TRUE(inside_body(site, rules));
  const auto moved = relocate(given.source, in_wall, site, rules, 0.5f);
  ASSERT_TRUE(moved.has_value());
  EXPECT_GE(moved->position.x, 0.1f + 0.9f * rules.clearance);
  EXPECT_LE(moved->position.x, 0.1f + 4 * rules.clearance);
  EXPECT_TRUE(valid(moved->site, rules));
  EXPECT_FALSE(relocate(given.source, in_wall, site, rules, 0.05f)) << "too far away";
}

TEST(Relocate, OffAWall) {
  const Given given(scene_of({scene::flipped(scene::make_box({-3, 0, -3}, {3, 3, 3}))}));
  const SiteRules rules{0.04f, 0.25f};
  const vec3 close(2.99f, 1.2f, 0.3f);
  const auto moved = relocate(given.source, close, look_around(given.source, close), rules, 0.5f);
  ASSERT_TRUE(moved.has_value());
  EXPECT_LE(moved->position.x, 3 - rules.clearance);
  EXPECT_GE(moved->position.x, 3 - 4 * rules.clearance);
}

TEST(Site, HarmonicMeanInAHollowSphere) {
  const Given given(scene_of({scene::flipped(scene::make_sphere(2, 96, 48))}));
  const Site centre = look_around(given.source, vec3(0.001f, 0.002f, 0));
  EXPECT_NEAR(centre.harmonic, 2, 0.01) << "facets";
  EXPECT_NEAR(centre.nearest, 2, 0.01);
  EXPECT_EQ(centre.back, 0);
  EXPECT_EQ(centre.escaped, 0);
}

TEST(Spread, AlongEdgesAndNotThroughWalls) {
  // A chain of five and one that nothing is connected with, beside its head.
  std::vector<Draft> drafts(6);
  for (int i = 0; i < 5; ++i) drafts[i].position = vec3(i, 0, 0);
  drafts[0].kind = PlaceKind::manual;
  drafts[5].position = vec3(0.1f, 0, 0);
  const std::vector<PlacedEdge> edges = {{0, 1, false}, {1, 2, false}, {2, 3, false}, {3, 4, false}};
  EXPECT_EQ(most_spread(drafts, edges, 2), (std::vector<bool>{true, false, false, false, false, true}));
  EXPECT_EQ(most_spread(drafts, edges, 3), (std::vector<bool>{true, false, false, false, true, true}));
  EXPECT_EQ(most_spread(drafts, edges, 4), (std::vector<bool>{true, false, true, false, true, true}));
}

TEST(Place, SaysWhatIsWrong) {
  const Given given("two-rooms");
  const auto message = [&](const std::function<void(PlaceParams&)>& change) -> std::string {
    PlaceParams params = params_of(given.scene, 1.0f);
    change(params);
    try {
      place_probes(given.source, params);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message([](PlaceParams& p) { p.spacing = -1; }), HasSubstr("spacing must be"));
  EXPECT_THAT(message([](PlaceParams& p) { p.spacing = NAN; }), HasSubstr("spacing must be"));
  EXPECT_THAT(message([](PlaceParams& p) { p.spacing = INFINITY; }), HasSubstr("spacing must be"));
  EXPECT_THAT(message([](PlaceParams& p) { p.spacing = 1e-6f; }), HasSubstr("more than 65536 probes"));
  EXPECT_THAT(message([](PlaceParams& p) { p.max_probes = 20; }), HasSubstr("more than 20 probes"));
  EXPECT_THAT(message([](PlaceParams& p) { p.clearance = 0; }), HasSubstr("clearance"));
  EXPECT_THAT(message([](PlaceParams& p) { p.levels = 9; }), HasSubstr("levels"));
  EXPECT_THAT(message([](PlaceParams& p) { p.count = 3; }), HasSubstr("SPHLs of its own"));
  EXPECT_THAT(message([](PlaceParams& p) { p.count = 70000; }), HasSubstr("more than the 65536"));
  EXPECT_THAT(message([](PlaceParams& p) { p.spacing = 3, p.count = 4000; }),
              HasSubstr("find a place (use a smaller spacing)"));
  EXPECT_THAT(message([](PlaceParams& p) { p.interest = {vec3(NAN)}; }), HasSubstr("not finite"));
  const Given empty{scene::Scene{}};
  EXPECT_THROW(place_probes(empty.source, {}), Error);
}

}  // namespace
}  // namespace ssphh::place
