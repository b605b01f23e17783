// Scenes as functions make them of others, with every number: under a sky, with other lights, as Lambert's
// surfaces, repaired. In expected/.

#include <gtest/gtest.h>

#include <ssphh/scene/lambertian.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/with_lighting.h>

#include "expected_text.h"
#include "scene_text.h"

namespace ssphh::scene {
namespace {

void expect_text(const std::string& name, const Scene& scene) {
  test::expect_text_of("libs/scene/tests/expected/" + name + ".txt", test::scene_text(scene));
}

/// Panels that share a material, one of their own and an unlit one; lamps on a node that moves.
Scene lit() {
  Scene s;
  s.name = "lit";
  s.materials.resize(4);
  s.materials[0].name = "glow", s.materials[0].emission = {3, 2, 1};
  s.materials[1].name = "sign", s.materials[1].unlit = true, s.materials[1].base_color = {0.5f, 0.25f, 1};
  s.materials[2].name = "wood", s.materials[2].metallic = 0.5f, s.materials[2].diffuse_roughness = -0.25f;
  s.materials[2].normal_texture.texture = s.materials[2].metallic_roughness_texture.texture = 0;
  s.materials[2].base_color_texture.texture = 0;
  s.materials[3].name = "both", s.materials[3].unlit = true, s.materials[3].emission = {1, 1, 2};
  s.textures.push_back({"t", 1, 1, {1, 2, 3, 4}});
  s.meshes.push_back(make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)));
  s.meshes[0].material = 0;
  s.meshes.push_back(make_quad(vec3(0), vec3(2, 0, 0), vec3(0, 1, 0)));
  s.nodes.resize(3);
  s.nodes[0].name = "left", s.nodes[1].name = "right", s.nodes[2].name = "moving";
  s.instances = {{0, 0, -1, {}}, {0, 1, -1, {}}, {0, 1, 1, "signs"},
                 {1, 0, 2, {}},  {1, 0, -1, {}}, {0, 2, 3, "signs"}};
  s.lights.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    s.lights[i].name = "lamp" + std::to_string(i), s.lights[i].node = 2;
    s.lights[i].color = {0.5f, 1, 0.25f}, s.lights[i].intensity = 2;
  }
  s.lights[1].group = "left";
  s.environment.emplace();
  s.environment->color = {1, 2, 3}, s.environment->rotation = 0.5f;
  s.animations.push_back(
      {"a", {{2, AnimationPath::translation, Interpolation::linear, {0, 2}, {vec4(0), vec4(4, 2, 6, 0)}}}});
  return s;
}

TEST(ChangedText, LightsAreMovedDimmedAndColouredByTheirGroups) {
  const Scene scene = lit();
  ASSERT_EQ(light_groups(scene),
            (std::vector<std::string>{"lamp0", "left", "lamp2", "right", "signs", "environment"}));
  const mat4 there = world_matrices(scene, 0.5f)[2];
  mat4 elsewhere = there;
  elsewhere[3] = {7, 8, 9, 1};
  const std::vector<LightState> states = {
      {there, {1, 2, 3}, 4}, {elsewhere, {1, 1, 0.5f}, 5}, {there, {1, 1, 1}, 0}};
  const std::vector<vec3> scales = {vec3(2), {1, 0.5f, 0.25f}, vec3(3), vec3(1), {4, 5, 6}, {0.5f, 1, 2}};
  expect_text("with-lighting", with_lighting(scene, {0.5f, states, scales, 0.25f, {}}));
  expect_text("with-lighting-unscaled",
              with_lighting(scene, {0.25f, states, std::vector<vec3>(scales.size(), vec3(1)), 0, {}}));
}

TEST(ChangedText, SurfacesBecomeLamberts) {
  expect_text("lambertian", lambertian(lit()));
}

TEST(ChangedText, TheSkyHasAllItsNumbers) {
  Scene evening = lit();
  add_sun_sky(
      evening,
      {.elevation = 0.2f, .azimuth = -2, .turbidity = 5, .ground_albedo = {0.1f, 0.2f, 0.3f}, .width = 9});
  expect_text("sky-evening", evening);
  Scene zenith;
  add_sun_sky(zenith, {.elevation = pi / 2, .azimuth = 1, .sun = false, .width = 16});
  expect_text("sky-zenith", zenith);
}

TEST(ChangedText, TheSunStandsUprightUntilItIsOverhead) {
  for (const auto& [sine, steep] : {std::pair{0.9985f, false}, {0.9995f, true}, {1.0f, true}}) {
    Scene scene;
    add_sun_sky(scene, {.elevation = std::asin(sine), .azimuth = 1, .width = 4});
    const mat3 m(world_matrices(scene)[0]);
    EXPECT_NEAR(steep ? m[0].z : m[0].y, 0, 1e-6f) << sine;  // float rounding
    EXPECT_GT(steep ? -m[1].z : m[1].y, 0) << sine;
  }
}

TEST(ChangedText, RepairsHaveAllTheirNumbers) {
  Scene s = lit();
  s.materials[0].ior = 0.5f, s.materials[1].alpha = 2, s.materials[2].specular = -1;
  s.nodes[2].matrix = mat4(vec4(0, 0, 2, 0), vec4(0, -3, 0, 0), vec4(-5, 0, 0, 0), vec4(1, 2, 3, 1));
  s.nodes[0].local.rotation = quat(2, 0, 2, 0);
  s.meshes[0].tangents = {{0, 0, 3, 1}, {0, 0, 1, -0.5f}, {0, 0, 0, -1}, {1, 0, 0, -1}};
  s.meshes[0].normals[1] = {0, 0, -4}, s.meshes[0].normals[2] = vec3(0);
  s.meshes[1].triangles.push_back({1, 1, 2}), s.meshes[1].colors.assign(4, vec4(0.5f, 2, -1, 1));
  s.instances[0].node = s.lights[0].node = -1;
  s.lights[1].inner_cone = 2, s.lights[1].outer_cone = 1, s.lights[2].range = -1;
  s.cameras.resize(1), s.sphls.resize(1);
  std::string repairs;
  for (const std::string& line : validate(s)) repairs += line + "\n";
  test::expect_text_of("libs/scene/tests/expected/repairs.txt", repairs + test::scene_text(s));
}

}  // namespace
}  // namespace ssphh::scene
