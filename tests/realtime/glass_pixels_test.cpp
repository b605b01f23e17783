/// Panes as OpenGL draws them, pixel by pixel against closed forms, and light that goes through them.

#include "glass_pixels.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "picture_bounds.h"

namespace ssphh::test {
namespace {

shading::GlassShares shares_of(const scene::Material& m, float cosine) {
  shading::GlassParams glass;
  glass.share = 1, glass.tint = m.base_color, glass.ior = m.ior, glass.sheet = m.thickness == 0;
  return shading::glass_shares(glass, cosine);
}

TEST_F(GlassPixels, PanesDimWhatIsBehindThemAndReflectTheSky) {
  const scene::Material first = pane({0.9f, 0.7f, 1}), second = pane({0.5f, 1, 0.8f});
  for (const bool two : {false, true}) {
    const scene::Scene scene = before_a_wall(two ? std::vector{first, second} : std::vector{first});
    const image::Image drawn = draw(scene);
    const std::vector<rays::RayQuery> rays = pixel_rays(scene::camera_pose(scene, ""), glass_size);
    image::Image expected(glass_size.width, glass_size.height, 3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const float cosine = -rays[i].direction.z;
      const shading::GlassShares near = shares_of(first, cosine);
      vec3 value = glow * near.transmitted;
      if (two) value *= shares_of(second, cosine).transmitted;
      value += near.reflected * sky;  // of the nearest pane alone
      const int x = static_cast<int>(i) % glass_size.width, y = static_cast<int>(i) / glass_size.width;
      expected.set_rgb(x, y, value);
    }
    // What is reflected is kept in 10 bits of its root: up to 0.4 % of it, 1 % of the sky at these angles.
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
      EXPECT_NEAR(drawn.pixels[i], expected.pixels[i], 4e-3f) << i << (two ? " of two" : "");
  }
}

TEST_F(GlassPixels, WhatIsHalfGlassOrLessIsASurface) {
  scene::Material thin = pane(vec3(0.5f));
  thin.transmission = 0.25f, thin.specular = 0;
  const image::Image drawn = draw(before_a_wall({thin}));
  // Its opaque share, in the open under an even sky.
  const vec3 expected = 0.75f * 0.5f * sky;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(drawn.at(glass_size.width / 2, glass_size.height / 2)[c], expected[c], 0.02f * expected[c]);
}

TEST_F(GlassPixels, LightGoesThroughPanesAndIsHeldBackByWhatIsMostlyNone) {
  scene::Light sun;
  sun.type = scene::LightType::directional, sun.intensity = 3;
  const auto lit_through = [&](scene::Material roof) {
    scene::Scene s = stage(matte(vec3(0.5f)));
    s.materials.push_back(roof);
    add_mesh(s, scene::make_quad({-20, 9, 20}, {40, 0, 0}, {0, 0, -40}), 4);
    add_stage_lamp(s, sun);
    return draw(s);
  };
  scene::Material absent = matte(vec3(1)), veil = pane(vec3(1));
  absent.alpha_mode = scene::AlphaMode::mask, absent.alpha = 0;
  veil.transmission = 0.25f;
  const float passed = shares_of(pane(vec3(1)), -stage_lamp_axis.y).transmitted.x;
  const image::Image clear = lit_through(pane(vec3(1))), open = lit_through(absent);
  for (std::size_t i = 0; i < open.pixels.size(); ++i)
    ASSERT_NEAR(clear.pixels[i], passed * open.pixels[i], 0.003f * open.pixels[i]) << "of 8 bits: 0.2 %";
  EXPECT_THAT(lit_through(veil).pixels, testing::Each(0));
}

/// The stage, with a tinted pane at a slant above it if `covered`, lit from over it: by the lamp, or without
/// one by an even sky.
scene::Scene under_a_pane(const scene::Light* lamp, bool covered) {
  scene::Scene s = stage(matte(vec3(0.6f, 0.7f, 0.8f)));
  s.materials.push_back(pane({0.8f, 0.5f, 0.2f}));
  if (!covered) s.materials.back().alpha_mode = scene::AlphaMode::mask, s.materials.back().alpha = 0;
  add_mesh(s, scene::make_quad({-40, 7, 40}, {80, 2, 0}, {0, 0, -80}),
           static_cast<int>(s.materials.size()) - 1);
  if (lamp) {
    add_stage_lamp(s, *lamp);
    if (lamp->type != scene::LightType::directional)
      s.nodes[s.lights.back().node].local.translation = {0.5f, 12, 0.5f};
  } else {
    s.environment.emplace().color = sky;
  }
  scene::validate(s);
  return s;
}

TEST_F(GlassPixels, LightOfEveryKindOfLampIsTintedAsItIsTraced) {
  using enum scene::LightType;
  const auto share_drawn = [&](const scene::Light* lamp) {
    return sum_of(draw(under_a_pane(lamp, true))) / sum_of(draw(under_a_pane(lamp, false)));
  };
  const auto share_traced = [&](const scene::Light* lamp) {
    vec3 sums[2];
    for (const bool covered : {false, true}) {
      const scene::Scene s = under_a_pane(lamp, covered);
      sums[covered] = sum_of(traced(s, 1));
    }
    return sums[1] / sums[0];
  };
  for (const scene::LightType type : {directional, point, sphere}) {
    for (const float radius : {0.0f, 0.02f}) {
      if (type != directional && radius > 0) continue;
      SCOPED_TRACE(fmt::format("{} {}", name_of(type), radius));
      scene::Light lamp;
      lamp.type = type, lamp.intensity = 40, lamp.color = {1, 0.8f, 0.6f};
      lamp.angular_radius = radius, lamp.radius = 0.5f;
      const vec3 drawn = share_drawn(&lamp), traced = share_traced(&lamp);
      // 8 bits of the maps
      for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], traced[c], 0.004f) << c;
    }
  }
  // A sky is 32 directions, those that graze the pane among them
  const vec3 drawn = share_drawn(nullptr), traced = share_traced(nullptr);
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], traced[c], 0.04f) << c;
}

}  // namespace
}  // namespace ssphh::test
