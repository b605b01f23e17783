#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>

#include "glb_builder.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using test::GlbBuilder;
using testing::HasSubstr;

Scene load_glb(const std::vector<std::byte>& glb) {
  return load_gltf(glb, "test.glb");
}

Scene load_text(const std::string& json) {
  return load_gltf(std::as_bytes(std::span(json.data(), json.size())), "test.gltf");
}

// The message of the error that loading gives; fails the test when it loads.
template <class Load>
std::string loading_error(const Load& load) {
  try {
    load();
  } catch (const Error& e) {
    return e.what();
  }
  ADD_FAILURE() << "it loaded";
  return {};
}

std::string loading_error_of_json(const std::string& json) {
  return loading_error([&] { load_text(json); });
}

const std::string triangle_mesh = "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]";

TEST(Gltf, ReadsSomeOfEverything) {
  const Scene scene = load_glb(test::rich_glb());
  ASSERT_EQ(scene.nodes.size(), 4u);
  EXPECT_EQ(scene.name, "rich");
  EXPECT_EQ(scene.nodes[1].parent, 0);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene::light_group(scene, scene.instances[0]), "panel");

  const auto& m = scene.materials.at(0);
  EXPECT_EQ(m.base_color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(m.alpha, 0.75f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.specular_roughness, 0.25f);
  EXPECT_EQ(m.emission, vec3(4, 2, 0));
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.alpha_mode, scene::AlphaMode::blend);

  const auto& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions[2], vec3(0, 1, 0));
  EXPECT_EQ(mesh.uvs[0][1], vec2(1, 0)) << "normalised bytes";
  EXPECT_TRUE(mesh.normals.empty());

  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, scene::LightType::spot);
  EXPECT_EQ(scene.lights[0].intensity, 7);
  EXPECT_EQ(scene.lights[0].outer_cone, 0.2f);
  EXPECT_EQ(scene.cameras.at(0).name, "lamp");
  ASSERT_EQ(scene.sphls.size(), 1u);
  EXPECT_EQ(scene.sphls[0].radius, 0.25f);
}

TEST(Gltf, WhatIsBelowAnAnimatedNodeIsMovableAndMoves) {
  const Scene scene = load_glb(test::rich_glb());
  EXPECT_TRUE(scene.nodes[0].movable);
  EXPECT_TRUE(scene.nodes[1].movable);
  EXPECT_TRUE(scene.nodes[2].movable);
  EXPECT_FALSE(scene.nodes[3].movable);
  // SPHL at (0, 2, 0) below the root, which goes from (0, 0, 0) to (1, 2, 3)
  EXPECT_EQ(scene::sphl_places(scene, 1)[0].position, vec3(1, 4, 3));
}

TEST(Gltf, NegativeScaleIsKept) {
  const Scene scene = load_glb(test::rich_glb());
  EXPECT_LT(glm::determinant(mat3(scene::world_matrices(scene)[1])), 0);
}

TEST(Gltf, QuantizedAttributesAreScaledToUnitRange) {
  GlbBuilder b;
  b.add<std::int16_t>({0, 0, 0, 32767, -32768, 0, 0, 16384, 0}, 5122, "VEC3", 3, ",\"normalized\":true");
  b.add<std::int8_t>({127, 0, 0, -128, 0, 0, 0, 0, 127}, 5120, "VEC3", 3, ",\"normalized\":true");
  const Scene scene =
      load_glb(b.glb("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
                     "{\"POSITION\":0,\"NORMAL\":1}}]}],\"extensionsRequired\":[\"KHR_mesh_quantization\"]"));
  EXPECT_EQ(scene.meshes[0].positions[1], vec3(1, -1, 0));
  EXPECT_FLOAT_EQ(scene.meshes[0].positions[2].y, 16384 / 32767.0f);
  EXPECT_EQ(scene.meshes[0].normals[1], vec3(-1, 0, 0));
}

TEST(Gltf, UnnormalizedIntegersKeepTheirValue) {
  GlbBuilder b;
  b.add<std::uint16_t>({0, 0, 0, 500, 0, 0, 0, 7, 0}, 5123, "VEC3", 3);
  const Scene scene = load_glb(b.glb("\"nodes\":[{\"mesh\":0}]," + triangle_mesh));
  EXPECT_EQ(scene.meshes[0].positions[1], vec3(500, 0, 0));
}

TEST(Gltf, PrimitivesThatShareAVertexBufferKeepOnlyTheirVertices) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0, 7, 7, 7, 8, 8, 8}, 5126, "VEC3", 8);
  b.add<std::uint8_t>({0, 1, 2}, 5121, "SCALAR", 3);
  b.add<std::uint8_t>({5, 3, 4}, 5121, "SCALAR", 3);
  const Scene scene =
      load_glb(b.glb("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":["
                     "{\"attributes\":{\"POSITION\":0},\"indices\":1},"
                     "{\"attributes\":{\"POSITION\":0},\"indices\":2}]}]"));
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(scene.meshes[1].positions.size(), 3u);
  const uvec3 t = scene.meshes[1].triangles[0];
  EXPECT_EQ(scene.meshes[1].positions[t.x], vec3(5, 1, 0));
  EXPECT_EQ(scene.meshes[1].positions[t.y], vec3(5, 0, 0));
  EXPECT_EQ(scene.meshes[1].positions[t.z], vec3(6, 0, 0));
}

TEST(Gltf, NodesAreSortedParentsFirst) {
  const Scene scene = load_text(
      "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"name\":\"leaf\"},{\"name\":\"middle\",\"children\":[0]}"
      ","
      "{\"name\":\"top\",\"children\":[1]}]}");
  ASSERT_EQ(scene.nodes.size(), 3u);
  EXPECT_EQ(scene.nodes[0].name, "top");
  EXPECT_EQ(scene.nodes[2].name, "leaf");
  EXPECT_EQ(scene.nodes[2].parent, 1);
}

TEST(Gltf, ExtrasGiveSpheresDiscsAndBipolarRoughness) {
  const Scene scene = load_text(
      "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
      "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},{\"extensions\":{\"KHR_lights_punctual\":{"
      "\"light\":2}}}],"
      "\"materials\":[{\"extras\":{\"ssphh\":{\"diffuse_roughness\":-0.4,\"specular_roughness\":-0.3}}}],"
      "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
      "{\"type\":\"point\",\"extras\":{\"ssphh\":{\"type\":\"sphere\",\"radius\":0.5,\"radiance\":4}}},"
      "{\"type\":\"point\",\"intensity\":3,\"extras\":{\"ssphh\":{\"type\":\"sphere\",\"radius\":2}}},"
      "{\"type\":\"directional\",\"extras\":{\"ssphh\":{\"angular_radius\":0.1},\"light_group\":\"day\"}}]}}"
      "}");
  EXPECT_EQ(scene.lights[0].type, scene::LightType::sphere);
  EXPECT_EQ(scene.lights[0].intensity, 4);
  EXPECT_FLOAT_EQ(scene.lights[1].intensity, 3 / (pi * 4)) << "intensity / (π radius²)";
  EXPECT_EQ(scene.lights[2].angular_radius, 0.1f);
  EXPECT_EQ(scene::light_group(scene.lights[2]), "day");
  EXPECT_EQ(scene.materials[0].diffuse_roughness, -0.4f);
  EXPECT_EQ(scene.materials[0].specular_roughness, -0.3f);
}

TEST(Gltf, WhatIsIgnoredIsListedWithCounts) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const Scene scene = load_glb(b.glb(
      "\"nodes\":[{\"mesh\":0},{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
      "\"JOINTS_0\":0},\"targets\":[{\"POSITION\":0},{\"POSITION\":0}]},"
      "{\"attributes\":{\"POSITION\":0},\"mode\":1}]}],"
      "\"materials\":[{\"extensions\":{\"KHR_materials_sheen\":{}}},{\"extensions\":{\"KHR_materials_sheen\":"
      "{}}}]"));
  EXPECT_THAT(scene.ignored,
              testing::UnorderedElementsAre("extension KHR_materials_sheen (2)", "mesh of lines (1)"));
}

TEST(Gltf, ErrorsNameFileAndPlace) {
  const std::string asset = "{\"asset\":{\"version\":\"2.0\"},";
  EXPECT_THAT(loading_error_of_json(asset + "\"meshes\":[{\"primitives\":[]},{\"primitives\":[]}],"
                                            "\"nodes\":[{},{},{},{\"mesh\":7}]}"),
              HasSubstr("test.gltf: nodes[3].mesh: index 7 out of range, the file has 2 meshes"));
  EXPECT_THAT(loading_error_of_json(
                  asset + "\"nodes\":[{\"children\":[1]},{\"children\":[0]}],\"scenes\":[{\"nodes\":[0]}]}"),
              HasSubstr("nodes must form trees"));
  EXPECT_THAT(loading_error_of_json(asset + "\"nodes\":[{\"rotation\":[0,0,0,0]}]}"),
              HasSubstr("nodes[0].rotation"));
  EXPECT_THAT(loading_error_of_json(asset + "\"nodes\":[{\"translation\":[0,1e39,0]}]}"),
              HasSubstr("too large"));
  EXPECT_THAT(loading_error_of_json(asset + "\"nodes\":{}}"), HasSubstr("must be an array"));
  EXPECT_THAT(loading_error_of_json("{\"asset\":{\"version\":\"1.0\"}}"),
              HasSubstr("glTF 1.0 cannot be read"));
  EXPECT_THAT(loading_error_of_json("{"), HasSubstr("is not valid JSON"));
  EXPECT_THAT(loading_error_of_json(std::string(100'000, '[')), HasSubstr("nested deeper"));
  EXPECT_THAT(loading_error_of_json(asset + "\"extensionsRequired\":[\"KHR_texture_basisu\"]}"),
              HasSubstr("export it with PNG"));
  EXPECT_THAT(
      loading_error_of_json(asset + "\"buffers\":[{\"byteLength\":4,\"uri\":\"../../etc/nothing.bin\"}]}"),
      HasSubstr("buffers[0].uri"));
  EXPECT_THAT(loading_error_of_json(asset + "\"buffers\":[{\"byteLength\":4,\"uri\":\"/etc/passwd\"}]}"),
              HasSubstr("is not a relative file name"));
  EXPECT_THAT(
      loading_error_of_json(asset + "\"buffers\":[{\"byteLength\":9,\"uri\":\"data:;base64,AAAA\"}]}"),
      HasSubstr("only 3 bytes are there"));
}

TEST(Gltf, DataThatIsOutOfBoundsIsAnError) {
  const auto error = [](const GlbBuilder& b, const std::string& members) {
    return loading_error([&] { load_glb(b.glb(members)); });
  };
  GlbBuilder indices;
  indices.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  indices.add<std::uint32_t>({0, 1, 3}, 5125, "SCALAR", 3);
  EXPECT_THAT(error(indices,
                    "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                    "\"indices\":1}]}]"),
              HasSubstr("meshes[0].primitives[0].indices: element 2 is 3, the mesh has 3 vertices"));
  GlbBuilder too_long;
  too_long.add<float>({0, 0, 0}, 5126, "VEC3", 4'000'000'000u);
  EXPECT_THAT(error(too_long, "\"nodes\":[{\"mesh\":0}]," + triangle_mesh), HasSubstr("do not fit"));
  GlbBuilder not_finite;
  not_finite.add<float>({0, 0, 0, NAN, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  EXPECT_THAT(error(not_finite, "\"nodes\":[{\"mesh\":0}]," + triangle_mesh),
              HasSubstr("accessors[0]: element 1 is NaN or infinite"));
  GlbBuilder two_lengths;
  two_lengths.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  two_lengths.add<float>({0, 0, 1, 0}, 5126, "VEC2", 2);
  EXPECT_THAT(error(two_lengths,
                    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}}]}]"),
              HasSubstr("elements"));
}

TEST(Gltf, AFewBytesCannotAskForGigabytes) {
  // Accessors without a bufferView are zeros and cost the file nothing
  const std::string json =
      "{\"asset\":{\"version\":\"2.0\"},\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":"
      "4000000000}],"
      "\"nodes\":[{\"mesh\":0}]," +
      triangle_mesh + "}";
  EXPECT_THAT(loading_error_of_json(json), HasSubstr("too much for its size"));
}

TEST(Gltf, MissingImagesAreWarningsAndLeaveTheFactor) {
  std::vector<std::string> messages;
  const LogSink before = set_log_sink([&](LogLevel, const std::string& m) { messages.push_back(m); });
  const Scene scene = load_text(
      "{\"asset\":{\"version\":\"2.0\"},\"images\":[{\"uri\":\"nothing.png\"}],\"textures\":[{\"source\":0}],"
      "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"baseColorFactor\":[1,0."
      "5,0,1]}}]}");
  set_log_sink(before);
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
  EXPECT_EQ(scene.materials[0].base_color, vec3(1, 0.5f, 0));
  EXPECT_THAT(messages, testing::Contains(HasSubstr("nothing.png")));
}

TEST(Gltf, TruncatedFilesNeverCrash) {
  const auto whole = test::rich_glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(load_glb({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), Error)
        << size << " bytes";
  }
}

TEST(Gltf, FilesWithFlippedBitsLoadOrGiveAnError) {
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  const auto whole = test::rich_glb();
  int errors = 0;
  for (std::size_t bit = 0; bit < whole.size() * 8; bit += 5) {  // every byte, another bit each time
    auto broken = whole;
    broken[bit / 8] ^= static_cast<std::byte>(1 << (bit % 8));
    try {
      Scene scene = load_glb(broken);
      scene::validate(scene);
    } catch (const Error&) {
      ++errors;
    }
  }
  set_log_sink(before);
  EXPECT_GT(errors, 500);
}

}  // namespace
}  // namespace ssphh::scene_io
