/// Rough panes as OpenGL draws them, pixel by pixel against path tracing.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "glass_pixels.h"

namespace ssphh::test {
namespace {

/// A tinted pane of this roughness across the picture, before a wall.
scene::Scene behind_frost(float roughness) {
  scene::Scene s;
  s.materials = {matte(vec3(0)), pane({0.9f, 0.7f, 0.5f})};
  s.materials[1].specular_roughness = roughness;
  add_mesh(s, scene::make_quad({-40, -40, -8}, {80, 0, 0}, {0, 80, 0}), 0);
  add_mesh(s, scene::make_quad({-40, -40, -5}, {80, 0, 0}, {0, 80, 0}), 1);
  s.nodes.emplace_back();
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].yfov = 1.2f;
  return s;
}

TEST_F(GlassPixels, RoughPanesSpreadWhatIsBehindThem) {
  const auto squares = [](float roughness) {
    scene::Scene s = behind_frost(roughness);
    for (int i = 0; i < 4; ++i) {
      const float x = static_cast<float>(i % 2), y = static_cast<float>(i / 2);
      s.materials.push_back(matte(vec3(0)));
      s.materials.back().emission = vec3(0.2f + 0.6f * x, 0.3f + 0.5f * y, 0.5f);
      add_mesh(s, scene::make_quad({3 * x - 2.5f, 2 * y - 2, -7.9f}, {2, 0, 0}, {0, 1, 0}),
               static_cast<int>(s.materials.size()) - 1);
    }
    scene::validate(s);
    return s;
  };
  const image::Image sharp = draw(squares(0));
  for (const float roughness : {0.25f, 0.55f}) {
    SCOPED_TRACE(roughness);
    const scene::Scene s = squares(roughness);
    const image::Image truth = traced(s, 1, 512), drawn = draw(s, 4);
    EXPECT_LT(off(drawn, truth), 0.1);
    EXPECT_GT(off(sharp, truth), 0.3);
    const vec3 ratio = sum_of(drawn) / sum_of(truth);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1, 0.03f) << c;
  }
}

TEST_F(GlassPixels, LampsOfEveryKindShineThroughRoughPanes) {
  using enum scene::LightType;
  for (const scene::LightType type : {directional, point, spot, sphere}) {
    for (const float radius : {0.0f, 0.02f}) {
      if (type != directional && radius > 0) continue;
      SCOPED_TRACE(fmt::format("{} {}", name_of(type), radius));
      scene::Light lamp;
      lamp.type = type, lamp.intensity = 5, lamp.color = {1, 0.8f, 0.6f};
      lamp.angular_radius = radius, lamp.radius = 0.1f, lamp.outer_cone = 1.2f;
      scene::Scene s = behind_frost(0.5f);
      s.nodes.emplace_back().local.translation = {0.5f, 0.3f, -6.5f};
      s.nodes.back().local.rotation = glm::quatLookAt(glm::normalize(vec3(0.1f, -0.2f, 1)), vec3(0, 1, 0));
      if (type == directional) s.instances.erase(s.instances.begin());  // the wall before it
      lamp.node = static_cast<int>(s.nodes.size()) - 1;
      s.lights = {lamp};
      scene::validate(s);
      const image::Image truth = traced(s, 1), drawn = draw(s, 4);
      EXPECT_LT(off(drawn, truth), 0.03);
    }
  }
}

TEST_F(GlassPixels, WhatRoughPanesSeeBesideThePictureIsTheSky) {
  // A slit shows little of what a rough pane behind it sees
  scene::Scene s = behind_frost(0.6f);
  s.instances.erase(s.instances.begin());
  s.environment.emplace().color = sky;
  for (const float x : {-40.5f, 0.5f}) add_mesh(s, scene::make_quad({x, -40, -4}, {40, 0, 0}, {0, 80, 0}), 0);
  scene::validate(s);
  const image::Image truth = traced(s, 1), drawn = draw(s, 4);
  const int x = glass_size.width / 2, y = glass_size.height / 2;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn.at(x, y)[c], truth.at(x, y)[c], 0.06f * truth.at(x, y)[c]);
}

}  // namespace
}  // namespace ssphh::test
