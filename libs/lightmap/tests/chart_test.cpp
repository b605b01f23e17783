#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/random.h>

#include "error_message.h"
#include "rooms.h"

namespace ssphh::lightmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

scene::Mesh one_triangle() {
  scene::Mesh mesh;
  mesh.name = "one";
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// A unit square of two triangles whose second coordinates are as given, corner by corner.
scene::Mesh square(const std::vector<vec2>& uvs) {
  scene::Mesh mesh = scene::make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.name = "square";
  mesh.uvs[1] = uvs;
  return mesh;
}

bool covers(const FlatTriangle& t, const vec2& p) {
  const auto side = [&](int k) {
    const vec2 a = t.at[k], b = t.at[(k + 1) % 3];
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  const float s[3] = {side(0), side(1), side(2)};
  constexpr float within = 1e-6f;  // not on a border
  return (s[0] > within && s[1] > within && s[2] > within) ||
         (s[0] < -within && s[1] < -within && s[2] < -within);
}

/// Each triangle once, edges as long as in the world or shorter, no two over each other.
void expect_sound(const scene::Mesh& mesh, const std::vector<Chart>& charts, float shortest) {
  std::set<std::uint32_t> seen;
  Pcg32 random(5);
  for (const Chart& chart : charts) {
    for (const FlatTriangle& t : chart.triangles) {
      EXPECT_TRUE(seen.insert(t.triangle).second);
      const uvec3& corners = mesh.triangles[t.triangle];
      for (int k = 0; k < 3; ++k) {
        const vec2 a = t.at[k], b = t.at[(k + 1) % 3];
        const float world = glm::length(mesh.positions[corners[k]] - mesh.positions[corners[(k + 1) % 3]]);
        EXPECT_LE(glm::length(b - a), world * 1.0001f + 1e-6f);
        EXPECT_GE(glm::length(b - a), shortest * world - 1e-6f);
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(a, vec2(-1e-5f))));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(a, chart.size + 1e-5f)));
      }
    }
    EXPECT_GE(chart.size.x, chart.size.y);
    for (int i = 0; i < 200; ++i) {
      const vec2 p = chart.size * vec2(random.uniform(), random.uniform());
      int count = 0;
      for (const FlatTriangle& t : chart.triangles) count += covers(t, p);
      EXPECT_LE(count, 1);
    }
  }
  EXPECT_EQ(seen.size(), mesh.triangles.size());
}

TEST(Charts, OneTriangleLiesInTheLeastRectangle) {
  const std::vector<Chart> charts = make_charts(scene_of({one_triangle()}), 0).charts;
  ASSERT_EQ(charts.size(), 1u);
  expect_sound(one_triangle(), charts, 1);
  // Of 3, 4, 5: along either leg 4 × 3, along the hypotenuse 5 × 2.4; all have 12 m².
  EXPECT_NEAR(charts[0].size.x * charts[0].size.y, 12, 1e-4f);
  EXPECT_EQ(charts[0].triangles[0].open, 7);
}

TEST(Charts, ABoxHasOneForEachSide) {
  const scene::Mesh box = scene::make_box({0, 0, 0}, {1, 2, 3});
  const std::vector<Chart> charts = make_charts(scene_of({box}), 0).charts;
  ASSERT_EQ(charts.size(), 6u);
  expect_sound(box, charts, 1);
  float area = 0;
  for (const Chart& chart : charts) area += chart.size.x * chart.size.y;
  EXPECT_NEAR(area, 22, 1e-3f);
  for (const Chart& chart : charts) {
    ASSERT_EQ(chart.triangles.size(), 2u);
    for (const FlatTriangle& t : chart.triangles) EXPECT_EQ(__builtin_popcount(t.open), 2);
  }
}

TEST(Charts, CurvedThingsFallIntoSeveralThatStretchLittle) {
  const ChartParams params;
  const float shortest = std::cos(params.cone);  // an edge along the steepest slope
  for (const scene::Mesh& mesh : {scene::make_sphere(1, 32, 16), scene::make_torus(1, 0.3f, 32, 16),
                                  scene::make_spiral(0.5f, 0.5f, 2, 3, 0.1f, 100, 12)}) {
    const std::vector<Chart> charts = make_charts(scene_of({mesh}), 0).charts;
    expect_sound(mesh, charts, shortest);
    EXPECT_GT(charts.size(), 3u);
    EXPECT_LT(charts.size(), mesh.triangles.size() / 8);
  }
}

TEST(Charts, AreCutByDefaultWhereLightWouldNotBlend) {
  const ChartParams params;
  EXPECT_EQ(params.uvs, UvChoice::automatic);
  EXPECT_EQ(params.crease, 0.35f) << "20 degrees";
  EXPECT_EQ(params.cone, 0.87f) << "50 degrees";
}

TEST(Charts, ASurfaceThatWindsAboveItselfIsCutAndNotLaidOnItself) {
  // Three turns of a ramp: all normals point up, and all triangles hang together.
  scene::Mesh ramp;
  for (int i = 0; i <= 90; ++i) {
    const float turn = 2 * pi * static_cast<float>(i) / 30;
    for (const float r : {1.0f, 2.0f})
      ramp.positions.emplace_back(r * std::cos(turn), 0.02f * static_cast<float>(i), -r * std::sin(turn));
    const auto v = static_cast<std::uint32_t>(2 * i);
    if (i < 90) ramp.triangles.insert(ramp.triangles.end(), {{v, v + 1, v + 2}, {v + 1, v + 3, v + 2}});
  }
  const std::vector<Chart> charts = make_charts(scene_of({ramp}), 0).charts;
  expect_sound(ramp, charts, 0.6f);
  EXPECT_GE(charts.size(), 3u);
  EXPECT_LE(charts.size(), 12u);
}

TEST(Charts, TrianglesWithoutAreaHaveNone) {
  scene::Mesh mesh = one_triangle();
  mesh.positions.emplace_back(1.5f, 0, 0);
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 0, 1}, {0, 3, 1}});
  const std::vector<Chart> charts = make_charts(scene_of({mesh}), 0).charts;
  ASSERT_EQ(charts.size(), 1u);
  ASSERT_EQ(charts[0].triangles.size(), 1u);
  EXPECT_EQ(charts[0].triangles[0].triangle, 2u);
  mesh.triangles.pop_back();
  EXPECT_TRUE(make_charts(scene_of({mesh}), 0).charts.empty());
}

TEST(Charts, AHundredThousandTriangles) {
  const scene::Mesh mesh = scene::make_sphere(1, 320, 160);
  ASSERT_GT(mesh.triangles.size(), 100000u);
  std::size_t count = 0;
  const std::vector<Chart> charts = make_charts(scene_of({mesh}), 0).charts;
  for (const Chart& chart : charts) count += chart.triangles.size();
  EXPECT_EQ(count, mesh.triangles.size());
  EXPECT_LT(charts.size(), 200u);
}

TEST(Charts, IslandsOfTheScenesCoordinatesAreAsLargeAsTheirSurface) {
  const scene::Mesh mesh = square({{0.1f, 0.1f}, {0.3f, 0.1f}, {0.3f, 0.3f}, {0.1f, 0.3f}});
  const std::vector<Chart> charts =
      make_charts(scene_of({mesh}, mat4(mat3(2))), 0, {.uvs = UvChoice::scene}).charts;
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_NEAR(charts[0].size.x, 2, 1e-4f);
  EXPECT_NEAR(charts[0].size.y, 2, 1e-4f);
  // Its triangles reach from rim to rim
  vec2 least(9), most(-9);
  for (const FlatTriangle& triangle : charts[0].triangles)
    for (const vec2& at : triangle.at) least = glm::min(least, at), most = glm::max(most, at);
  EXPECT_LT(glm::distance(least, vec2(0)), 1e-4f);
  EXPECT_LT(glm::distance(most, charts[0].size), 1e-4f);
}

TEST(Charts, CoordinatesOfTheSceneThatAreNotFitAreRefusedOrReplaced) {
  scene::Mesh folded = square({{0, 0}, {1, 0}, {1, 1}, {0.9f, 0.1f}});
  EXPECT_THAT(second_uvs_problem(folded), HasSubstr("overlap, triangle 1"));
  EXPECT_THAT(second_uvs_problem(square({{0, 0}, {1.5f, 0}, {1, 1}, {0, 1}})),
              HasSubstr("(1.5, 0), triangle 0"));
  EXPECT_THAT(second_uvs_problem(square({{0, 0}, {1, 1}, {1, 1}, {0, 1}})), HasSubstr("without area"));
  EXPECT_THAT(second_uvs_problem(square({{0, 0}, {std::nanf(""), 0}, {1, 1}, {0, 1}})), HasSubstr("outside"));
  EXPECT_THAT(second_uvs_problem(one_triangle()), HasSubstr("no second"));
  EXPECT_THAT(second_uvs_problem(square({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), IsEmpty());

  const scene::Scene scene = scene_of({folded});
  EXPECT_EQ(
      test::message_of([&] { make_charts(scene, 0, {.uvs = UvChoice::scene}); }),
      "mesh \"square\": has second texture coordinates that overlap, triangle 1 (unwrap it anew, or let own "
      "charts be made (--uvs own))");
  const Charts own = make_charts(scene, 0);
  ASSERT_EQ(own.charts.size(), 1u);
  EXPECT_NEAR(own.charts[0].size.x, 1, 1e-5f);
}

TEST(Charts, WhatMovesShinesOrIsClearHasNone) {
  scene::Scene scene = scene_of(std::vector<scene::Mesh>(5, one_triangle()));
  scene.materials.resize(5);
  for (int i = 0; i < 5; ++i) scene.instances[i].material = i;
  scene.nodes[0].movable = true;
  scene.materials[1].unlit = true;
  scene.materials[2].transmission = 1;
  scene.textures.resize(1);
  scene.textures[0].width = scene.textures[0].height = 1, scene.textures[0].rgba.assign(4, 255);
  scene.materials[3].base_color_texture = {.texture = 0, .uv_set = 1};
  scene.materials[3].normal_texture = {.texture = 0, .uv_set = 0};
  const Charts charts = make_charts(scene, 0);
  ASSERT_EQ(charts.charts.size(), 1u);
  EXPECT_EQ(charts.charts[0].instance, 4u);
  EXPECT_THAT(
      charts.notes,
      ElementsAre("no lightmap for 1 surface: it is clear glass", "no lightmap for 1 surface: it is unlit",
                  "no lightmap for 1 surface: it moves",
                  "no lightmap for 1 surface: its textures take both sets of coordinates, which leaves none "
                  "for a lightmap"));
}

TEST(Charts, StopWhenAsked) {
  CancelToken stop;
  stop.request();
  EXPECT_THROW(make_charts(scene_of({one_triangle()}), 0, {}, {}, {nullptr, &stop}), Cancelled);
}

}  // namespace
}  // namespace ssphh::lightmap
