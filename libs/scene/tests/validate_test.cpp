#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

#include "not_finite.h"

namespace ssphh::scene {
namespace {

using test::infinity;
using test::nan;

Scene good_scene() {
  Scene s;
  s.textures.push_back({"tex", 1, 1, std::vector<std::uint8_t>(4)});
  s.materials.resize(1);
  s.materials[0].name = "mat";
  s.meshes.push_back(make_box(vec3(0), vec3(1)));
  s.meshes[0].name = "mesh";
  s.nodes.resize(2);
  s.nodes[1].parent = 0;
  s.instances.resize(1);
  s.instances[0].mesh = s.instances[0].node = 0;
  s.cameras.resize(1);
  s.cameras[0].node = 0;
  s.lights.resize(1);
  s.lights[0].name = "lamp";
  s.lights[0].node = 0;
  s.sphls.push_back({"probe", 0, 0.1f, true});
  s.animations.resize(1);
  s.animations[0].channels.push_back(
      {1, AnimationPath::translation, Interpolation::linear, {0, 1}, {vec4(0), vec4(1)}});
  s.environment.emplace();
  return s;
}

struct Fault {
  const char* where;  // begins the error
  std::function<void(Scene&)> apply;
};

TEST(Validate, AcceptsAGoodSceneAndMarksMovableNodes) {
  Scene scene = good_scene();
  EXPECT_TRUE(validate(scene).empty());
  EXPECT_FALSE(scene.nodes[0].movable);
  EXPECT_TRUE(scene.nodes[1].movable);
}

TEST(Validate, FaultsAreErrorsThatNameTheObject) {
  const std::vector<Fault> faults = {
      {"texture 0 \"tex\"", [](Scene& s) { s.textures[0].rgba.pop_back(); }},
      {"texture 0", [](Scene& s) { s.textures[0].width = 0; }},
      {"material 0 \"mat\"", [](Scene& s) { s.materials[0].base_color.x = nan; }},
      {"material 0", [](Scene& s) { s.materials[0].emission.y = infinity; }},
      {"material 0", [](Scene& s) { s.materials[0].ior = nan; }},
      {"material 0", [](Scene& s) { s.materials[0].base_color_texture.texture = 1; }},
      {"material 0", [](Scene& s) { s.materials[0].normal_texture.texture = -2; }},
      {"material 0", [](Scene& s) { s.materials[0].emission_texture.uv_set = 2; }},
      {"material 0", [](Scene& s) { s.materials[0].emission_texture.rotation = nan; }},
      {"mesh 0 \"mesh\"", [](Scene& s) { s.meshes[0].positions[3].z = nan; }},
      {"mesh 0", [](Scene& s) { s.meshes[0].positions[3].z = infinity; }},
      {"mesh 0", [](Scene& s) { s.meshes[0].triangles[2].y = 24; }},
      {"mesh 0", [](Scene& s) { s.meshes[0].normals.pop_back(); }},
      {"mesh 0", [](Scene& s) { s.meshes[0].uvs[1].resize(3); }},
      {"mesh 0", [](Scene& s) { s.meshes[0].uvs[0][0].x = nan; }},
      {"mesh 0", [](Scene& s) { s.meshes[0].colors.resize(25); }},
      {"mesh 0", [](Scene& s) { s.meshes[0].material = 1; }},
      {"node 0", [](Scene& s) { s.nodes[0].parent = 0; }},
      {"node 1", [](Scene& s) { s.nodes[1].parent = -2; }},
      {"node 1", [](Scene& s) { s.nodes[1].local.translation.x = nan; }},
      {"node 1", [](Scene& s) { s.nodes[1].local.rotation.w = infinity; }},
      {"node 1", [](Scene& s) { s.nodes[1].matrix = mat4(nan); }},
      {"node 1", [](Scene& s) { s.nodes[1].matrix = mat4(2); }},  // last row 0 0 0 2
      {"instance 0", [](Scene& s) { s.instances[0].mesh = -1; }},
      {"instance 0", [](Scene& s) { s.instances[0].node = 2; }},
      {"instance 0", [](Scene& s) { s.instances[0].material = 5; }},
      {"camera 0", [](Scene& s) { s.cameras[0].node = 7; }},
      {"camera 0", [](Scene& s) { s.cameras[0].yfov = 4; }},
      {"camera 0", [](Scene& s) { s.cameras[0].aspect = nan; }},
      {"light 0 \"lamp\"", [](Scene& s) { s.lights[0].node = 7; }},
      {"light 0", [](Scene& s) { s.lights[0].intensity = nan; }},
      {"light 0", [](Scene& s) { s.lights[0].type = LightType::sphere; }},  // radius 0
      {"light 0", [](Scene& s) { s.lights[0].type = LightType::disc; }},
      {"light 0", [](Scene& s) { s.lights[0].type = LightType::rectangle; }},  // size 0
      {"light 0",
       [](Scene& s) {
         s.lights[0].type = LightType::rectangle, s.lights[0].size = {1, -1};
       }},
      {"light 0", [](Scene& s) { s.lights[0].size.y = nan; }},
      {"SPHL 0 \"probe\"", [](Scene& s) { s.sphls[0].node = -2; }},
      {"SPHL 0", [](Scene& s) { s.sphls[0].radius = 0; }},
      {"animation 0 channel 0", [](Scene& s) { s.animations[0].channels[0].node = -1; }},
      {"animation 0 channel 0", [](Scene& s) { s.animations[0].channels[0].times[1] = 0; }},
      {"animation 0 channel 0", [](Scene& s) { s.animations[0].channels[0].values.pop_back(); }},
      {"animation 0 channel 0",
       [](Scene& s) { s.animations[0].channels[0].interpolation = Interpolation::cubic_spline; }},
      {"animation 0 channel 0", [](Scene& s) { s.animations[0].channels[0].values[0].x = nan; }},
      {"environment 0", [](Scene& s) { s.environment->color.x = nan; }},
      {"environment 0", [](Scene& s) { s.environment->equirect.pixels.resize(5); }},
      {"environment 0",
       [](Scene& s) {
         s.environment->equirect = image::Image(2, 1), s.environment->equirect.pixels[5] = nan;
       }},
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Scene scene = good_scene();
    faults[i].apply(scene);
    try {
      validate(scene);
      ADD_FAILURE() << "fault " << i << " of " << faults[i].where;
    } catch (const Error& e) {
      EXPECT_TRUE(e.where().starts_with(faults[i].where)) << "fault " << i << ": " << e.what();
    }
  }
}

TEST(Validate, RemovesDegenerateTriangles) {
  Scene scene = good_scene();
  Mesh& mesh = scene.meshes[0];
  mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  mesh.normals.resize(27, vec3(0, 1, 0));
  mesh.uvs[0].resize(27);
  mesh.triangles.emplace_back(0, 0, 1);     // a corner twice
  mesh.triangles.emplace_back(24, 25, 26);  // on a line
  EXPECT_EQ(validate(scene), std::vector<std::string>{"2 degenerate triangles: removed"});
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(validate(scene).empty());
}

TEST(Validate, KeepsSmallTriangles) {
  Scene scene = good_scene();
  for (vec3& p : scene.meshes[0].positions) p *= 1e-12f;
  EXPECT_TRUE(validate(scene).empty());
  EXPECT_EQ(scene.meshes[0].triangles.size(), 12u);
}

TEST(Validate, MendsNormalsAndTangents) {
  Scene scene = good_scene();
  Mesh& mesh = scene.meshes[0];
  const std::vector<vec3> good = mesh.normals;
  mesh.tangents.assign(24, vec4(0, 0, 2, 0.5f));
  mesh.normals[0] *= 3;
  mesh.normals[5] = vec3(0);
  mesh.normals[9] = vec3(nan);
  EXPECT_EQ(validate(scene).size(), 3u);
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_LT(glm::distance(mesh.normals[i], good[i]), 1e-6f) << i;  // float rounding
    EXPECT_EQ(mesh.tangents[i], vec4(0, 0, 1, 1));
  }
}

TEST(Validate, ClampsMaterialsAndLights) {
  Scene scene = good_scene();
  scene.materials[0].base_color = {2, 0.5f, -1};
  scene.materials[0].specular_roughness = -3;
  scene.lights[0].intensity = -1;
  EXPECT_EQ(validate(scene).size(), 2u);
  EXPECT_EQ(scene.materials[0].base_color, vec3(1, 0.5f, 0));
  EXPECT_EQ(scene.materials[0].specular_roughness, -1);
  EXPECT_EQ(scene.lights[0].intensity, 0);
}

TEST(Validate, NormalisesRotations) {
  Scene scene = good_scene();
  scene.nodes[0].local.rotation = quat(0, 0, 5, 0);
  scene.nodes[1].local.rotation = quat(0, 0, 0, 0);
  EXPECT_EQ(validate(scene).size(), 1u);
  EXPECT_EQ(scene.nodes[0].local.rotation, quat(0, 0, 1, 0));
  EXPECT_EQ(scene.nodes[1].local.rotation, quat(1, 0, 0, 0));
}

TEST(Validate, GivesObjectsWithoutANodeOne) {
  Scene scene = good_scene();
  scene.instances[0].node = scene.lights[0].node = scene.sphls[0].node = -1;
  EXPECT_EQ(validate(scene).size(), 1u);
  ASSERT_EQ(scene.nodes.size(), 3u);
  EXPECT_EQ(scene.instances[0].node, 2);
  EXPECT_EQ(scene.sphls[0].node, 2);
  EXPECT_EQ(world_matrices(scene)[2], mat4(1));
}

TEST(Validate, DecomposesTheMatrixOfAnAnimatedNode) {
  Scene scene = good_scene();
  Transform t;
  t.translation = {1, 2, 3};
  t.rotation = glm::angleAxis(1.0f, glm::normalize(vec3(1, 2, 3)));
  t.scale = {2, -3, 4};  // mirrors
  scene.nodes[1].matrix = t.matrix();
  scene.animations[0].channels[0].path = AnimationPath::scale;
  EXPECT_EQ(validate(scene).size(), 1u);
  EXPECT_FALSE(scene.nodes[1].matrix.has_value());
  const mat4 again = scene.nodes[1].local.matrix();
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(again[c], t.matrix()[c]), 1e-5f);  // float rounding
}

TEST(Validate, AcceptsAnEmptyScene) {
  Scene scene;
  EXPECT_TRUE(validate(scene).empty());
}

}  // namespace
}  // namespace ssphh::scene
