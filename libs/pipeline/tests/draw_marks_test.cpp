// Marks over pictures: where they fall in each projection, what hides them, and what each method gives.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/probes/hier.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>

#include "error_message.h"

namespace ssphh::pipeline {
namespace {

using methods::Drawing;
using testing::HasSubstr;

/// A wall at z = −2 left of x = 0; the camera at the origin looks along −z.
scene::Scene half_a_wall() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.meshes.push_back(scene::make_quad({-5, -5, -2}, {5, 0, 0}, {0, 10, 0}));
  scene.instances.push_back({0, 0, -1, ""});
  return scene;
}

class Projections : public testing::TestWithParam<trace::Projection> {
 protected:
  Projections() {
    params_.projection = GetParam();
    params_.height = 64, params_.width = GetParam() == trace::Projection::cube_strip ? 6 * 64 : 128;
    params_.camera.world = mat4(1);
    params_.camera.camera.yfov = pi / 2, params_.camera.camera.yheight = 4;
  }
  /// Pixels from the upper left, by the definition of each projection.
  vec2 place(const vec3& p) const {
    const vec2 size(params_.width, params_.height);
    const auto plane = [&](const vec2& at) {
      return vec2(0.5f * size.x + 0.5f * size.y * at.x, 0.5f * size.y * (1 - at.y));
    };
    switch (GetParam()) {
      case trace::Projection::pinhole:
        return plane(vec2(p) / -p.z);
      case trace::Projection::orthographic:
        return plane(vec2(p) / 2.0f);
      case trace::Projection::equirect:
        return size * image::equirect_uv(p);
      case trace::Projection::cube_strip: {
        const CubePoint at = cube_point(p);
        return size.y * vec2(static_cast<float>(at.face) + at.s, at.t);
      }
    }
    return {};
  }
  image::Image drawn(const sketch::Sketch& marks) const {
    const scene::Scene scene = half_a_wall();
    image::Image picture(params_.width, params_.height);
    draw_marks(picture, marks, std::make_shared<const trace::SceneGeometry>(scene), scene, 0, params_, 2);
    return picture;
  }
  trace::RenderParams params_;
};

TEST_P(Projections, ALineLiesWhereItsPointsAreAndIsDimmedBehindTheWall) {
  const vec3 a{-0.9f, 0.25f, -3}, b{0.9f, 0.6f, -3};
  const image::Image picture = drawn({.lines = {{a, b, {1, 0.5f, 0}, 3}}});
  int seen = 0;
  for (float t = 0.02f; t < 1; t += 0.01f) {
    if (std::abs(t - 0.5f) < 0.08f) continue;  // the wall's edge
    const vec2 at = place(glm::mix(a, b, t));
    const vec3 color = picture.rgb(static_cast<int>(at.x), static_cast<int>(at.y));
    const float opacity = t < 0.5f ? 0.25f : 1;
    EXPECT_NEAR(color.x, 2 * opacity, 1e-5f) << t;
    EXPECT_NEAR(color.y, opacity, 1e-5f) << t;
    ++seen;
  }
  EXPECT_GT(seen, 70);
  float total = 0;
  for (const float value : picture.pixels) total += value > 0;
  EXPECT_LT(total, 0.08f * static_cast<float>(picture.pixels.size())) << "and nowhere else";
}

INSTANTIATE_TEST_SUITE_P(All, Projections,
                         testing::Values(trace::Projection::pinhole, trace::Projection::orthographic,
                                         trace::Projection::equirect, trace::Projection::cube_strip));

/// So small that a test can make it.
std::vector<std::string> small(const methods::MethodEntry& entry) {
  std::vector<std::string> settings;
  for (const char* setting : {"probes=8", "face=8", "spp=2", "viz_spp=2", "photons=32", "resolution=8",
                              "directions=64", "rays=32", "edge=1", "records=64"}) {
    const std::string name(setting, std::string_view(setting).find('='));
    if (std::ranges::any_of(entry.parameters, [&](const auto& p) { return p.name == name; }))
      settings.emplace_back(setting);
  }
  return settings;
}

double number(const methods::Method& method, const std::string& name) {
  for (const auto& [known, value] : method.numbers())
    if (known == name) return value;
  return -1;
}

TEST(Drawings, EveryMethodGivesMarksOfWhatItLists) {
  const scene::Scene scene = scene::make_builtin("box");
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  for (const methods::MethodEntry& entry : methods::all_methods()) {
    LiveMethod live(entry.name, small(entry), geometry, scene, {});
    live.update(rays::lighting_at(live.source(), 0), {});
    for (const std::string& name : names_of<Drawing>()) {
      const Drawing what = *parse_enum<Drawing>(name);
      const bool listed = std::ranges::find(entry.drawings, what) != entry.drawings.end();
      const sketch::Sketch marks = live.method().drawing(what);
      EXPECT_EQ(!marks.empty(), listed) << entry.name << ' ' << name;
      const auto expect = [&](std::size_t count, const char* of) {
        EXPECT_EQ(static_cast<double>(count), number(live.method(), of)) << entry.name << ' ' << name;
      };
      if (!listed) continue;
      if (what == Drawing::tetrahedra || what == Drawing::hierarchy) expect(marks.balls.size(), "probes");
      if (what == Drawing::surfels) expect(marks.discs.size(), "surfels");
      if (what == Drawing::photons) expect(marks.balls.size(), "vpls");
      if (what == Drawing::voxels) expect(marks.boxes.size(), "voxels");
    }
  }
}

TEST(Drawings, TheHierarchyHasALineForEachPairThatHierTook) {
  probes::ProbeSet set;
  set.degree = 0;
  for (int i = 0; i < 3; ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position = {static_cast<float>(i), 0, 0};
    probe.self = sh::RadianceSh(0);
    for (const int from : {0, 1, 2})
      if (from != i)
        probe.edges.push_back(
            {.from = from, .transfer = from == 2 ? 1e-3f : 1.0f, .h = sh::RadianceSh(0), .matrix = {}});
  }
  const sketch::Sketch all = methods::hierarchy_drawing(set);
  ASSERT_EQ(all.lines.size(), 3u);
  EXPECT_EQ(all.balls.size(), 3u);
  EXPECT_EQ(all.lines[0].a, set.probes[0].position);
  EXPECT_EQ(all.lines[0].b, set.probes[1].position);
  EXPECT_EQ(all.lines[0].width, 4);
  probes::hier(set, {.neighbors = 0});
  EXPECT_TRUE(methods::hierarchy_drawing(set).lines.empty());
}

TEST(Drawings, WhatAMethodHasNotIsRefusedWithThoseThatHaveIt) {
  const Drawing voxels[] = {Drawing::voxels}, edges[] = {Drawing::hierarchy};
  EXPECT_EQ(test::message_of([&] { check_drawings("path", false, voxels); }),
            "--draw voxels: method path has none (take --method vct)");
  EXPECT_THAT(test::message_of([&] { check_drawings("vpl", false, edges); }),
              HasSubstr("take --method ssphh, ssphh-paper"));
  EXPECT_THAT(test::message_of([&] { check_drawings("ssphh", true, voxels); }),
              HasSubstr("a hierarchy alone"));
  check_drawings("ssphh", true, edges);
}

}  // namespace
}  // namespace ssphh::pipeline
