/// Direct light at the middle of every pixel, in colour: what OpenGL draws against closed forms and the light
/// of transport, neither of which has noise.

#include <gmock/gmock.h>

#include <ssphh/shading/bsdf.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage_lamps.h"

namespace ssphh::test {
namespace {

constexpr PictureSize lamp_size{80, 48};

/// Of the G-buffer: 10 bits of a colour's root err by 0.1 % / root, of albedos over 0.2; sums of halves by
/// 0.05 % each. Normals of 16 bits err by 3e-5 rad, which counts at grazing angles: a constant.
constexpr float lamp_rounding = 0.004f;

StageLamp shining_sphl() {
  for (const StageLamp& lamp : lamps_without_extent()) {
    if (lamp.light.type == scene::LightType::sphl) return lamp;
  }
  return {};
}

StageLamp stage_sun() {
  for (const StageLamp& lamp : lamps_without_extent()) {
    if (lamp.light.type == scene::LightType::directional) return lamp;
  }
  return {};
}

class LampPixels : public WithGl {
 protected:
  static image::Image draw(realtime::Renderer& renderer, const scene::Scene& scene,
                           PictureSize size = lamp_size) {
    realtime::FrameSettings settings;
    settings.view = realtime::View::direct;
    settings.sky = realtime::Sky::black;
    renderer.draw(scene::camera_pose(scene, ""), settings, {.width = size.width, .height = size.height});
    return renderer.read_back();
  }

  /// The pixels of the stage's wall at z = -2 that `asked` wants by their places, and how many of them a sun
  /// lights.
  struct Wall {
    int pixels = 0, lit = 0;
  };
  template <class Asked>
  Wall wall_lit_by(scene::Scene& scene, float radius, const vec3& toward_sun, PictureSize size,
                   const realtime::RendererParams& params, const Asked& asked) {
    scene::Light sun = stage_sun().light;
    sun.angular_radius = radius;
    add_stage_lamp(scene, sun);
    scene.nodes.back().local.rotation = glm::quatLookAt(-glm::normalize(toward_sun), vec3(0, 0, 1));
    const trace::TransportScene source(scene);
    const PixelPoints points(source, scene::camera_pose(scene, ""), size);
    realtime::Renderer renderer(gl(), scene, params);
    const image::Image drawn = draw(renderer, scene, size);
    Wall wall;
    for (const PixelPoint& p : points.pixels) {
      const vec3& x = p.point.position;
      if (p.hit.escaped() || p.point.normal.z < 0.9f || std::abs(x.z + 2) > 1e-3f || !asked(x)) continue;
      const int i = static_cast<int>(points.index(p));
      ++wall.pixels, wall.lit += max_component(drawn.rgb(i % size.width, i / size.width)) > 0;
    }
    return wall;
  }
};

/// What may be drawn of a lamp's light: shadows' edges may lie a pixel aside, and are few.
PictureBounds bounds_of(const LampPicture& truth) {
  PictureBounds bounds = PictureBounds::around(truth.picture, lamp_rounding,
                                               2e-3f * static_cast<float>(mean_luminance(truth.picture)));
  EXPECT_LT(bounds.widen([&](int x, int y) { return truth.edge_at(x, y); }), 0.15);
  return bounds;
}

class LampWithoutExtent : public LampPixels, public testing::WithParamInterface<StageLamp> {};

TEST_P(LampWithoutExtent, LightsEveryPixelAsItsClosedFormSays) {
  for (const bool parallel : {false, true}) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    add_stage_lamp(scene, GetParam().light);
    scene.cameras[0].orthographic = parallel, scene.cameras[0].yheight = 3.5f;
    const LampPicture truth(scene, lamp_size, GetParam().arriving, lambertian);
    realtime::Renderer renderer(gl(), scene);
    EXPECT_TRUE(picture_is(draw(renderer, scene), bounds_of(truth)))
        << (parallel ? "orthographic" : "perspective");
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, LampWithoutExtent, testing::ValuesIn(lamps_without_extent()),
                         [](const auto& given) { return given.param.name; });

TEST_F(LampPixels, OfASunThatShinesOnAPlainAreAsExactBeforeIt) {
  scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
  add_mesh(scene, scene::make_quad({-2e3f, -0.02f, 2e3f}, {4e3f, 0, 0}, {0, 0, -4e3f}), 0);
  const StageLamp sun = stage_sun();
  add_stage_lamp(scene, sun.light);
  const LampPicture truth(scene, lamp_size, sun.arriving, lambertian);
  realtime::Renderer renderer(gl(), scene);
  EXPECT_TRUE(picture_is(draw(renderer, scene), bounds_of(truth)));
}

TEST_F(LampPixels, OfASmallGlowingBallAreTheSameBeforeAWidePlain) {
  // Its points stand off it by what the shadow maps of the scene need, and by no more than suits the ball.
  const auto drawn = [&](bool plain) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    scene::Material glow = matte(vec3(0));
    glow.emission = {50, 40, 15};
    scene.materials.push_back(glow);
    add_mesh(scene, scene::make_sphere(0.1f, 16, 12), static_cast<int>(scene.materials.size()) - 1,
             {0.4f, 1.5f, 0});
    if (plain) add_mesh(scene, scene::make_quad({-2e3f, -9, 2e3f}, {4e3f, 0, 0}, {0, 0, -4e3f}), 0);
    realtime::Renderer renderer(gl(), scene);
    return draw(renderer, scene);
  };
  const image::Image alone = drawn(false), before = drawn(true);
  const auto mean = static_cast<float>(mean_luminance(alone));
  int compared = 0, off = 0;
  for (int y = 0; y < lamp_size.height; ++y) {
    for (int x = 0; x < lamp_size.width; ++x) {
      const float a = luminance(alone.rgb(x, y)), b = luminance(before.rgb(x, y));
      if (!(a > 0.1f * mean)) continue;
      ++compared, off += std::abs(b - a) > 0.05f * a;
    }
  }
  EXPECT_GT(compared, 1000);
  // What stands within the maps' near plane, here 1.4 m, casts no shadow.
  EXPECT_LT(off, compared / 8);
}

TEST_F(LampPixels, OfASunThatRunsAlongAWallAreDarkUnderItsEaves) {
  for (const float radius : {0.0f, 0.0046f}) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    add_mesh(scene, scene::make_box({-6, 3, -2}, {6, 3.1f, -1.5f}), 0);
    add_mesh(scene, scene::make_quad({-60, -0.02f, 60}, {120, 0, 0}, {0, 0, -120}), 0);
    const Wall under = wall_lit_by(scene, radius, {0.3f, 1, 0.02f}, lamp_size, {},
                                   [](const vec3& x) { return x.y <= 2.9f; });
    EXPECT_GT(under.pixels, 500);
    EXPECT_EQ(under.lit, 0) << "of a sun with a radius of " << radius;
  }
}

TEST_F(LampPixels, OfASunAreDarkInCornersThatItsMapDoesNotTell) {
  // A texel's width beside a fin: what a map of this size cannot tell from the wall, the picture shows.
  for (const float radius : {0.0f, 0.0046f}) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    add_mesh(scene, scene::make_box({1, 0, -2}, {1.1f, 2.5f, -1.7f}), 0);
    realtime::RendererParams params;
    params.sun_map_size = 128;
    const Wall beside = wall_lit_by(scene, radius, {1, 0.2f, 0.8f}, {320, 192}, params,
                                    [](const vec3& x) { return x.x >= 0.75f && x.x <= 1 && x.y <= 2; });
    EXPECT_GT(beside.pixels, 200);
    EXPECT_EQ(beside.lit, 0) << "of a sun with a radius of " << radius;
  }
}

TEST_F(LampPixels, WhatStandsWithinAnSphlShadowsNothing) {
  const StageLamp lamp = shining_sphl();
  const auto scene_with = [&](float radius, bool box) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    if (box)
      add_mesh(scene, scene::make_box(vec3(-0.1f), vec3(0.1f)), 0,
               stage_lamp_place + 0.25f * stage_lamp_axis);
    scene::Light light = lamp.light;
    light.radius = radius;
    add_stage_lamp(scene, light);
    return scene;
  };
  const auto drawn = [&](const scene::Scene& scene) {
    realtime::Renderer renderer(gl(), scene);
    return draw(renderer, scene);
  };
  const scene::Scene boxed = scene_with(0.5f, true);
  const trace::TransportScene source(boxed);
  const PixelPoints points(source, scene::camera_pose(boxed, ""), lamp_size);
  const image::Image open = drawn(scene_with(0.5f, false)), within = drawn(boxed),
                     beyond = drawn(scene_with(0.05f, true));
  int differ_within = 0, differ_beyond = 0;
  for (int y = 0; y < lamp_size.height; ++y) {
    for (int x = 0; x < lamp_size.width; ++x) {
      if (glm::distance(points.at(x, y).point.position, stage_lamp_place) < 0.5f) continue;
      differ_within += max_component(glm::abs(within.rgb(x, y) - open.rgb(x, y))) > 1e-3f;
      differ_beyond += max_component(glm::abs(beyond.rgb(x, y) - open.rgb(x, y))) > 1e-3f;
    }
  }
  EXPECT_EQ(differ_within, 0);
  EXPECT_GT(differ_beyond, 100) << "of a smaller SPHL the box stands in the way";
}

TEST_F(LampPixels, FollowsTheFramesOfAnSphl) {
  scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
  const StageLamp lamp = shining_sphl();
  scene::Light light = lamp.light;
  light.emission.frames.push_back(light.emission.frames[0]);
  light.emission.frames[1] *= vec3(3, 1, 0);
  light.emission.rate = 1;
  add_stage_lamp(scene, light);
  realtime::Renderer renderer(gl(), scene);
  const image::Image before = draw(renderer, scene);
  renderer.set(scene::lighting_at(scene, 0.5f));
  const image::Image after = draw(renderer, scene);
  double sum_before = 0, sum_after = 0;
  for (int y = 0; y < lamp_size.height; ++y) {
    for (int x = 0; x < lamp_size.width; ++x) {
      const vec3 a = before.rgb(x, y) * vec3(2, 1, 0.5f), b = after.rgb(x, y);
      EXPECT_LT(max_component(glm::abs(a - b)), 2e-3f * max_component(a) + 1e-4f) << x << " " << y;
      sum_before += static_cast<double>(a.x), sum_after += static_cast<double>(b.x);
    }
  }
  EXPECT_NEAR(sum_after / sum_before, 1, 1e-3);
}

TEST_F(LampPixels, EveryModelOfReflectionIsThatOfTheCpu) {
  struct Model {
    float diffuse, specular_roughness;
    float metallic, specular;
  };
  const StageLamp lamp = lamps_without_extent()[0];
  scene::Scene scene = stage(matte(vec3(1)));
  add_stage_lamp(scene, lamp.light);
  realtime::Renderer renderer(gl(), scene);
  for (const Model& m : {Model{0, 0.4f, 0, 1},
                         {0, -0.5f, 0, 1},
                         {0, 0.35f, 1, 1},
                         {-0.7f, 1, 0, 0},
                         {0.6f, 0.7f, 0.4f, 0.5f}}) {
    scene::Material material = matte({0.9f, 0.6f, 0.4f});
    material.diffuse_roughness = m.diffuse, material.specular_roughness = m.specular_roughness;
    material.metallic = m.metallic, material.specular = m.specular;
    scene.materials[stage_ball_material] = material;
    renderer.set_material(static_cast<int>(stage_ball_material), material);
    const shading::BsdfParams ball{material.base_color * (1 - m.metallic),
                                   glm::mix(vec3(0.04f * m.specular), material.base_color, m.metallic),
                                   m.diffuse, m.specular_roughness};
    const LampPicture truth(scene, lamp_size, lamp.arriving, [&](const PixelPoint& p, const vec3& wi) {
      if (!on_stage_ball(p.point)) return lambertian(p, wi);
      const Frame frame = Frame::around(stage_normal(p.point));
      return shading::eval_bsdf(ball, frame.to_local(p.wo), frame.to_local(wi));
    });
    EXPECT_TRUE(picture_is(draw(renderer, scene), bounds_of(truth)))
        << m.diffuse << ' ' << m.specular_roughness;
  }
}

TEST_F(LampPixels, ShadowsOfAMaskedLeafHaveItsHoles) {
  const StageLamp lamp = lamps_without_extent()[0];
  scene::Scene s = stage(matte({0.9f, 0.3f, 0.5f}));
  // Stripes, covered and not, on a leaf above the floor
  scene::Texture& stripes = s.textures.emplace_back();
  stripes.name = "stripes", stripes.width = 4, stripes.height = 1;
  stripes.rgba.assign(16, 255);
  stripes.rgba[7] = stripes.rgba[15] = 0;
  scene::Material leaf = matte(vec3(0.8f));
  leaf.alpha_mode = scene::AlphaMode::mask;
  leaf.base_color_texture.texture = 0;
  leaf.base_color_texture.nearest = true;
  s.materials.push_back(leaf);
  add_mesh(s, scene::make_quad({-0.2f, 1.6f, 1.6f}, {1.6f, 0, 0}, {0, 0, -1}), 4);
  add_stage_lamp(s, lamp.light);
  const LampPicture truth(s, lamp_size, lamp.arriving, lambertian);
  realtime::Renderer renderer(gl(), s);
  EXPECT_TRUE(picture_is(draw(renderer, s), bounds_of(truth)));
}

}  // namespace
}  // namespace ssphh::test
