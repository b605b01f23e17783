/// Bodies of glass as OpenGL draws them: what they absorb, against closed forms; what they bend, against
/// paths.

#include <gtest/gtest.h>

#include "glass_pixels.h"
#include "picture_bounds.h"

namespace ssphh::test {
namespace {

/// Clear, but for what it absorbs; light goes on straight.
scene::Material jelly() {
  scene::Material m = pane(vec3(1));
  m.ior = 1, m.thickness = 0.01f, m.attenuation_color = {0.6f, 0.9f, 0.3f}, m.attenuation_distance = 2;
  return m;
}

struct Slab {
  vec3 low, high;

  /// The way of a ray through it, as far as `end`.
  float way(const vec3& origin, const vec3& direction, float end) const {
    const vec3 a = (low - origin) / direction, b = (high - origin) / direction;
    const vec3 near = glm::min(a, b), far = glm::max(a, b);
    return std::max(std::min(-max_component(-far), end) - std::max(max_component(near), 0.0f), 0.0f);
  }
};

vec3 left_after(float way) {
  return glm::exp(-shading::absorption_of(jelly()) * way);
}

TEST_F(GlassPixels, BodiesAbsorbByTheWayThroughThem) {
  // Before each other, with the wall's plane in one, and one whose node mirrors it
  const std::vector<Slab> slabs{
      {{-4, -2, -6}, {1, 1, -4}}, {{0, -1, -5}, {3, 3, -2}}, {{1, -4, -12}, {5, 2, -7}}};
  for (const bool parallel : {false, true}) {
    scene::Scene s = before_a_wall({jelly()});
    s.meshes.pop_back(), s.instances.pop_back();
    for (const Slab& slab : slabs) add_mesh(s, scene::make_box(slab.low, slab.high), 1);
    s.meshes.back() = scene::make_box({-5, -4, -12}, {-1, 2, -7});
    s.meshes.back().material = 1;
    s.nodes.back().local.scale.x = -1;
    s.cameras[0].orthographic = parallel, s.cameras[0].yheight = 9;
    s.environment.reset();
    const image::Image drawn = draw(s);
    const std::vector<rays::RayQuery> rays = pixel_rays(scene::camera_pose(s, ""), glass_size);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const vec3 d = glm::normalize(rays[i].direction);
      float way = 0;
      for (const Slab& slab : slabs) way += slab.way(rays[i].origin, d, (-9 - rays[i].origin.z) / d.z);
      const vec3 expected = glow * left_after(way);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(drawn.pixels[3 * i + static_cast<std::size_t>(c)], expected[c], 2e-3f)
            << i << " " << parallel;
    }
  }
}

TEST_F(GlassPixels, LightGoesThroughBodiesByTheWayThroughThem) {
  // From a lamp beside the eye in the middle of a room, through slabs all around and back
  const auto draw_toward = [&](int axis, float side, bool slabs) {
    scene::Scene s;
    s.materials = {matte(vec3(0.7f)), jelly()};
    if (!slabs) s.materials[1].alpha_mode = scene::AlphaMode::mask, s.materials[1].alpha = 0;
    add_mesh(s, scene::make_box(vec3(-3), vec3(3)), 0);
    for (int other = 0; other < 3; ++other) {
      for (const float there : {-1.0f, 1.0f}) {
        vec3 low(-1), high(1);
        low[other] = 1.1f * there - 0.1f, high[other] = 1.1f * there + 0.1f;
        add_mesh(s, scene::make_box(low, high), 1);
      }
    }
    scene::Node& eye = s.nodes.emplace_back();
    vec3 toward(0);
    toward[axis] = side;
    eye.local.rotation = glm::quatLookAt(toward, axis == 1 ? vec3(1, 0, 0) : vec3(0, 1, 0));
    s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
    s.cameras[0].yfov = 1.2f;
    scene::Light& lamp = s.lights.emplace_back();
    lamp.name = "lamp", lamp.intensity = 5, lamp.node = s.cameras[0].node;
    scene::validate(s);
    return std::pair(draw(s), pixel_rays(scene::camera_pose(s, ""), glass_size));
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto [through, rays] = draw_toward(axis, side, true);
      const image::Image open = draw_toward(axis, side, false).first;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const vec3 d = glm::normalize(rays[i].direction);
        if (max_component(glm::abs(d)) < 0.8f) continue;  // beside a slab's rim
        const vec3 expected = left_after(2 * 0.2f / std::abs(d[axis]));
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_GT(open.pixels[3 * i + c], 0);
          EXPECT_NEAR(through.pixels[3 * i + c] / open.pixels[3 * i + c],
                      expected[static_cast<glm::length_t>(c)], 0.01f)
              << i << " toward " << axis << " " << side;
        }
      }
    }
  }
}

TEST_F(GlassPixels, TheSunGoesThroughBodiesThatStandOnTheGround) {
  // Their lowest faces lie in the ground's plane; on one lies a plate, which none dims
  const Slab slabs[]{{{-2.2f, 0, -1.9f}, {-0.2f, 0.8f, -0.1f}}, {{0.6f, 0, -1.2f}, {2.1f, 0.6f, 1}}};
  const float plate = 0.7f;
  const vec3 down = glm::normalize(vec3(0.3f, -1, 0.2f));
  const auto draw_stage = [&](bool there) {
    scene::Scene s;
    s.materials = {matte(vec3(0.7f)), jelly()};
    if (!there) s.materials[1].alpha_mode = scene::AlphaMode::mask, s.materials[1].alpha = 0;
    s.materials[1].attenuation_distance = 0.3f;
    add_mesh(s, scene::make_quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), 0);
    add_mesh(s, scene::make_quad({0.8f, plate, 0.5f}, {0.6f, 0, 0}, {0, 0, -0.6f}), 0);
    for (const Slab& slab : slabs) add_mesh(s, scene::make_box(slab.low, slab.high), 1);
    scene::Node& eye = s.nodes.emplace_back();
    eye.local.translation = {0.01f, 8, 0.02f};
    eye.local.rotation = glm::quatLookAt(vec3(0, -1, 0), vec3(0, 0, -1));
    scene::Camera& camera = s.cameras.emplace_back();
    camera.node = static_cast<int>(s.nodes.size()) - 1;
    camera.orthographic = true, camera.yheight = 4;
    scene::Light sun;
    sun.type = scene::LightType::directional, sun.intensity = 3;
    add_stage_lamp(s, sun);
    s.nodes[s.lights[0].node].local.rotation = glm::quatLookAt(down, vec3(0, 0, -1));
    scene::validate(s);
    return s;
  };
  const scene::Scene scene = draw_stage(true);
  const image::Image through = draw(scene), open = draw(draw_stage(false));
  const std::vector<rays::RayQuery> rays = pixel_rays(scene::camera_pose(scene, ""), glass_size);
  const vec3 absorption = shading::absorption_of(scene.materials[1]);
  std::size_t off = 0, lit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const vec3 o = rays[i].origin;
    const bool on_plate = o.x > 0.8f && o.x < 1.4f && o.z < 0.5f && o.z > -0.1f;
    const vec3 x(o.x, on_plate ? plate : 0, o.z);
    if (!(open.pixels[3 * i] > 0.6f)) continue;  // in the plate's shadow
    float way = 0;
    for (const Slab& slab : slabs)
      way += slab.way(o, vec3(1e-7f, -1, 1e-7f), o.y - x.y) + slab.way(x - 9.0f * down, down, 9);
    ++lit;
    bool near = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const float expected = std::exp(-absorption[static_cast<glm::length_t>(c)] * way);
      near = near && std::abs(through.pixels[3 * i + c] / open.pixels[3 * i + c] - expected) < 0.05f;
    }
    off += !near;
  }
  // Edges of shadows are a texel of the map off
  EXPECT_GT(lit, 1200u);
  EXPECT_LT(off, lit / 20);
}

TEST_F(GlassPixels, BodiesBendWhatIsBehindThem) {
  // A ball before a wall of four glowing squares, which it shows upside down
  scene::Scene s;
  s.materials = {matte(vec3(0)), pane({0.9f, 1, 0.95f})};
  s.materials[1].thickness = 1, s.materials[1].attenuation_color = {0.7f, 0.9f, 0.8f};
  s.materials[1].attenuation_distance = 2;
  add_mesh(s, scene::make_quad({-20, -20, -9.1f}, {40, 0, 0}, {0, 40, 0}), 0);
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 2; ++y) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      scene::Material& glows = s.materials.emplace_back(matte(vec3(0)));
      glows.emission = vec3(0.2f + 0.6f * fx, 0.3f + 0.5f * fy, 0.5f);
      add_mesh(s, scene::make_quad({6 * fx - 6, 6 * fy - 6, -9}, {6, 0, 0}, {0, 6, 0}),
               static_cast<int>(s.materials.size()) - 1);
    }
  }
  add_mesh(s, scene::make_sphere(1.2f, 128, 64), 1, {0.3f, -0.2f, -5});
  s.nodes.emplace_back();
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].yfov = 0.6f;
  scene::validate(s);
  const image::Image truth = traced(s, 3), drawn = draw(s);
  s.materials[1].ior = 1;
  const image::Image straight = draw(s);
  EXPECT_LT(off(drawn, truth), 0.035);
  EXPECT_GT(off(straight, truth), 0.08);
  for (const auto& [x, y] : {std::pair(24, 16), {28, 17}, {26, 20}, {23, 15}, {30, 13}})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(drawn.at(x, y)[c], truth.at(x, y)[c], 0.1f * truth.at(x, y)[c]) << x << " " << y;
}

TEST_F(GlassPixels, WhatGlowsInABodyIsWhereAndAsBrightAsItIsTraced) {
  // A disc deep in a block of water, seen through its top at a slant
  scene::Scene s;
  s.materials = {matte(vec3(0)), pane(vec3(1)), matte(vec3(0))};
  s.materials[1].thickness = 1, s.materials[1].ior = 1.33f;
  s.materials[1].attenuation_color = {0.7f, 0.9f, 0.8f}, s.materials[1].attenuation_distance = 2;
  s.materials[2].emission = {2, 3, 4};
  add_mesh(s, scene::make_quad({-20, -3, 5}, {40, 0, 0}, {0, 0, -40}), 0);
  add_mesh(s, scene::make_box({-6, -2, -12}, {6, 0, -1}), 1);
  add_mesh(s, scene::make_quad({-1.5f, -1.8f, -4.5f}, {3, 0, 0}, {0, 0, -3}), 2);
  scene::Node& eye = s.nodes.emplace_back();
  eye.local.translation = {0, 4, 1};
  eye.local.rotation = glm::quatLookAt(glm::normalize(vec3(0, -5, -7)), vec3(0, 1, 0));
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].yfov = 0.7f;
  scene::validate(s);
  const image::Image truth = traced(s, 2), drawn = draw(s);
  std::size_t glows = 0, off = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (truth.pixels[i] > 0.3f) {
      ++glows;
      off += std::abs(drawn.pixels[i] - truth.pixels[i]) > 0.06f * truth.pixels[i];
    } else {
      off += drawn.pixels[i] > 0.3f;
    }
  }
  EXPECT_GT(glows, 200u);
  EXPECT_LT(off, glows / 3) << "a pixel of three lies on its edge, of which the tracer knows the share";
}

}  // namespace
}  // namespace ssphh::test
