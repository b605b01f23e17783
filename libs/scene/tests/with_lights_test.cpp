#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/with_lights.h>

namespace ssphh::scene {
namespace {

std::vector<LightState> states(const Scene& scene) {
  const std::vector<mat4> world = world_matrices(scene);
  std::vector<LightState> lights;
  for (const Light& light : scene.lights)
    lights.push_back({world[static_cast<std::size_t>(light.node)], light.color, light.intensity});
  return lights;
}

TEST(WithLights, TheSceneItselfWhenNothingChanges) {
  const Scene scene = make_builtin("two-rooms");
  EXPECT_EQ(scene_hash(with_lights(scene, 0, states(scene))), scene_hash(scene));
}

TEST(WithLights, MovesColoursAndDimsOneLamp) {
  const Scene scene = make_builtin("two-rooms");
  std::vector<LightState> lights = states(scene);
  lights[0].world[3] = vec4(1, 2, 3, 1);
  lights[0].color = vec3(1, 0.5f, 0.25f);
  lights[0].intensity = 8;
  const Scene lit = with_lights(scene, 0.7f, lights, std::vector<vec3>{vec3(2)});
  const Light& lamp = lit.lights[0];
  EXPECT_EQ(vec3(world_matrices(lit, 0.7f)[static_cast<std::size_t>(lamp.node)][3]), vec3(1, 2, 3));
  EXPECT_EQ(lamp.color, vec3(2, 1, 0.5f));
  EXPECT_EQ(lamp.intensity, 8);
  EXPECT_EQ(light_groups(lit), light_groups(scene));
}

TEST(WithLights, TurnsTheEnvironment) {
  Scene scene;
  scene.environment = Environment{};
  scene.environment->rotation = 0.5f;
  EXPECT_EQ(with_lights(scene, 0, {}, {}, 0.25f).environment->rotation, 0.75f);
  EXPECT_EQ(with_lights(scene, 0, {}).environment->rotation, 0.5f) << "by nothing, if not asked for";
  EXPECT_FALSE(with_lights(Scene{}, 0, {}, {}, 0.25f).environment);
}

TEST(WithLights, ScalesTheEmissionOfItsGroupAlone) {
  Scene scene;
  scene.nodes.resize(2);
  scene.nodes[0].name = "left", scene.nodes[1].name = "right";
  Material bright;
  bright.emission = vec3(3);
  scene.materials = {bright};
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.material = 0;
  scene.meshes = {mesh};
  scene.instances = {{0, 0, -1, ""}, {0, 1, -1, ""}};
  scene.environment = Environment{};
  const Scene lit = with_lights(scene, 0, {}, std::vector<vec3>{vec3(1), vec3(0.5f), vec3(4)});
  const auto emission = [&](std::size_t i) {
    return lit.materials[static_cast<std::size_t>(instance_material(lit, lit.instances[i]))].emission;
  };
  EXPECT_EQ(emission(0), vec3(3));
  EXPECT_EQ(emission(1), vec3(1.5f));
  EXPECT_EQ(lit.environment->color, vec3(4));
}

TEST(WithLights, RefusesWrongCounts) {
  const Scene scene = make_builtin("two-rooms");
  EXPECT_THROW(with_lights(scene, 0, {}), Error);
  EXPECT_THROW(with_lights(scene, 0, states(scene), std::vector<vec3>(7, vec3(1))), Error);
}

}  // namespace
}  // namespace ssphh::scene
