/// Which points light which parts of a surface, under a body that almost touches it and in folds.

#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/probes/fitted_surfaces.h>
#include <ssphh/scene/primitives.h>

#include "expected_text.h"
#include "still_surface.h"
#include "surface_entry.h"

namespace ssphh::probes {
namespace {

const vec3 low(-0.6f, 0.1f, -0.6f), high(0.6f, 1.2f, 0.6f);  // of the body

/// Whether the way from a to b stays out of a box, by slabs.
bool misses(const vec3& low, const vec3& high, const vec3& a, const vec3& b) {
  float enter = 0, leave = 1;
  for (glm::length_t c = 0; c < 3; ++c) {
    const float d = b[c] - a[c];
    if (std::abs(d) < 1e-9f) {
      if (a[c] <= low[c] || a[c] >= high[c]) return true;
      continue;
    }
    const float t0 = (low[c] - a[c]) / d, t1 = (high[c] - a[c]) / d;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter >= leave;
}
bool misses_body(const vec3& a, const vec3& b) {
  return misses(low, high, a, b);
}

scene::Scene body_on_a_floor() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.materials.emplace_back();
  scene.meshes.push_back(scene::make_quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}));
  scene.meshes.push_back(scene::make_box(low, high));
  for (scene::Mesh& mesh : scene.meshes) mesh.material = 0;
  scene.instances = {{0, 0, -1, ""}, {1, 0, -1, ""}};
  return scene;
}

/// On the floor, half a metre apart, and one in the middle of the body's lower side.
FittedPoints around_body() {
  FittedPoints fitted;
  const auto add = [&](const vec3& place, const vec3& normal) {
    fitted.points.push_back({place, normal});
    fitted.weights.emplace_back().add(0, 1);
  };
  for (int i = 0; i < 100; ++i)
    add({0.5f * static_cast<float>(i % 10) - 2.25f, 0, 0.5f * static_cast<float>(i / 10) - 2.25f}, {0, 1, 0});
  add({0, low.y, 0}, {0, -1, 0});
  return fitted;
}

/// Places of the points no farther than `reach` that may light a surface that faces n at x; those half a
/// metre apart do so to about 1 m.
std::vector<vec3> lighting(const SurfaceLists& surfaces, const vec3& x, const vec3& n = {0, 1, 0},
                           float reach = 0.8f) {
  const SurfaceGrid& grid = surfaces.grids[0];
  const vec3 u = (x - grid.origin) / grid.cell_size;
  const ivec3 cell(glm::floor(u));
  const int index = (cell.z * grid.cells.y + cell.y) * grid.cells.x + cell.x;
  const uvec2 range = surfaces.ranges[index];
  std::vector<vec3> places;
  for (unsigned i = 0; i < range.y; ++i) {
    const uvec4 entry = surfaces.lists[range.x + i];
    const rays::SurfacePoint& point = surfaces.points[entry.x & 0x7ffffu];
    const int part = surface_part(u - vec3(cell), static_cast<int>(entry.x >> 22));
    if (glm::dot(point.normal, n) > 0 && glm::distance(point.position, x) < reach &&
        ((part < 32 ? entry.y : entry.z) >> (part & 31) & 1u))
      places.push_back(point.position);
  }
  return places;
}

TEST(SurfaceLists, TheFloorUnderABodySeesItsNeighboursOnTheFloor) {
  // The body's lower side lies in the same squares, faces the other way, and sees the one point on it.
  const SurfaceLists surfaces = prepare_fitted(body_on_a_floor(), 0, around_body(), misses_body).surfaces;
  for (const vec3& x :
       {vec3(0.45f, 0, 0.1f), vec3(-0.3f, 0, -0.35f), vec3(0.1f, 0, 0.1f), vec3(1.5f, 0, 0.2f)}) {
    EXPECT_GE(lighting(surfaces, x).size(), 4u) << x.x << " " << x.z;
  }
}

TEST(SurfaceLists, TheFloorBesideABodySeesNothingThroughIt) {
  FittedPoints fitted = around_body();
  const auto walled = [](const vec3& a, const vec3& b) { return (a.x < 0) == (b.x < 0); };
  const SurfaceLists surfaces = prepare_fitted(body_on_a_floor(), 0, fitted, walled).surfaces;
  for (const float x : {-0.4f, -0.2f, 0.2f, 0.4f}) {
    const std::vector<vec3> places = lighting(surfaces, {x, 0, 0.1f});
    EXPECT_FALSE(places.empty());
    for (const vec3& p : places) EXPECT_EQ(p.x < 0, x < 0) << p.x << " from " << x;
  }
}

TEST(SurfaceLists, AFloorHasPointsAllTheWayToAPane) {
  // Before the pane a floor, behind it a sill a centimetre higher: samples of both lie in one part of a cell.
  constexpr float at = 0.035f;
  const auto divided = [](const vec3& a, const vec3& b) { return (a.x < at) == (b.x < at); };
  scene::Scene scene = body_on_a_floor();
  scene.materials.resize(2);
  scene.meshes = {scene::make_quad({-3, 0, -3}, {0, 0, 6}, {3 + at, 0, 0}),
                  scene::make_quad({at, 0.01f, -3}, {0, 0, 6}, {3 - at, 0, 0}),
                  scene::make_quad({at, 0, -3}, {0, 0, 6}, {0, 2, 0})};
  scene.instances.resize(3);
  for (int i = 0; i < 3; ++i) scene.instances[i].mesh = i, scene.meshes[i].material = i / 2;
  const auto fewest = [&](float transmission) {
    scene.materials[1].transmission = transmission;
    const SurfaceLists surfaces = prepare_fitted(scene, 0, around_body(), divided).surfaces;
    std::size_t least = 100;
    for (float x = -0.4f; x < 0.4f; x += 0.005f)
      least = std::min(least, lighting(surfaces, {x, x < at ? 0 : 0.01f, 0.1f}).size());
    return least;
  };
  EXPECT_GE(fewest(1), 3u);
  EXPECT_EQ(fewest(0), 0u) << "a wall's two sides have no points in common";
}

TEST(SurfaceLists, FarPointsOfAPlainAreNotSeenFromUnderAHouse) {
  // Hundreds of metres apart: shares of that are above the roof, and a ray as long as that may begin beyond a
  // wall. What lies under the house has no say then, wherever its wall cuts a part of a cell.
  FittedPoints fitted = around_body();
  fitted.points.pop_back(), fitted.weights.pop_back();
  std::erase_if(fitted.points, [](const rays::SurfacePoint& p) {
    return std::abs(p.position.x) < 0.7f && std::abs(p.position.z) < 0.7f;
  });
  for (int i = 0; i < 9; ++i) {
    const vec2 at(400.0f * static_cast<float>(i % 3 - 1), 300 + 400.0f * static_cast<float>(i / 3));
    fitted.points.push_back({{at.x, 0, at.y}, {0, 1, 0}});
  }
  fitted.weights.resize(fitted.points.size());
  for (PointWeights& weights : fitted.weights) {
    weights = {};
    weights.add(0, 1);
  }
  scene::Scene scene = body_on_a_floor();
  for (int shift = 0; shift < 20; ++shift) {
    const vec3 below(-0.6f, -0.1f, -0.6f), roof(0.6f + 0.002f * static_cast<float>(shift), 1.2f, 0.6f);
    scene.meshes[1] = scene::make_box(below, roof);
    scene.meshes[1].material = 0;
    const auto inside = [&](const vec3& x) { return x == glm::clamp(x, below, roof); };
    const auto sees = [&](const vec3& a, const vec3& b) {
      constexpr float rounding = 1e-4f;
      const vec3 begin = glm::mix(a, b, rounding);
      return inside(begin) == inside(b) && (inside(begin) || misses(below, roof, begin, b));
    };
    const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, sees).surfaces;
    for (float x = roof.x + 0.002f; x < 0.8f; x += 0.004f)
      EXPECT_GE(lighting(surfaces, {x, 0, 0.1f}).size(), 2u) << x << " beside a wall at " << roof.x;
    for (const vec3& p : lighting(surfaces, {0, 0, -0.7f}, {0, 1, 0}, 2000))
      EXPECT_FALSE(p.x == 0 && p.z >= 300) << "behind the house, seen over its roof";
  }
}

TEST(SurfaceLists, FinePointsBehindAWallSilenceNothingBeforeIt) {
  // In a corner of the cell's far side, a centimetre apart: half a metre is far too coarse there, and only
  // there.
  constexpr float at = 0.15f;
  const auto walled = [](const vec3& a, const vec3& b) { return (a.x < at) == (b.x < at); };
  FittedPoints fitted = around_body();
  for (int i = 0; i < 25; ++i)
    fitted.points.push_back(
        {{at + 0.01f * static_cast<float>(1 + i % 5), 0, 0.08f + 0.01f * static_cast<float>(i / 5)},
         {0, 1, 0}});
  fitted.weights.resize(fitted.points.size());
  for (PointWeights& weights : fitted.weights) weights.add(0, 1);
  const SurfaceLists surfaces = prepare_fitted(body_on_a_floor(), 0, fitted, walled).surfaces;
  for (float x = -0.3f; x < at - 0.05f; x += 0.05f) {
    const std::vector<vec3> places = lighting(surfaces, {x, 0, 0.1f});
    EXPECT_GE(std::ranges::count_if(places, [](const vec3& p) { return p.x < at; }), 3) << x;
  }
}

TEST(SurfaceLists, TheFloorUnderAWallHasNoSay) {
  // A few samples are asked first. All of them may see a point that those within the wall, fewer, do not.
  FittedPoints fitted = around_body();
  fitted.points.pop_back(), fitted.weights.pop_back();
  scene::Scene scene = body_on_a_floor();
  for (int shift = 0; shift < 40; ++shift) {
    const float at = 0.005f * static_cast<float>(shift);
    const vec3 below(at, -0.1f, -3), top(at + 0.14f, 1.2f, 3);
    scene.meshes[1] = scene::make_box(below, top);
    scene.meshes[1].material = 0;
    const auto sees = [&](const vec3& a, const vec3& b) { return misses(below, top, a, b); };
    const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, sees).surfaces;
    for (const float x : {at - 0.004f, top.x + 0.004f})
      for (float z = -1; z < 1; z += 0.05f)
        EXPECT_GE(lighting(surfaces, {x, 0, z}).size(), 2u) << x << " " << z << " beside a wall at " << at;
  }
}

TEST(SurfaceLists, APictureBeforeAWallHasItsOwnPoints) {
  // Its front, its back and the wall lie in one part of a cell, by turns with a border between two of them.
  for (int shift = 0; shift < 10; ++shift) {
    const float height = 0.004f * static_cast<float>(shift);
    const vec3 back(-2, height + 0.01f, -2), front(2, height + 0.025f, 2);
    FittedPoints fitted;
    for (int i = 0; i < 128; ++i) {
      const float y = i < 64 ? height : front.y;
      fitted.points.push_back(
          {{0.5f * static_cast<float>(i % 8) - 1.75f, y, 0.5f * static_cast<float>(i / 8 % 8) - 1.75f},
           {0, 1, 0}});
      fitted.weights.emplace_back().add(0, 1);
    }
    scene::Scene scene = body_on_a_floor();
    scene.meshes[0] = scene::make_quad({-3, height, -3}, {0, 0, 6}, {6, 0, 0});
    scene.meshes[1] = scene::make_box(back, front);
    for (scene::Mesh& mesh : scene.meshes) mesh.material = 0;
    const auto sees = [&](const vec3& a, const vec3& b) { return misses(back, front, a, b); };
    const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, sees).surfaces;
    const std::vector<vec3> places = lighting(surfaces, {0.1f, front.y, 0.15f});
    EXPECT_GE(places.size(), 4u) << shift;
    for (const vec3& p : places) EXPECT_EQ(p.y, front.y) << shift;
  }
}

TEST(SurfaceLists, SheetsOfOneCellHaveTheirOwnPoints) {
  // Five sheets across an axis: what faces along it sees its own gap alone
  constexpr float gap = 0.05f;
  const auto sees = [](const vec3& a, const vec3& b) {
    return std::floor(a.x / gap) == std::floor(b.x / gap);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto turned = [&](vec3 v) {
      for (int k = 0; k < axis; ++k) v = {v.z, v.x, v.y};
      return v;
    };
    const auto turned_back = [&](vec3 v) {
      for (int k = 0; k < axis; ++k) v = {v.y, v.z, v.x};
      return v;
    };
    scene::Scene scene = body_on_a_floor();
    scene.instances.clear(), scene.meshes.clear();
    FittedPoints fitted;
    for (int sheet = 0; sheet < 5; ++sheet) {
      const float x = gap * static_cast<float>(sheet) + 0.002f;
      scene.meshes.push_back(
          scene::make_quad(turned({x, -0.1f, 0}), turned({0, 1.2f, 0}), turned({0, 0, 1.2f})));
      scene.meshes.back().material = 0;
      scene.instances.push_back({sheet, 0, -1, ""});
      for (int i = 0; i < 64; ++i) {
        fitted.points.push_back(
            {turned({x, 0.25f * static_cast<float>(i % 8) - 0.9f, 0.25f * static_cast<float>(i / 8) + 0.1f}),
             turned({1, 0, 0})});
        fitted.weights.emplace_back().add(0, 1);
      }
    }
    const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, [&](const vec3& a, const vec3& b) {
                                    return sees(turned_back(a), turned_back(b));
                                  }).surfaces;
    for (int sheet = 0; sheet < 5; ++sheet) {
      const vec3 x(gap * static_cast<float>(sheet) + 0.002f, 0.33f, 0.77f);
      const std::vector<vec3> places = lighting(surfaces, turned(x), turned({1, 0, 0}));
      EXPECT_GE(places.size(), 4u) << "sheet " << sheet << " across axis " << axis;
      for (const vec3& p : places) EXPECT_NEAR(turned_back(p).x, x.x, 1e-5f);
    }
  }
}

TEST(SurfaceLists, TheMiddleOfWhatLiesInABox) {
  const StillTriangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(middle_within(t, vec3(-1), vec3(5)), vec3(4, 4, 0) / 3.0f);
  // A sliver of it, a square and nothing
  const std::optional<vec3> sliver = middle_within(t, {3.9f, -1, -1}, {5, 5, 1});
  ASSERT_TRUE(sliver);
  EXPECT_LT(glm::distance(*sliver, vec3(3.9f + 0.1f / 3, 0.1f / 3, 0)), 1e-5f);
  const std::optional<vec3> square = middle_within(t, {0, 0, -1}, {1, 1, 1});
  ASSERT_TRUE(square);
  EXPECT_LT(glm::distance(*square, vec3(0.5f, 0.5f, 0)), 1e-5f);
  EXPECT_FALSE(middle_within(t, {3, 3, -1}, {5, 5, 1}));
  EXPECT_FALSE(middle_within(t, {0, 0, 1}, {1, 1, 2}));
}

TEST(SurfaceLists, AFloorsLastFingerBeforeAWallHasTheRoomsPoints) {
  // The wall's foot covers the floor from 0 to 0.1; rays between its two sides are blocked, and those that
  // begin within it. Wherever a cell ends beside it, the room's last centimetre has the room's points.
  FittedPoints fitted;
  for (int i = 0; i < 80; ++i) {
    const vec3 place(0.25f * static_cast<float>(i % 16) - 1.775f, 0,
                     0.25f * static_cast<float>(i / 16) - 0.35f);
    if (place.x > 0 && place.x < 0.1f) continue;
    fitted.points.push_back({place, {0, 1, 0}});
    fitted.weights.emplace_back().add(0, 1);
  }
  const auto walled = [](const vec3& a, const vec3& b) {
    const auto side = [](const vec3& p) { return p.x <= 0 ? -1 : p.x >= 0.1f ? 1 : 0; };
    return side(a) == side(b) && side(a) != 0;
  };
  scene::Scene floor = body_on_a_floor();
  floor.instances.pop_back();
  floor.meshes[0] = scene::make_quad({-2, 0, -0.5f}, {0, 0, 1.5f}, {4, 0, 0});
  floor.meshes[0].material = 0;
  for (int shift = 0; shift < 42; ++shift) {
    // Moves the grid's cells against the wall
    scene::Scene scene = floor;
    scene.nodes[0].local.translation.x = -0.004f * static_cast<float>(shift);
    const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, walled).surfaces;
    for (const float x : {-0.001f, -0.004f, -0.008f, 0.101f, 0.104f, 0.108f}) {
      const std::vector<vec3> places = lighting(surfaces, {x, 0, 0.3f});
      EXPECT_GE(places.size(), 3u) << x << ", moved by " << shift;
      for (const vec3& p : places)
        EXPECT_EQ(p.x < 0.05f, x < 0.05f) << p.x << " from " << x << ", moved by " << shift;
    }
  }
}

TEST(SurfaceLists, BothSidesOfASheetAreAlike) {
  // All is seen, so that far points are left out by their weight alone.
  const auto lists = [](float side) {
    FittedPoints fitted = around_body();
    fitted.points.pop_back(), fitted.weights.pop_back();
    for (rays::SurfacePoint& point : fitted.points) point.normal = {0, side, 0};
    scene::Scene sheet = body_on_a_floor();
    sheet.instances.pop_back();
    return prepare_fitted(sheet, 0, fitted, [](const vec3&, const vec3&) { return true; }).surfaces;
  };
  const SurfaceLists above = lists(1), below = lists(-1);
  EXPECT_EQ(above.ranges, below.ranges);
  EXPECT_EQ(above.lists, below.lists);
  EXPECT_TRUE(std::ranges::any_of(above.lists, [](const uvec4& e) { return ~(e.y & e.z) != 0; }))
      << "some are left out";
}

/// Of the cells along x: what their lists hold, each cell with a weight of its own.
std::string row_text(const SurfaceLists& surfaces, int y, int z) {
  double points = 0, indices = 0, parts = 0, kinds = 0, spacing = 0;
  const ivec3& cells = surfaces.grids[0].cells;
  for (int x = 0; x < cells.x; ++x) {
    const double weight = 1 + 0.1 * x;
    const uvec2 range = surfaces.ranges[(z * cells.y + y) * cells.x + x];
    if (range.y == 0) continue;
    points += weight * range.y;
    for (unsigned i = 0; i < range.y; ++i) {
      const uvec4 e = surfaces.lists[range.x + i];
      indices += weight * (e.x & 0x7ffffu) * (1 + 0.01 * i);
      kinds += weight * (e.x >> 19);
      parts += weight * (std::popcount(e.y) + 1.3 * std::popcount(e.z) + 1e-9 * e.y);
      spacing += weight * static_cast<double>(std::bit_cast<float>(e.w));
    }
  }
  if (points == 0) return {};
  return fmt::format("row {} {}: {:.8g} points {:.8g}, seen from {:.8g}, of kinds {:.8g}, {:.8g} apart\n", y,
                     z, points, indices, parts, kinds, spacing);
}

TEST(SurfaceLists, ListsAreWhatTheyWere) {
  // Uneven points, a few without weights, on a floor that is turned, and on the body
  FittedPoints fitted = around_body();
  for (std::size_t i = 0; i < 100; ++i) {
    fitted.points[i].position +=
        vec3(0.03f * static_cast<float>(i % 7), 0, 0.05f * static_cast<float>(i % 3));
    if (i % 9 == 0) fitted.weights[i] = {};
  }
  for (int i = 0; i < 9; ++i) {
    fitted.points.push_back(
        {{high.x, 0.3f * static_cast<float>(i % 3) + 0.3f, 0.4f * static_cast<float>(i / 3) - 0.4f},
         {1, 0, 0}});
    fitted.weights.emplace_back().add(0, 1);
  }
  scene::Scene scene = body_on_a_floor();
  scene.nodes[0].local.rotation = glm::angleAxis(0.05f, vec3(0, 0, 1));
  scene.instances[1].node = -1;
  const SurfaceLists surfaces = prepare_fitted(scene, 0, fitted, misses_body).surfaces;
  EXPECT_EQ(surfaces.points.size(), 98u) << "of 110, twelve have no weight";
  const auto& [origin, cell_size, cells, first] = surfaces.grids[0];
  std::string text = fmt::format("cells of {} from {} {} {}: {} {} {}\n", cell_size, origin.x, origin.y,
                                 origin.z, cells.x, cells.y, cells.z);
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y) text += row_text(surfaces, y, z);
#ifndef __clang__  // fuses other products: what lies in the middle between two parts falls into the other one
  test::expect_text_of("libs/probes/tests/expected/fitted.txt", text);
#endif
}

}  // namespace
}  // namespace ssphh::probes
