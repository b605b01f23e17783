/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/scene/scene.h>
#include <ssphh/scene/sun_position.h>

namespace ssphh::scene {
namespace {

TEST(Defaults, OfThings) {
  const Material material;
  EXPECT_EQ(material.base_color, vec3(0.8f));
  EXPECT_EQ(material.alpha, 1);
  EXPECT_EQ(material.metallic, 0);
  EXPECT_EQ(material.diffuse_roughness, 0);
  EXPECT_EQ(material.specular, 1);
  EXPECT_EQ(material.ior, 1.5f);
  EXPECT_EQ(material.transmission, 0);
  EXPECT_EQ(material.thickness, 0);
  EXPECT_EQ(material.attenuation_color, vec3(1));
  EXPECT_EQ(material.attenuation_distance, 0);
  EXPECT_EQ(material.emission, vec3(0));
  EXPECT_FALSE(material.unlit);
  EXPECT_FALSE(material.double_sided);
  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(material.alpha_cutoff, 0.5f);
  EXPECT_EQ(material.normal_scale, 1);
  const TextureUse use;
  EXPECT_EQ(use.texture, -1);
  EXPECT_EQ(use.uv_set, 0);
  EXPECT_EQ(use.offset, vec2(0));
  EXPECT_EQ(use.scale, vec2(1));
  EXPECT_EQ(use.rotation, 0);
  EXPECT_EQ(use.wrap_u, Wrap::repeat);
  EXPECT_EQ(use.wrap_v, Wrap::repeat);
  EXPECT_FALSE(use.nearest);
  EXPECT_EQ(Mesh().material, -1);
  EXPECT_EQ(Node().parent, -1);
  EXPECT_FALSE(Node().movable);
  EXPECT_EQ(Transform().translation, vec3(0));
  EXPECT_EQ(Transform().scale, vec3(1));
  EXPECT_EQ(Instance().mesh, -1);
  EXPECT_EQ(Instance().node, -1);
  EXPECT_EQ(Instance().material, -1);
  const Camera camera;
  EXPECT_EQ(camera.node, -1);
  EXPECT_FALSE(camera.orthographic);
  EXPECT_EQ(camera.yfov, 0.8f);
  EXPECT_EQ(camera.yheight, 2);
}

TEST(Defaults, OfLight) {
  const Light lamp;
  EXPECT_EQ(lamp.node, -1);
  EXPECT_EQ(lamp.type, LightType::point);
  EXPECT_EQ(lamp.color, vec3(1));
  EXPECT_EQ(lamp.intensity, 1);
  EXPECT_EQ(lamp.radius, 0);
  EXPECT_EQ(lamp.size, vec2(0));
  EXPECT_EQ(lamp.angular_radius, 0);
  EXPECT_EQ(lamp.inner_cone, 0);
  EXPECT_EQ(lamp.outer_cone, pi / 4);
  EXPECT_EQ(lamp.range, 0);
  EXPECT_EQ(Environment().color, vec3(1));
  EXPECT_EQ(Environment().rotation, 0);
  EXPECT_EQ(Sphl().node, -1);
  EXPECT_EQ(Sphl().radius, 0.1f);
  EXPECT_TRUE(Sphl().enabled);
  EXPECT_EQ(ProbePlace().position, vec3(0));
  EXPECT_EQ(ProbePlace().radius, 0.1f);
  EXPECT_EQ(LightState().color, vec3(1));
  EXPECT_EQ(LightState().intensity, 1);
  EXPECT_EQ(LightingState().time, 0);
  EXPECT_EQ(LightingState().environment_rotation, 0);
}

TEST(Defaults, OfSkies) {
  const SunSkyParams sky;
  EXPECT_EQ(sky.elevation, pi / 4);
  EXPECT_EQ(sky.azimuth, pi / 6);
  EXPECT_EQ(sky.turbidity, 3);
  EXPECT_EQ(sky.ground_albedo, vec3(0.2f));
  EXPECT_TRUE(sky.sun);
  EXPECT_EQ(sky.width, 512);
  EXPECT_EQ(sky.model, SkyModel::preetham);
  EXPECT_FALSE(sky.time);
  const SunTime time;
  EXPECT_EQ(time.year, 2026);
  EXPECT_EQ(time.month, 6);
  EXPECT_EQ(time.day, 21);
  EXPECT_EQ(time.hour, 12);
  EXPECT_EQ(time.utc_offset, 0);
  EXPECT_EQ(time.latitude, 0);
  EXPECT_EQ(time.longitude, 0);
  EXPECT_EQ(time.north, 0);
}

}  // namespace
}  // namespace ssphh::scene
