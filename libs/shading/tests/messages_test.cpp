/// What is meant where nobody says anything, and what is said of what cannot be.

#include <gtest/gtest.h>

#include <ssphh/shading/mesh_view.h>
#include <ssphh/shading/surface.h>

#include "error_message.h"
#include "light_scenes.h"
#include "lights/distant_lights.h"
#include "lights/punctual_lights.h"

namespace ssphh::shading::test {
namespace {

using ssphh::test::message_of;

TEST(ShadingDefaults, KindsOfEmitters) {
  for (const auto& [kind, delta, distant] : {std::tuple{EmitterKind::point, true, false},
                                             {EmitterKind::sphere, false, false},
                                             {EmitterKind::mesh, false, false},
                                             {EmitterKind::directional, true, true},
                                             {EmitterKind::disc, false, true},
                                             {EmitterKind::environment, false, true}}) {
    const Emitter emitter{kind, 0, {}};
    EXPECT_EQ(emitter.delta(), delta);
    EXPECT_EQ(emitter.distant(), distant);
  }
}

TEST(ShadingMessages, OfLightSets) {
  scene::Scene scene;
  add_light(scene, scene::LightType::point, {0, 1, 0});
  add_light(scene, scene::LightType::directional, {0, 1, 0});
  const int panel = add_panel(scene, glowing(vec3(1)), {});
  const LightSet lights = make_lights(scene);
  const std::vector<mat4> world(3, mat4(1)), few(2, mat4(1));
  const std::vector<scene::LightState> states(2), one(1);
  const std::string matrix = "light set: there is not one matrix for each node";
  EXPECT_EQ(message_of([&] { LightSet(scene, few); }), matrix);
  EXPECT_EQ(message_of([&] { LightSet(scene, world); }), "no error");
  EXPECT_EQ(message_of([&] { LightSet(lights, few, states); }), matrix);
  EXPECT_EQ(message_of([&] { LightSet(lights, world, states); }), "no error");
  EXPECT_EQ(message_of([&] { LightSet(lights, world, one); }),
            "light set: there is not one state for each light");
  ASSERT_EQ(lights.emitter_count(), 3);
  const std::string emitter = "light set: there is no emitter of that index";
  for (const int i : {-1, 3}) {
    EXPECT_EQ(message_of([&] { lights.emitter(i); }), emitter);
    EXPECT_EQ(message_of([&] { lights.sample(i, vec3(0), 0.5f, vec2(0)); }),
              "light set: there is no sample of that index");
    EXPECT_EQ(message_of([&] { lights.sample_emitter(i, vec3(0), vec2(0)); }), emitter);
    EXPECT_EQ(message_of([&] { lights.flux(i, 1); }), emitter);
    EXPECT_EQ(message_of([&] { lights.emit(i, vec2(0), vec2(0), vec3(0), 1); }), emitter);
    EXPECT_EQ(message_of([&] { lights.view_mesh(i, vec3(0), vec3(0, 1, 0)); }), emitter);
    EXPECT_EQ(message_of([&] { lights.distant_radiance(i, vec3(0, 1, 0)); }), emitter);
  }
  EXPECT_EQ(message_of([&] { lights.distant_radiance(1, vec3(0, 1, 0)); }),
            "light set: that emitter is not distant");
  EXPECT_EQ(message_of([&] { lights.distant_radiance(2, vec3(0, 1, 0)); }), "no error");
  const std::string instance = "light set: there is no instance of that index";
  for (const int i : {-1, panel + 1}) {
    EXPECT_EQ(message_of([&] { lights.instance_group(i); }), instance);
    EXPECT_EQ(message_of([&] { lights.pdf_triangle(vec3(0), i, 0, 1, 1); }), instance);
  }
}

// Of 32 triangles a closed form exists, each of which the horizon may cut in two.
TEST(ShadingMessages, OfMeshesOfTooManyTriangles) {
  for (const int count : {32, 33}) {
    scene::Scene scene;
    add_panel(scene, glowing(vec3(1)), {{0, 2, 0}});
    scene.meshes[0].triangles.assign(static_cast<std::size_t>(count), {0, 1, 2});
    const LightSet lights = make_lights(scene);
    EXPECT_EQ(lights.view_mesh(0, vec3(0), vec3(0, 1, 0)).has_value(), count == 32);
  }
  MeshView view(vec3(0), vec3(0, 1, 0), vec3(1), 0);
  const auto add = [&] { return message_of([&] { view.add({-1, 1, 0}, {1, 1, 0}, {0, -1, 1}); }); };
  for (int i = 0; i < 32; ++i) EXPECT_EQ(add(), "no error") << i;
  EXPECT_EQ(add(), "emissive mesh: it has too many triangles for a closed form");
}

}  // namespace
}  // namespace ssphh::shading::test
