/// Skins and morph targets: small files whose shapes are known.

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>

#include "error_message.h"
#include "glb_builder.h"
#include "gltf_bytes.h"
#include "gltf_deform.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using test::GlbBuilder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfPose : public testing::Test {
 protected:
  GltfPose() {
    set_log_sink([this](LogLevel, const std::string& line) { lines_.push_back(line); });
  }
  ~GltfPose() override { set_log_sink({}); }
  std::vector<std::string> lines_;
};

/// Vertex `v` of instance `i` in the world.
vec3 vertex(const Scene& scene, std::size_t v, std::size_t i = 0, float time = 0) {
  const auto& instance = scene.instances.at(i);
  return {scene::world_matrices(scene, time)[instance.node] *
          vec4(scene.meshes[instance.mesh].positions.at(v), 1)};
}

bool moves(const Scene& scene, std::size_t i = 0) {
  return scene.nodes[scene.instances.at(i).node].movable;
}

void expect_near(const vec3& found, const vec3& wanted) {
  EXPECT_LE(glm::length(found - wanted), 1e-5f) << found.x << " " << found.y << " " << found.z << ", not "
                                                << wanted.x << " " << wanted.y << " " << wanted.z;
}

/// A triangle, its normals along z, and two targets: the second vertex goes up by 1, the third by 2 in z.
struct Morphing {
  GlbBuilder b;
  Morphing() {
    b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
    b.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
    b.add<float>({0, 0, 0, 0, 1, 0, 0, 0, 0}, 5126, "VEC3", 3);
    b.add<float>({0, 0, 0, 0, 0, 0, 0, 0, 2}, 5126, "VEC3", 3);
    b.add<float>({0, 0, 0, 3, 0, 0, 0, 0, 0}, 5126, "VEC3", 3);  // of the first's normals
  }
  std::vector<std::byte> glb(const std::string& nodes, const std::string& mesh = "",
                             const std::string& more = "") const {
    return b.glb("\"nodes\":[" + nodes +
                 "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"targets\":["
                 "{\"POSITION\":2,\"NORMAL\":4},{\"POSITION\":3}]}]" +
                 mesh + "}]" + more);
  }
};

TEST_F(GltfPose, MorphTargetsAddByTheirWeights) {
  const Morphing file;
  const Scene flat = load_gltf(file.glb("{\"mesh\":0}"), "f");
  expect_near(vertex(flat, 1), {1, 0, 0});
  const Scene of_mesh = load_gltf(file.glb("{\"mesh\":0}", ",\"weights\":[0.5,0.25]"), "f");
  expect_near(vertex(of_mesh, 0), {0, 0, 0});
  expect_near(vertex(of_mesh, 1), {1, 0.5f, 0});
  expect_near(vertex(of_mesh, 2), {0, 1, 0.5f});
  expect_near(of_mesh.meshes[0].normals[0], {0, 0, 1});
  expect_near(of_mesh.meshes[0].normals[1], glm::normalize(vec3(1.5f, 0, 1)));
  const Scene of_node = load_gltf(file.glb("{\"mesh\":0,\"weights\":[1,0]}", ",\"weights\":[0.5,0.25]"), "f");
  expect_near(vertex(of_node, 1), {1, 1, 0});
  expect_near(vertex(of_node, 2), {0, 1, 0});
  for (const Scene* scene : {&flat, &of_mesh, &of_node}) {
    EXPECT_FALSE(moves(*scene));
    EXPECT_THAT(scene->ignored, IsEmpty());
    EXPECT_EQ(scene->nodes.size(), 1u);
  }
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(GltfPose, NodesThatShareAMeshHaveTheirOwnShapes) {
  const Scene scene = load_gltf(Morphing().glb("{\"mesh\":0,\"weights\":[1,0]},{\"mesh\":0},"
                                               "{\"mesh\":0,\"weights\":[0,1],\"translation\":[5,0,0]}"),
                                "f");
  EXPECT_EQ(scene.meshes.size(), 3u);
  expect_near(vertex(scene, 1, 0), {1, 1, 0});
  expect_near(vertex(scene, 1, 1), {1, 0, 0});
  expect_near(vertex(scene, 2, 2), {5, 1, 2});
}

TEST_F(GltfPose, AnimatedWeightsGiveTheShapeOfATime) {
  Morphing file;
  file.b.add<float>({0, 2}, 5126, "SCALAR", 2);        // 5
  file.b.add<float>({0, 1, 1, 0}, 5126, "SCALAR", 4);  // 6: both weights of each key
  const auto glb = file.glb(
      "{\"mesh\":0,\"name\":\"face\"}", "",
      ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}],"
      "\"samplers\":[{\"input\":5,\"output\":6}]}]");
  const Scene scene = load_gltf(glb, "f", 0.5f);
  expect_near(vertex(scene, 1), {1, 0.25f, 0});
  expect_near(vertex(scene, 2), {0, 1, 1.5f});
  expect_near(vertex(scene, 1, 0, 2), {1, 0.25f, 0});
  EXPECT_TRUE(moves(scene));
  EXPECT_EQ(scene::animation_duration(scene), 2);
  EXPECT_EQ(scene.nodes[scene.instances[0].node].name, "face");
  EXPECT_THAT(lines_,
              ElementsAre("f: 1 of its meshes change shape over time (skins, morph targets): they have that "
                          "of 0.5 s (--time) and keep it while time goes on"));
  expect_near(vertex(load_gltf(glb, "f", 9), 1), {1, 1, 0});
}

// Key: in-tangents, values, out-tangents, each of both targets. Hermite at the middle: a/2 + b/2 + dt (out −
// in)/8.
TEST_F(GltfPose, CubicWeightsFollowTheirTangents) {
  Morphing file;
  file.b.add<float>({0, 2}, 5126, "SCALAR", 2);
  file.b.add<float>({0, 0, 1, 0, 4, 0, 0, 0, 0, 0, 0, 0}, 5126, "SCALAR", 12);
  const auto glb = file.glb(
      "{\"mesh\":0}", "",
      ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}],"
      "\"samplers\":[{\"input\":5,\"output\":6,\"interpolation\":\"CUBICSPLINE\"}]}]");
  expect_near(vertex(load_gltf(glb, "f", 1), 1), {1, 0.5f + 2 * 4 / 8.0f, 0});
}

/// A strip of three vertices at y = 0, 1, 2, bound to joint 0 at the origin, to both halfway, and to joint 1
/// at y = 1.
struct Bar {
  GlbBuilder b;
  std::string matrices = ",\"inverseBindMatrices\":3", joints = "[1,2]";
  explicit Bar(float last_joint = 1) {
    b.add<float>({0, 0, 0, 1, 1, 0, 0, 2, 0}, 5126, "VEC3", 3);
    b.accessor(fmt::format(
        "\"bufferView\":{},\"componentType\":5121,\"type\":\"VEC4\",\"count\":3",
        b.view<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, static_cast<std::uint8_t>(last_joint), 0, 0, 0})));
    b.add<float>({1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 3);
    b.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                 5126, "MAT4", 2);
    b.add<float>({0, 0, 1, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);  // 4 normals
    b.add<float>({0, 1}, 5126, "SCALAR", 2);                     // 5 times
    b.add<float>({0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f}, 5126, "VEC4", 2);
  }
  /// The second joint, turned or scaled by `joint`.
  std::vector<std::byte> glb(const std::string& joint, const std::string& more = "",
                             const std::string& scene = "[0,1]") const {
    return b.glb(
        "\"scenes\":[{\"nodes\":" + scene +
        "}],\"nodes\":[{\"mesh\":0,\"skin\":0,\"name\":\"bar\",\"translation\":[7,7,7]},{\"children\":[2]},{"
        "\"translation\":[0,1,0]" +
        joint +
        "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,\"WEIGHTS_0\":2,"
        "\"NORMAL\":4}}]}],\"skins\":[{\"joints\":" +
        joints + matrices + "}]" + more);
  }
};

const std::string quarter_turn = ",\"rotation\":[0,0,0.70710678,0.70710678]";

TEST_F(GltfPose, SkinsFollowTheirJointsAndNotTheirNode) {
  const Scene rest = load_gltf(Bar().glb(""), "f");
  expect_near(vertex(rest, 1), {1, 1, 0});
  expect_near(vertex(rest, 2), {0, 2, 0});
  const Scene turned = load_gltf(Bar().glb(quarter_turn), "f");
  expect_near(vertex(turned, 0), {0, 0, 0});
  // The mean of (1, 1) and, turned about (0, 1), (0, 2)
  expect_near(vertex(turned, 1), {0.5f, 1.5f, 0});
  expect_near(vertex(turned, 2), {-1, 1, 0});
  expect_near(turned.meshes[0].normals[0], {0, 0, 1});
  expect_near(turned.meshes[0].normals[2], {-1, 0, 0});
  EXPECT_FALSE(moves(turned));
  EXPECT_THAT(turned.ignored, IsEmpty());
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(GltfPose, NormalsOfStretchedSkinsStayNormal) {
  const Bar bar;
  const Scene scene = load_gltf(bar.glb(",\"scale\":[2,1,4]"), "f");
  expect_near(scene.meshes[0].normals[2], {0, 1, 0});
  expect_near(scene.meshes[0].normals[0], {0, 0, 1});
  // x times 2 and z times 4: a normal of (1, 0, 1) becomes one of (1/2, 0, 1/4)
  scene::Mesh mesh;
  mesh.positions = {vec3(0)}, mesh.normals = {glm::normalize(vec3(1, 0, 1))},
  mesh.tangents = {vec4(1, 0, -1, -1)};
  ASSERT_FALSE(bend(mesh, {{{vec4(0)}, {vec4(1, 0, 0, 0)}}}, {mat4(mat3(2, 0, 0, 0, 1, 0, 0, 0, 4))}));
  expect_near(mesh.normals[0], glm::normalize(vec3(0.5f, 0, 0.25f)));
  expect_near(vec3(mesh.tangents[0]), glm::normalize(vec3(2, 0, -4)));
  EXPECT_EQ(mesh.tangents[0].w, -1);
}

TEST_F(GltfPose, WeightsNeedNotAddUpToOne) {
  const std::vector<mat4> joints = {mat4(1), glm::translate(mat4(1), vec3(8, 0, 0))};
  scene::Mesh mesh;
  mesh.positions = {vec3(0), vec3(0)};
  ASSERT_FALSE(
      bend(mesh, {{{vec4(0, 1, 0, 0), vec4(1, 0, 0, 0)}, {vec4(0.2f, 0.2f, 0, 0), vec4(0)}}}, joints));
  expect_near(mesh.positions[0], {4, 0, 0});
  expect_near(mesh.positions[1], {8, 0, 0});
  EXPECT_EQ(bend(mesh, {{{vec4(0), vec4(0, 0, 2, 0)}, {vec4(1), vec4(1)}}}, joints), 1u);
}

TEST_F(GltfPose, AnimatedJointsGiveTheShapeOfATime) {
  const auto glb = Bar().glb(
      "",
      ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}}],"
      "\"samplers\":[{\"input\":5,\"output\":6}]}]");
  const Scene start = load_gltf(glb, "f", 0), end = load_gltf(glb, "f", 1);
  expect_near(vertex(start, 2), {0, 2, 0});
  expect_near(vertex(end, 2), {-1, 1, 0});
  expect_near(vertex(start, 2, 0, 1), {0, 2, 0});
  EXPECT_TRUE(moves(start));
  EXPECT_THAT(lines_, testing::SizeIs(2));
  Scene checked = start;
  EXPECT_THAT(scene::validate(checked), IsEmpty());
  EXPECT_TRUE(moves(checked)) << "by its animation, which validate() asks";
  expect_near(vertex(load_gltf(export_glb(checked), "f"), 2), {0, 2, 0});
}

TEST_F(GltfPose, ShapesOfTheirOwnCountAsDecodedData) {
  // Eight copies of 200,000 vertices, 32 bytes each, are within 64 MiB; thirty are not. The file has few
  // bytes.
  const auto file = [](int copies) {
    GlbBuilder b;
    for (int i = 0; i < 2; ++i) b.accessor("\"componentType\":5126,\"type\":\"VEC3\",\"count\":200001");
    std::string nodes;
    for (int i = 0; i <= copies; ++i) nodes += std::string(i > 0 ? "," : "") + "{\"mesh\":0,\"weights\":[1]}";
    return b.glb("\"nodes\":[" + nodes +
                 "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":"
                 "1}]}]}]");
  };
  EXPECT_EQ(load_gltf(file(2), "f").meshes.size(), 3u);
  EXPECT_THAT(said_of(file(30)),
              testing::MatchesRegex("f: nodes.*: the file asks for more than 64 MiB of decoded data, .*"));
}

TEST_F(GltfPose, WhatIsWrongIsNamed) {
  EXPECT_EQ(said_of(Morphing().glb("{\"mesh\":0,\"weights\":[1]}")),
            "f: nodes[0].weights: has 1 weights, the mesh has 2 targets");
  EXPECT_EQ(said_of(Bar(2).glb("")), "f: nodes[0]: vertex 2 names a joint that its skin of 2 joints lacks");
  Bar three;
  three.joints = "[1,2,1]";
  EXPECT_EQ(said_of(three.glb("")), "f: skins[0].inverseBindMatrices: has 2 matrices, the skin 3 joints");
  three.matrices = "";
  EXPECT_EQ(said_of(three.glb("")), "no error");
  three.joints = "[]";
  EXPECT_THAT(said_of(three.glb("")), HasSubstr("f: skins[0].joints: "));
  EXPECT_THAT(load_gltf(Bar().glb("", "", "[0]"), "f").ignored,
              ElementsAre("skin with joints outside the scene (1)"));
  Morphing file;
  file.b.add<float>({0, 2}, 5126, "SCALAR", 2);
  file.b.add<float>({0, 1, 1}, 5126, "SCALAR", 3);
  EXPECT_EQ(said_of(file.glb("{\"mesh\":0}", "",
                             ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
                             "\"weights\"}}],\"samplers\":[{\"input\":5,\"output\":6}]}]")),
            "f: animations[0].samplers[0].output: has 3 values, 2 keyframes of 2 targets need 4");
}

}  // namespace
}  // namespace ssphh::scene_io
