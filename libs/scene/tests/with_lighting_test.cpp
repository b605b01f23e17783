#include <algorithm>

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

class DarkGroups : public testing::Test {
 protected:
  DarkGroups() {
    LightingState state = lighting_at(scene);
    state.group_scales[index("cove")] = vec3(0);
    lit_dark = with_lighting(scene, state);
    kept = keeping_dark_light(scene, state);
  }

  std::size_t index(const std::string& group) const {
    return static_cast<std::size_t>(light_group_index(light_groups(scene), group));
  }
  /// The most that the emitters of a group emit.
  static float emitted(const Scene& s, const std::string& group) {
    float most = 0;
    for (const Instance& i : s.instances) {
      const int m = instance_material(s, i);
      if (m >= 0 && light_group(s, i) == group) most = std::max(most, max_component(s.materials[m].emission));
    }
    return most;
  }

  Scene scene = make_builtin("gallery1"), lit_dark, kept;
};

TEST_F(DarkGroups, AreGroupsStillThatEmitNothing) {
  EXPECT_EQ(light_groups(lit_dark), light_groups(scene));
  EXPECT_EQ(lit_dark.dark_groups, std::vector<std::string>{"cove"});
  EXPECT_EQ(emitted(lit_dark, "cove"), 0);
  EXPECT_GT(emitted(scene, "cove"), 0);
  EXPECT_EQ(lighting_at(lit_dark).group_scales[index("cove")], vec3(0));
  EXPECT_EQ(usual_light_mode(lit_dark, "cove"), usual_light_mode(scene, "cove"));
}

TEST_F(DarkGroups, KeepWhatTheyWouldEmitWhereAsked) {
  EXPECT_EQ(light_groups(kept), light_groups(scene));
  EXPECT_EQ(emitted(kept, "cove"), emitted(scene, "cove"));
  EXPECT_EQ(lighting_at(kept).group_scales[index("cove")], vec3(0));
  EXPECT_EQ(emitted(without_dark_light(kept), "cove"), 0);
  LightingState on = lighting_at(kept);
  on.group_scales[index("cove")] = vec3(1);
  EXPECT_EQ(scene_hash(with_lighting(kept, on)), scene_hash(scene)) << "turned up, it is as it was";
  EXPECT_TRUE(with_lighting(kept, on).dark_groups.empty());
  EXPECT_EQ(light_groups(with_lighting(lit_dark, on)), light_groups(scene))
      << "put out for good, but a group";
}

TEST_F(DarkGroups, HaveTheHashesOfWhatIsSeen) {
  EXPECT_EQ(scene_hash(kept), scene_hash(lit_dark));
  EXPECT_EQ(light_hash(kept), light_hash(lit_dark));
  EXPECT_NE(light_hash(kept), light_hash(scene));
  Scene no_group = lit_dark;
  no_group.dark_groups.clear();
  EXPECT_NE(light_hash(no_group), light_hash(lit_dark)) << "a probe file of one lacks the other's group";
}

TEST_F(DarkGroups, OfLampsAndSkiesAreAlike) {
  Scene two = make_builtin("two-rooms");
  two.environment = Environment{};
  LightingState state = lighting_at(two);
  for (vec3& scale : state.group_scales) scale = vec3(0);
  const Scene off = keeping_dark_light(two, state);
  EXPECT_EQ(off.dark_groups, light_groups(two));
  EXPECT_EQ(off.lights[0].color, two.lights[0].color);
  EXPECT_EQ(off.environment->color, two.environment->color);
  const Scene black = without_dark_light(off);
  EXPECT_EQ(black.lights[0].color, vec3(0));
  EXPECT_EQ(black.environment->color, vec3(0));
  EXPECT_EQ(light_groups(black), light_groups(two));
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
