// Units and defaults of an overlay's members.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene_io/overlay.h>

namespace ssphh::scene_io {
namespace {

scene::Scene with_overlay(const std::string& text) {
  scene::Scene scene;
  scene.materials.resize(1);
  scene.materials[0].name = "clay";
  apply_overlay(scene, text, "test.ssphh.json");
  return scene;
}

TEST(OverlayValues, AnglesAreDegreesAndASunsDiameterIsTwiceItsRadius) {
  const scene::Light sun = with_overlay(R"({"lights": [{"type": "directional", "direction": [0, -1, 0],
    "angular_diameter_degrees": 3, "intensity": 5, "color": [0.5, 0.25, 0.125], "range": 9}]})")
                               .lights.at(0);
  EXPECT_FLOAT_EQ(sun.angular_radius, glm::radians(1.5f));
  EXPECT_EQ(sun.intensity, 5);
  EXPECT_EQ(sun.color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(sun.range, 9);
  const scene::Light spot = with_overlay(R"({"lights": [{"type": "spot", "look_at": [0, -1, 0],
    "inner_cone_degrees": 12, "outer_cone_degrees": 34}]})")
                                .lights.at(0);
  EXPECT_FLOAT_EQ(spot.inner_cone, glm::radians(12.0f));
  EXPECT_FLOAT_EQ(spot.outer_cone, glm::radians(34.0f));
  EXPECT_FLOAT_EQ(with_overlay(R"({"cameras": [{"yfov_degrees": 70}]})").cameras.at(0).yfov,
                  glm::radians(70.0f));
}

TEST(OverlayValues, WhatIsLeftOutHasItsDefault) {
  const scene::Scene scene = with_overlay(R"({"cameras": [{}],
    "lights": [{"type": "point"}, {"type": "spot", "direction": [1, 0, 0]}, {"type": "sphere", "radius": 0.3}],
    "sphls": [{"position": [1, 2, 3]}, {"position": [0, 0, 0], "enabled": false}], "environment": {}})");
  EXPECT_FLOAT_EQ(scene.cameras.at(0).yfov, glm::radians(45.0f));
  EXPECT_FALSE(scene.cameras[0].orthographic);
  EXPECT_EQ(scene.cameras[0].name, "camera 1");
  for (const scene::Light& light : scene.lights) {
    EXPECT_EQ(light.intensity, 1);
    EXPECT_EQ(light.color, vec3(1));
    EXPECT_EQ(light.range, 0);
    EXPECT_EQ(light.angular_radius, 0);
  }
  EXPECT_EQ(scene.lights.at(1).inner_cone, 0);
  EXPECT_FLOAT_EQ(scene.lights[1].outer_cone, glm::radians(45.0f));
  EXPECT_EQ(scene.lights.at(2).type, scene::LightType::sphere);
  EXPECT_EQ(scene.lights[2].radius, 0.3f);
  EXPECT_EQ(scene.sphls.at(0).radius, 0.1f);
  EXPECT_EQ(scene.sphls[0].name, "SPHL-1");
  EXPECT_TRUE(scene.sphls[0].enabled);
  EXPECT_FALSE(scene.sphls.at(1).enabled);
  EXPECT_EQ(scene.environment.value().color, vec3(1));
  EXPECT_EQ(scene.environment->rotation, 0);
  EXPECT_EQ(scene::light_group(*scene.environment), "environment");
}

TEST(OverlayValues, EveryMemberOfAMaterialReplacesItsField) {
  const scene::Material m = with_overlay(R"({"materials": [{"name": "clay", "base_color": [0.1, 0.2, 0.3],
    "alpha": 0.4, "metallic": 0.5, "diffuse_roughness": 0.6, "specular_roughness": -0.7, "specular": 0.8,
    "ior": 1.9, "transmission": 0.25, "thickness": 2, "attenuation_color": [0.7, 0.8, 0.9],
    "attenuation_distance": 5, "emission": [2, 3, 4], "double_sided": true, "unlit": true}]})")
                                .materials.at(0);
  EXPECT_EQ(m.base_color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.transmission, 0.25f);
  EXPECT_EQ(m.thickness, 2);
  EXPECT_EQ(m.attenuation_color, vec3(0.7f, 0.8f, 0.9f));
  EXPECT_EQ(m.attenuation_distance, 5);
  EXPECT_EQ(m.alpha, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.diffuse_roughness, 0.6f);
  EXPECT_EQ(m.specular_roughness, -0.7f);
  EXPECT_EQ(m.specular, 0.8f);
  EXPECT_EQ(m.ior, 1.9f);
  EXPECT_EQ(m.emission, vec3(2, 3, 4));
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.unlit);
}

TEST(OverlayValues, LookAtAndUpTurnACamera) {
  const scene::Scene scene =
      with_overlay(R"({"cameras": [{"position": [1, 2, 3], "look_at": [1, 2, 7], "up": [1, 0, 0]}]})");
  const mat4 pose = scene::camera_pose(scene, "").world;
  EXPECT_LT(glm::distance(-vec3(pose[2]), vec3(0, 0, 1)), 1e-6f);  // float rounding
  EXPECT_LT(glm::distance(vec3(pose[1]), vec3(1, 0, 0)), 1e-6f);
  EXPECT_EQ(vec3(pose[3]), vec3(1, 2, 3));
}

// By compass, 0° is north, −z, and 90° east, +x; the library's azimuth runs from +x toward +z.
TEST(OverlayValues, EveryMemberOfTheSkyReachesItsParameter) {
  const scene::Scene scene = with_overlay(R"({"sun_sky": {"elevation_degrees": 25, "azimuth_degrees": 130,
    "turbidity": 4.5, "ground_albedo": [0.1, 0.3, 0.5], "width": 16}})");
  scene::Scene expected;
  expected.materials = scene.materials;
  const scene::SunSkyParams params{.elevation = glm::radians(25.0f),
                                   .azimuth = glm::radians(40.0f),
                                   .turbidity = 4.5f,
                                   .ground_albedo = {0.1f, 0.3f, 0.5f},
                                   .width = 16};
  scene::add_sun_sky(expected, params);
  const auto &sky = scene.environment.value().equirect, &wanted = expected.environment->equirect;
  ASSERT_EQ(sky.pixels.size(), wanted.pixels.size());
  for (std::size_t i = 0; i < sky.pixels.size(); ++i)
    EXPECT_NEAR(sky.pixels[i], wanted.pixels[i], 1e-5f * wanted.pixels[i]);  // angles rounded to float twice
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_TRUE(with_overlay(R"({"sun_sky": {"sun": false, "width": 16}})").lights.empty());

  // Left out: 45° high and, in the library's azimuth, 30° from +x
  const scene::Scene left_out = with_overlay(R"({"sun_sky": {"width": 16}})");
  const mat4 world = scene::world_matrices(left_out).back();
  EXPECT_LT(glm::distance(vec3(world[2]), scene::sun_direction({})), 1e-6f);  // float rounding
}

}  // namespace
}  // namespace ssphh::scene_io
