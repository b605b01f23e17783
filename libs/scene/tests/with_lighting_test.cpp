#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>

namespace ssphh::scene {
namespace {

TEST(WithLighting, TheSceneItselfWhenNothingChanges) {
  const Scene scene = make_builtin("two-rooms");
  EXPECT_EQ(scene_hash(with_lighting(scene, lighting_at(scene))), scene_hash(scene));
}

TEST(WithLighting, MovesColoursAndDimsOneLamp) {
  const Scene scene = make_builtin("two-rooms");
  LightingState state = lighting_at(scene, 0.7f);
  state.lights[0] = {glm::translate(mat4(1), vec3(1, 2, 3)), vec3(1, 0.5f, 0.25f), 8};
  state.group_scales[0] = vec3(2);
  const Scene lit = with_lighting(scene, state);
  const Light& lamp = lit.lights[0];
  EXPECT_EQ(vec3(world_matrices(lit, 0.7f)[lamp.node][3]), vec3(1, 2, 3));
  EXPECT_EQ(lamp.color, vec3(2, 1, 0.5f));
  EXPECT_EQ(lamp.intensity, 8);
  EXPECT_EQ(light_groups(lit), light_groups(scene));
}

TEST(WithLighting, TurnsTheEnvironment) {
  Scene scene;
  scene.environment = Environment{};
  scene.environment->rotation = 0.5f;
  LightingState state = lighting_at(scene);
  EXPECT_EQ(with_lighting(scene, state).environment->rotation, 0.5f) << "by nothing, if not asked for";
  state.environment_rotation = 0.25f;
  EXPECT_EQ(with_lighting(scene, state).environment->rotation, 0.75f);
  LightingState none;
  none.environment_rotation = 0.25f;
  EXPECT_FALSE(with_lighting(Scene{}, none).environment);
}

TEST(WithLighting, ScalesTheEmissionOfItsGroupAlone) {
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
  LightingState state = lighting_at(scene);
  state.group_scales = {vec3(1), vec3(0.5f), vec3(4)};
  const Scene lit = with_lighting(scene, state);
  const auto emission = [&](std::size_t i) {
    return lit.materials[instance_material(lit, lit.instances[i])].emission;
  };
  EXPECT_EQ(emission(0), vec3(3));
  EXPECT_EQ(emission(1), vec3(1.5f));
  EXPECT_EQ(lit.environment->color, vec3(4));
}

TEST(WithLighting, RefusesWrongCounts) {
  const Scene scene = make_builtin("two-rooms");
  LightingState state = lighting_at(scene);
  state.group_scales.resize(7, vec3(1));
  EXPECT_THROW(with_lighting(scene, state), Error);
  EXPECT_THROW(with_lighting(scene, {}), Error);
}

}  // namespace
}  // namespace ssphh::scene
