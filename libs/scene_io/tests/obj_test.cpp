#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/obj.h>

#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using testing::HasSubstr;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string obj_error(const std::string& text) {
  try {
    load_obj(text, "test.obj");
  } catch (const Error& e) {
    return e.what();
  }
  ADD_FAILURE() << "it loaded: " << text;
  return {};
}

// Scene of an OBJ with a material library beside it.
Scene load_with_mtl(const std::string& obj, const std::string& mtl, const test::TempDir& folder) {
  write_file(folder / "test.mtl", mtl);
  return load_obj("mtllib test.mtl\n" + obj, folder / "test.obj");
}

TEST(Obj, PolygonsBecomeTrianglesThatKeepTheirFront) {
  const Scene scene = load_obj(square + "f 1 2 3 4\n", "test.obj");
  const auto& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u) << "shared corners are one vertex";
  for (const uvec3& t : mesh.triangles) {
    const vec3 n =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    EXPECT_EQ(n, vec3(0, 0, 1));
  }
}

TEST(Obj, NegativeIndicesCountBackwards) {
  const Scene scene = load_obj(square + "f -4 -3 -2\nv 9 9 9\nf -5 -4 -1\n", "test.obj");
  const auto& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions[mesh.triangles[0].x], vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions[mesh.triangles[1].x], vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions[mesh.triangles[1].z], vec3(9, 9, 9));
}

TEST(Obj, TextureCoordinatesAreTurnedToPointDown) {
  const Scene scene = load_obj(square + "vt 0.25 0.125\nf 1/1 2/1 3/1\n", "test.obj");
  EXPECT_EQ(scene.meshes.at(0).uvs[0].at(0), vec2(0.25f, 0.875f));
}

TEST(Obj, NormalsAreNormalizedAndMissingOnesAreTheFaces) {
  const Scene scene = load_obj(square + "vn 0 3 4\nf 1//1 2//1 3//1\nf 1 3 4\n", "test.obj");
  const auto& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.normals[mesh.triangles[0].x], vec3(0, 0.6f, 0.8f));
  EXPECT_EQ(mesh.normals[mesh.triangles[1].x], vec3(0, 0, 1));
}

TEST(Obj, GroupsAndMaterialsMakeMeshes) {
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  const Scene scene =
      load_obj(square +
                   "o a\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\no b\nusemtl red\nf 1 2 3\n"
                   "o a\nf 1 3 4\n",
               "test.obj");
  set_log_sink(before);
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u) << "an object may come back";
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.nodes[2].name, "b");
}

TEST(Obj, CommentsBlanksAndContinuedLinesAreUnderstood) {
  const Scene scene =
      load_obj("# nothing\r\n\r\n  v 0 0 0 # origin\r\nv\t1 0 0\r\nv 1 \\\r\n 1 0\nf 1 \\\n2 3", "t.obj");
  EXPECT_EQ(scene::triangle_count(scene), 1u);
  EXPECT_EQ(scene.meshes[0].positions[2], vec3(1, 1, 0));
}

TEST(Obj, ErrorsNameFileAndLine) {
  EXPECT_THAT(obj_error("v 0 0 0\nv 0 nan 0\n"), HasSubstr("test.obj:2: the coordinate nan is not finite"));
  EXPECT_THAT(obj_error("v 0 0 1e99\n"), HasSubstr("test.obj:1"));
  EXPECT_THAT(obj_error("v 0 zero 0\n"), HasSubstr("\"zero\" is no number"));
  EXPECT_THAT(obj_error("v 0 0\n"), HasSubstr("a coordinate is missing"));
  EXPECT_THAT(obj_error(square + "f 1 2 5\n"),
              HasSubstr("test.obj:5: vertex index 5 out of range, 4 are defined so far"));
  EXPECT_THAT(obj_error(square + "f 1 2 0\n"), HasSubstr("out of range"));
  EXPECT_THAT(obj_error(square + "f 1 2 -5\n"), HasSubstr("out of range"));
  EXPECT_THAT(obj_error(square + "f 1/1 2/1 3/1\n"), HasSubstr("texture coordinate index 1 out of range"));
  EXPECT_THAT(obj_error(square + "f 1 2 99999999999999999999\n"), HasSubstr("no vertex index"));
  EXPECT_THAT(obj_error(""), HasSubstr("holds no faces"));
}

TEST(Obj, WhatIsIgnoredIsListed) {
  const Scene scene = load_obj(square + "l 1 2\nl 2 3\np 1\nwhatever\ns 1\nf 1 2 3\nf 1 2\n", "test.obj");
  EXPECT_THAT(
      scene.ignored,
      testing::ElementsAre("OBJ statement l (2)", "OBJ statement p (1)", "face with fewer than 3 corners (1)",
                           "smoothing group without normals (1)", "unknown OBJ statement (1)"));
}

TEST(Obj, AMissingLibraryIsAWarningAndADefaultStandsIn) {
  std::vector<std::string> messages;
  const LogSink before = set_log_sink([&](LogLevel, const std::string& m) { messages.push_back(m); });
  const Scene scene = load_obj("mtllib none.mtl\n" + square + "usemtl red\nf 1 2 3\n", "test.obj");
  set_log_sink(before);
  EXPECT_THAT(messages, testing::Contains(HasSubstr("none.mtl")));
  EXPECT_THAT(messages, testing::Contains(HasSubstr("material \"red\" is not defined")));
  EXPECT_EQ(scene.materials.at(0).base_color, vec3(0.8f));
}

TEST(Mtl, ValuesBecomeMaterials) {
  const test::TempDir folder;
  const Scene scene =
      load_with_mtl(square + "usemtl lamp\nf 1 2 3\nusemtl metal\nf 1 2 3\nusemtl shiny\nf 1 2 3\n",
                    "newmtl lamp\nKd 0.5 0.25 0\nKe 17 12 4\nd 0.5\nTr 0.9\n"
                    "newmtl metal\nKd 0 0 0\nKs 0.9 0.8 0.7\nNs 6\nillum 2\n"
                    "newmtl shiny\nKd 0.5\nKs 0.04\nNs 30\n",
                    folder);
  const auto& lamp = scene.materials.at(0);
  EXPECT_EQ(lamp.base_color, vec3(0.5f, 0.25f, 0));
  EXPECT_EQ(lamp.emission, vec3(17, 12, 4));
  EXPECT_EQ(lamp.specular, 0);
  EXPECT_EQ(lamp.alpha, 0.5f) << "d counts, not Tr";
  EXPECT_EQ(lamp.alpha_mode, scene::AlphaMode::blend);
  EXPECT_FALSE(lamp.double_sided);
  EXPECT_EQ(scene.instances[0].light_group, "lamp");

  const auto& metal = scene.materials.at(1);
  EXPECT_EQ(metal.metallic, 1);
  EXPECT_EQ(metal.base_color, vec3(0.9f, 0.8f, 0.7f));
  // α² = 2/(6 + 2) = 1/4, roughness = √α = √(1/2); below 0: Blinn–Phong
  EXPECT_FLOAT_EQ(metal.specular_roughness, -std::sqrt(0.5f));

  const auto& shiny = scene.materials.at(2);
  EXPECT_EQ(shiny.metallic, 0);
  EXPECT_EQ(shiny.base_color, vec3(0.5f));
  EXPECT_NEAR(shiny.ior, 1.5f, 1e-6f);  // F0 = 0.04 is glass; float rounding of two roots
}

TEST(Mtl, TexturesAreReadBesideTheLibraryWithTheirOptions) {
  const test::TempDir folder;
  image::Rgba8 texel{2, 1, {255, 0, 0, 255, 0, 255, 0, 128}};
  write_file(folder / "my texture.png", image::encode_png(texel));
  const Scene scene = load_with_mtl(square + "usemtl a\nf 1 2 3\n",
                                    "newmtl a\nmap_Kd -s 2 3 1 -o 0.5 0.25 -clamp on my texture.png\n"
                                    "map_d my texture.png\n",
                                    folder);
  ASSERT_EQ(scene.textures.size(), 1u) << "colour and coverage of one file with alpha are one texture";
  EXPECT_EQ(scene.textures[0].rgba, texel.rgba);
  const auto& use = scene.materials[0].base_color_texture;
  EXPECT_EQ(use.texture, 0);
  EXPECT_EQ(use.wrap_u, scene::Wrap::clamp);
  EXPECT_EQ(scene.materials[0].alpha_mode, scene::AlphaMode::blend);
  // v up: 3·v + 0.25; with v' = 1 − v it is 1 − (3(1 − v') + 0.25)
  const float v = 0.3f;
  EXPECT_FLOAT_EQ(use.offset.y + use.scale.y * (1 - v), 1 - (3 * v + 0.25f));
  EXPECT_FLOAT_EQ(use.offset.x + use.scale.x * v, 2 * v + 0.5f);
}

TEST(Mtl, CoverageWithoutAlphaChannelIsTheRedChannel) {
  const test::TempDir folder;
  write_file(folder / "mask.png", image::encode_png(image::Rgba8{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}));
  const Scene scene = load_with_mtl(square + "usemtl a\nf 1 2 3\n", "newmtl a\nmap_d mask.png\n", folder);
  const int texture = scene.materials[0].base_color_texture.texture;
  EXPECT_EQ(scene.textures.at(static_cast<std::size_t>(texture)).rgba,
            (std::vector<std::uint8_t>{255, 255, 255, 0, 255, 255, 255, 255}));
}

TEST(Mtl, ErrorsNameFileAndLine) {
  const test::TempDir folder;
  const auto error = [&](const std::string& mtl) {
    try {
      load_with_mtl(square + "f 1 2 3\n", mtl, folder);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    ADD_FAILURE() << "it loaded";
    return std::string();
  };
  EXPECT_THAT(error("newmtl a\nKd nan 0 0\n"), HasSubstr("test.mtl:2: Kd: \"nan\" is no finite number"));
  EXPECT_THAT(error("newmtl a\n\nNs\n"), HasSubstr("test.mtl:3: Ns"));
  EXPECT_THAT(error("newmtl a\nKe -1 0 0\n"), HasSubstr("must not be negative"));
  EXPECT_THAT(error("Kd 1 1 1\n"), HasSubstr("before the first newmtl"));
}

const std::string rich_obj =
    "mtllib none.mtl\n" + square +
    "v 0.5 0.2 0\nvt 0 0\nvt 1 1\nvn 0 0 1\no a\nusemtl m\nf 1/1/1 2/2/1 3/1/1 4/2/1 5/1/1\n"
    "g b\nf -5//1 -4//1 -3//1\ns 1\nl 1 2\n";

TEST(Obj, TruncatedFilesAndFlippedBitsLoadOrGiveAnError) {
  const LogSink before = set_log_sink([](LogLevel, const std::string&) {});
  int errors = 0;
  const auto attempt = [&](const std::string& text) {
    try {
      Scene scene = load_obj(text, "/nonexistent/test.obj");
      scene::validate(scene);
    } catch (const Error&) {
      ++errors;
    }
  };
  for (std::size_t size = 0; size < rich_obj.size(); ++size) attempt(rich_obj.substr(0, size));
  for (std::size_t bit = 0; bit < rich_obj.size() * 8; ++bit) {
    std::string broken = rich_obj;
    broken[bit / 8] = static_cast<char>(broken[bit / 8] ^ (1 << (bit % 8)));
    attempt(broken);
  }
  set_log_sink(before);
  EXPECT_GT(errors, 200);
}

}  // namespace
}  // namespace ssphh::scene_io
