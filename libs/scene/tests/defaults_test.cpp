/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/scene.h>
#include <ssphh/scene/sun_position.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

TEST(Defaults, OfWhatStandsInAScene) {
  const Texture texture;
  EXPECT_EQ(texture.width + texture.height, 0);
  const TextureUse use;
  EXPECT_EQ(use.texture, -1);
  EXPECT_EQ(use.uv_set, 0);
  EXPECT_EQ(use.offset, vec2(0));
  EXPECT_EQ(use.scale, vec2(1));
  EXPECT_EQ(use.rotation, 0);
  EXPECT_EQ(use.wrap_u, Wrap::repeat);
  EXPECT_EQ(use.wrap_v, Wrap::repeat);
  EXPECT_FALSE(use.nearest);
  const Material m;
  EXPECT_EQ(m.base_color, vec3(0.8f));
  EXPECT_EQ(m.emission, vec3(0));
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.diffuse_roughness, 0);
  EXPECT_EQ(m.specular_roughness, 1);
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.transmission, 0);
  EXPECT_EQ(m.thickness, 0);
  EXPECT_EQ(m.attenuation_color, vec3(1));
  EXPECT_EQ(m.attenuation_distance, 0);
  EXPECT_EQ(m.alpha_cutoff, 0.5f);
  EXPECT_EQ(m.normal_scale, 1);
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
  EXPECT_FALSE(m.unlit || m.double_sided || m.emissive());
  EXPECT_EQ(Mesh().material, -1);
  const Transform transform;
  EXPECT_EQ(transform.matrix(), mat4(1));
  const Node node;
  EXPECT_EQ(node.parent, -1);
  EXPECT_FALSE(node.movable || node.matrix);
  const Instance instance;
  EXPECT_EQ(instance.mesh, -1);
  EXPECT_EQ(instance.node, -1);
  EXPECT_EQ(instance.material, -1);
  const Camera camera;
  EXPECT_EQ(camera.node, -1);
  EXPECT_EQ(camera.yfov, 0.8f);
  EXPECT_EQ(camera.yheight, 2);
  EXPECT_FALSE(camera.orthographic || camera.aspect);
  const Light light;
  EXPECT_EQ(light.node, -1);
  EXPECT_EQ(light.type, LightType::point);
  EXPECT_EQ(light.color, vec3(1));
  EXPECT_EQ(light.intensity, 1);
  EXPECT_EQ(light.radius + light.angular_radius + light.inner_cone + light.range, 0);
  EXPECT_EQ(light.outer_cone, pi / 4);
  const Environment environment;
  EXPECT_EQ(environment.name, "environment");
  EXPECT_EQ(environment.color, vec3(1));
  EXPECT_EQ(environment.rotation, 0);
  const Sphl sphl;
  EXPECT_EQ(sphl.node, -1);
  EXPECT_EQ(sphl.radius, 0.1f);
  EXPECT_TRUE(sphl.enabled);
  const AnimationChannel channel;
  EXPECT_EQ(channel.node, -1);
  EXPECT_EQ(channel.path, AnimationPath::translation);
  EXPECT_EQ(channel.interpolation, Interpolation::linear);
}

TEST(Defaults, OfLightsAndBounds) {
  const LightState state;
  EXPECT_EQ(state.world, mat4(1));
  EXPECT_EQ(state.color, vec3(1));
  EXPECT_EQ(state.intensity, 1);
  const Bounds bounds;
  EXPECT_TRUE(bounds.empty());
  EXPECT_EQ(bounds.radius(), 0);
  const SunSkyParams sky;
  EXPECT_EQ(sky.elevation, pi / 4);
  EXPECT_EQ(sky.azimuth, pi / 6);
  EXPECT_EQ(sky.turbidity, 3);
  EXPECT_EQ(sky.ground_albedo, vec3(0.2f));
  EXPECT_TRUE(sky.sun);
  EXPECT_EQ(sky.width, 512);
}

// Triangles and the reach of bodies whose sizes nobody gave.
TEST(Defaults, OfBodies) {
  EXPECT_EQ(make_sphere(1).triangles.size(), 2u * 64 * 31);
  EXPECT_EQ(make_torus(1, 0.1f).triangles.size(), 2u * 96 * 32);
  EXPECT_EQ(make_cylinder(1, 1).triangles.size(), make_cylinder(1, 1, 48).triangles.size());
  EXPECT_EQ(make_cone(1, 1).triangles.size(), make_cone(1, 1, 48).triangles.size());
  EXPECT_EQ(make_column(1, 9).triangles.size(), make_column(1, 9, 48).triangles.size());
  EXPECT_EQ(make_torus_knot(2, 3, 1, 0.3f, 0.1f).triangles.size(), 2u * 512 * 24);
  EXPECT_EQ(make_spiral(1, 1, 2, 3, 0.1f).triangles.size(),
            make_spiral(1, 1, 2, 3, 0.1f, 400, 20).triangles.size());
}

TEST(Defaults, OfLight) {
  EXPECT_EQ(Light().size, vec2(0));
  EXPECT_EQ(ProbePlace().position, vec3(0));
  EXPECT_EQ(ProbePlace().radius, 0.1f);
  EXPECT_EQ(LightingState().time, 0);
  EXPECT_EQ(LightingState().environment_rotation, 0);
}

TEST(Defaults, OfSkies) {
  const SunSkyParams sky;
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
