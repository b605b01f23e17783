/// Whole placements, number by number, as they were: in rooms of unequal walls, around a door, on a plain.
/// Closed forms elsewhere tell what they should be where there are some.

#include <gtest/gtest.h>

#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>

#include "number_list.h"
#include "plain_scene.h"
#include "scene_of.h"

namespace ssphh::place {
namespace {

// None is surplus here: which ones of an even grid are, is a matter of roundings.

/// What all probes of a kind have in common, and all edges.
void list_placement(test::NumberList& list, const std::string& name, const Placement& placement) {
  const PlaceCounts& n = placement.counts;
  list.add(name, placement.origin, placement.spacing, placement.clearance, placement.back_limit);
  list.add(" counts", n.candidates, n.relocated, n.inside, n.too_close, n.open_air, n.redundant, n.swept,
           n.unreachable, n.surplus);
  for (const PlaceKind kind : {PlaceKind::manual, PlaceKind::grid, PlaceKind::refined, PlaceKind::passage}) {
    double number = 0, radius = 0, spacing = 0, reach = 0, clearance = 0;
    glm::dvec3 position(0), squares(0);
    for (const PlacedProbe& p : placement.probes) {
      if (p.kind != kind) continue;
      const glm::dvec3 at(p.position);
      number += 1, radius += double{p.radius}, spacing += double{p.spacing}, reach += double{p.reach};
      clearance += double{p.clearance}, position += at, squares += at * at;
    }
    list.add(fmt::format(" kind {}", static_cast<int>(kind)), number, position, squares, radius, spacing,
             reach, clearance);
  }
  for (const bool moving : {false, true}) {
    double number = 0, length = 0;
    glm::dvec3 middles(0);
    for (const PlacedEdge& edge : placement.edges) {
      if (edge.moving != moving) continue;
      const vec3 a = placement.probes[edge.a].position, b = placement.probes[edge.b].position;
      number += 1, length += double{glm::distance(a, b)}, middles += glm::dvec3(a + b);
    }
    list.add(moving ? " edges behind doors" : " edges", number, length, middles);
  }
}

void list_probes(test::NumberList& list, const Placement& placement) {
  for (const PlacedProbe& p : placement.probes)
    list.add(" " + p.name, p.kind, p.position, p.radius, p.spacing, p.reach, p.clearance);
}

/// Two rooms with a way of 0.7 m between them, a body in one, a closet apart, and a mast beside it all.
scene::Scene flat() {
  return scene_of({scene::flipped(scene::make_box(vec3(0), {4.3f, 2.6f, 3.1f})),
                   scene::make_box({2.2f, -0.1f, -0.1f}, {2.37f, 2.7f, 1.1f}),
                   scene::make_box({2.2f, -0.1f, 1.8f}, {2.37f, 2.7f, 3.2f}),
                   scene::make_box({0.63f, -0.1f, 0.57f}, {1.48f, 0.94f, 1.31f}),
                   scene::flipped(scene::make_box({5.03f, 0.1f, 0.2f}, {5.77f, 0.83f, 1.04f})),
                   scene::make_box({5.31f, 0.1f, 2.2f}, {5.43f, 2.4f, 2.3f})});
}

TEST(PlacementList, OfRoomsIsWhatItWas) {
  const test::TriangleSource source(flat());
  test::NumberList list;
  PlaceParams params;
  params.spacing = 1.17f;
  params.interest = {{1, 1.3f, 2}, {5.4f, 0.4f, 0.7f}};
  params.manual = {{"by hand", vec3(3.7f, 1.1f, 2.5f), 0.07f}};
  for (const int levels : {0, 1}) {
    params.levels = levels;
    list_placement(list, fmt::format("rooms, {} levels", levels), place_probes(source, params));
  }
  params = {};
  params.levels = 0;
  params.spacing = 1.31f;
  const Placement placement = place_probes(source, params);
  list_placement(list, "one by one", placement);
  list_probes(list, placement);
  list.expect("libs/place/tests/expected/rooms.txt");
}

TEST(PlacementList, AroundADoorIsWhatItWas) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const test::TriangleSource source(scene);
  test::NumberList list;
  PlaceParams params = place_params(scene);
  params.manual.clear();
  params.spacing = 0.73f;
  params.levels = 0;
  list_placement(list, "door", place_probes(source, params));
  list.expect("libs/place/tests/expected/door.txt");
}

TEST(PlacementList, OnAPlainIsWhatItWas) {
  scene::Scene scene = plain(90);
  add_blocks(scene, {30, 0, -20});
  add(scene, scene::make_box({-51, 0, 33}, {-50, 7, 35}));
  const SampledSource source(scene);
  test::NumberList list;
  PlaceParams params;
  params.spacing = 2.9f;
  params.manual = {{"by hand", vec3(-20, 3, 10), 0.2f}};
  list_placement(list, "plain", place_probes(source, params));
  params = {};
  params.count = 9;
  const Placement placement = place_probes(source, params);
  list_placement(list, "nine", placement);
  list_probes(list, placement);
  // A floor alone, which has no volume.
  scene::Scene floor;
  add(floor, scene::make_quad({1, 2, 3}, {0, 0, 3.7f}, {6.1f, 0, 0}));
  params = {};
  params.max_probes = 15;
  list_placement(list, "up to fifteen", place_probes(SampledSource(floor), params));
  list.expect("libs/place/tests/expected/plain.txt");
}

}  // namespace
}  // namespace ssphh::place
