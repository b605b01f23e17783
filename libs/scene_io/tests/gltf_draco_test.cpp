/// Primitives packed by Draco: scenes packed here come back, exactly or as far as they were quantised.

#include <algorithm>
#include <functional>

#include <draco/compression/encode.h>
#include <gmock/gmock.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>

#include "error_message.h"
#include "glb_file.h"
#include "gltf_bytes.h"
#include "shared_scenes.h"

namespace ssphh::scene_io {
namespace {

using test::GlbFile;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;
using Bytes = std::vector<std::byte>;
using Attribute = draco::GeometryAttribute;

template <class Vector>
int add(draco::Mesh& mesh, Attribute::Type type, const std::vector<Vector>& values) {
  Attribute attribute;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(Vector::length()), draco::DT_FLOAT32, false,
                 sizeof(Vector), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(i)),
                                          &values[i]);
  return static_cast<int>(mesh.attribute(id)->unique_id());
}

/// How meshes are packed.
struct Packing {
  draco::MeshEncoderMethod method = draco::MESH_SEQUENTIAL_ENCODING;
  int bits = 0;  ///< 0: floats as they are
};

Bytes encoded(const draco::Mesh& mesh, draco::Encoder& encoder) {
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
  return {begin, begin + buffer.size()};
}

/// Packs a mesh; the attributes by name go to `ids`.
Bytes packed(const scene::Mesh& mesh, const Packing& how, json::Value& ids) {
  draco::Mesh out;
  out.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  for (const uvec3& t : mesh.triangles)
    out.AddFace({draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  ids["POSITION"] = add(out, Attribute::POSITION, mesh.positions);
  if (!mesh.normals.empty()) ids["NORMAL"] = add(out, Attribute::NORMAL, mesh.normals);
  if (!mesh.uvs[0].empty()) ids["TEXCOORD_0"] = add(out, Attribute::TEX_COORD, mesh.uvs[0]);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(how.method);
  if (how.bits > 0) {
    for (const auto type : {Attribute::POSITION, Attribute::NORMAL, Attribute::TEX_COORD})
      encoder.SetAttributeQuantization(type, how.bits);
  }
  return encoded(out, encoder);
}

/// The file with all of its primitives packed; what Draco holds is in no other view.
Bytes pack(const Bytes& plain, const Packing& how) {
  const scene::Scene scene = load_gltf(plain, "f");
  GlbFile out(plain);
  std::size_t mesh = 0;
  for (std::size_t m = 0; m < out.json["meshes"].size(); ++m) {
    for (std::size_t p = 0; p < out.json["meshes"][m]["primitives"].size(); ++p) {
      json::Value& primitive = out.json["meshes"][m]["primitives"][p];
      json::Value ids = json::Value::object();
      const Bytes bytes = packed(scene.meshes[mesh++], how, ids);
      for (const auto& [name, id] : ids.members())
        out.json["accessors"][static_cast<std::size_t>(primitive["attributes"][name.c_str()].number())].erase(
            "bufferView");
      out.json["accessors"][static_cast<std::size_t>(primitive["indices"].number())].erase("bufferView");
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", out.json["bufferViews"].size()},
                                                               {"attributes", ids}};
      out.json["bufferViews"].push_back(
          {{"buffer", 0}, {"byteOffset", out.append(bytes)}, {"byteLength", bytes.size()}});
    }
  }
  out.json["extensionsRequired"].push_back("KHR_draco_mesh_compression");
  return out.write();
}

Bytes plain_scene(const char* name) {
  return export_glb(scene::make_builtin(name));
}

TEST(Draco, UnquantisedScenesAreThoseThatWerePacked) {
  for (const char* name : {"cornell", "two-rooms", "house"}) {
    const Bytes plain = plain_scene(name);
    const scene::Scene wanted = load(plain), found = load(pack(plain, {}));
    EXPECT_EQ(scene::scene_hash(found), scene::scene_hash(wanted)) << name;
    EXPECT_EQ(scene::light_hash(found), scene::light_hash(wanted)) << name;
    EXPECT_EQ(found.ignored, wanted.ignored);
  }
}

/// Half a step of the largest side of what is quantised, and some rounding.
float half_step(const std::vector<vec3>& values, int bits) {
  vec3 low = values.at(0), high = values.at(0);
  for (const vec3& v : values) low = glm::min(low, v), high = glm::max(high, v);
  return max_component(high - low) / static_cast<float>((1 << bits) - 1) * 0.51f + 1e-6f;
}

TEST(Draco, QuantisedVerticesAreHalfAStepAway) {
  const Bytes plain = plain_scene("house");
  const scene::Scene wanted = load(plain), found = load(pack(plain, {draco::MESH_SEQUENTIAL_ENCODING, 14}));
  ASSERT_EQ(found.meshes.size(), wanted.meshes.size());
  for (std::size_t m = 0; m < found.meshes.size(); ++m) {
    const auto &a = found.meshes[m], &b = wanted.meshes[m];
    EXPECT_EQ(a.triangles, b.triangles);
    ASSERT_EQ(a.positions.size(), b.positions.size());
    const float step = half_step(b.positions, 14);
    for (std::size_t v = 0; v < a.positions.size(); ++v) {
      EXPECT_LE(max_component(glm::abs(a.positions[v] - b.positions[v])), step);
      EXPECT_LE(glm::length(a.normals[v] - b.normals[v]), 3e-4f);  // an octahedron of 2^14 steps
    }
  }
}

/// Whether the corners of one triangle are those of another, which may begin elsewhere.
bool same_triangle(const std::array<vec3, 3>& a, const std::array<vec3, 3>& b, float tolerance) {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    float apart = 0;
    for (std::size_t c = 0; c < 3; ++c)
      apart = std::max(apart, max_component(glm::abs(a[c] - b[(c + turn) % 3])));
    if (apart <= tolerance) return true;
  }
  return false;
}

std::array<vec3, 3> corners(const scene::Mesh& mesh, const uvec3& t) {
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

// Edgebreaker stores triangles in an order of its own.
TEST(Draco, EdgebreakerKeepsEveryTriangle) {
  const Bytes plain = plain_scene("house");
  const scene::Scene wanted = load(plain), found = load(pack(plain, {draco::MESH_EDGEBREAKER_ENCODING, 14}));
  ASSERT_EQ(found.meshes.size(), wanted.meshes.size());
  for (std::size_t m = 0; m < found.meshes.size(); ++m) {
    const auto &a = found.meshes[m], &b = wanted.meshes[m];
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    const float step = half_step(b.positions, 14);
    for (const uvec3& t : a.triangles) {
      const auto triangle = corners(a, t);
      EXPECT_TRUE(std::ranges::any_of(
          b.triangles, [&](const uvec3& other) { return same_triangle(triangle, corners(b, other), step); }))
          << "mesh " << m;
    }
  }
}

// Draco has a flag of its own, which need not be right.
TEST(Draco, IntegersAreNormalizedAsTheirAccessorSays) {
  draco::Mesh mesh;
  mesh.set_num_points(3);
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  const int position = add(mesh, Attribute::POSITION, std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Attribute attribute;
  attribute.Init(Attribute::TEX_COORD, nullptr, 2, draco::DT_UINT16, false, 4, 0);
  const int uv = mesh.AddAttribute(attribute, true, 3);
  const std::array<std::array<std::uint16_t, 2>, 3> codes = {{{0, 65535}, {13107, 1}, {2, 3}}};
  for (std::uint32_t i = 0; i < 3; ++i)
    mesh.attribute(uv)->SetAttributeValue(draco::AttributeValueIndex(i), &codes[i]);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  const Bytes data = encoded(mesh, encoder);
  const auto uvs_of = [&](const char* normalized) {
    test::GlbBuilder b;
    const int view = b.view(data);
    b.accessor("\"componentType\":5126,\"type\":\"VEC3\",\"count\":3");
    b.accessor(std::string("\"componentType\":5123,\"type\":\"VEC2\",\"count\":3") + normalized);
    return load(b.glb(fmt::format(
                    "\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":[{{\"attributes\":{{"
                    "\"POSITION\":0,"
                    "\"TEXCOORD_0\":1}},\"extensions\":{{\"KHR_draco_mesh_compression\":{{\"bufferView\":{},"
                    "\"attributes\":{{\"POSITION\":{},\"TEXCOORD_0\":{}}}}}}}}}]}}]",
                    view, position, mesh.attribute(uv)->unique_id())))
        .meshes.at(0)
        .uvs[0];
  };
  EXPECT_EQ(uvs_of(""), (std::vector<vec2>{{0, 65535}, {13107, 1}, {2, 3}}));
  const std::vector<vec2> unit = uvs_of(",\"normalized\":true");
  EXPECT_EQ(unit.at(0), vec2(0, 1));
  EXPECT_FLOAT_EQ(unit.at(1).x, 0.2f);
}

TEST(Draco, TheKhronosBoxIsABox) {
  SSPHH_SHARED_SCENE(folder, "gltf-samples/Box");
  const scene::Scene plain = load_scene((folder / "glTF/Box.gltf").string());
  const scene::Scene scene = load_scene((folder / "glTF-Draco/Box.gltf").string());
  EXPECT_EQ(scene::triangle_count(scene), 12u);
  const auto wanted = scene::world_bounds(plain, scene::world_matrices(plain)),
             found = scene::world_bounds(scene, scene::world_matrices(scene));
  EXPECT_LE(glm::length(found.min - wanted.min) + glm::length(found.max - wanted.max), 1e-3f);
  EXPECT_TRUE(scene.ignored.empty());
}

/// The file with a change of its first primitive's extension.
Bytes changed_primitive(const Bytes& file,
                        const std::function<void(json::Value& extension, GlbFile& all)>& change) {
  GlbFile glb(file);
  change(glb.json["meshes"][std::size_t{0}]["primitives"][std::size_t{0}]["extensions"]
                 ["KHR_draco_mesh_compression"],
         glb);
  return glb.write();
}

std::size_t begin_of(const json::Value& extension, const GlbFile& all) {
  const auto view = static_cast<std::size_t>(extension["bufferView"].number());
  return static_cast<std::size_t>(all.json["bufferViews"][view]["byteOffset"].number());
}

const std::string place = "f: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";

TEST(Draco, WhatDoesNotFitTheFileIsNamed) {
  const Bytes good = pack(plain_scene("box"), {});
  ASSERT_EQ(said_of(good), "no error");
  EXPECT_EQ(
      said_of(changed_primitive(good, [](json::Value& e, GlbFile&) { e["attributes"]["POSITION"] = 9; })),
      place + ".attributes.POSITION: the packed mesh has no attribute 9");
  EXPECT_THAT(said_of(changed_primitive(good, [](json::Value& e, GlbFile&) { e["bufferView"] = 99; })),
              HasSubstr(place + ".bufferView: index 99 out of range"));
  EXPECT_THAT(
      said_of(changed_primitive(good, [](json::Value& e, GlbFile&) { e["attributes"]["COLOR_0"] = 0; })),
      HasSubstr("\"COLOR_0\" is missing"));
  const auto with_count = [&](const char* key, int count) {
    return said_of(changed_primitive(good, [&](json::Value&, GlbFile& all) {
      const json::Value& primitive = all.json["meshes"][std::size_t{0}]["primitives"][std::size_t{0}];
      const double accessor =
          std::string(key) == "indices" ? primitive[key].number() : primitive["attributes"][key].number();
      all.json["accessors"][static_cast<std::size_t>(accessor)]["count"] = count;
    }));
  };
  EXPECT_THAT(with_count("indices", 3), HasSubstr(place + ": the packed mesh has "));
  EXPECT_THAT(with_count("indices", 4), HasSubstr(".indices: packed triangles have three corners each"));
}

// Packed one after another, floats stand in the file as they are.
TEST(Draco, WhatIsNoNumberIsNamed) {
  const Bytes good = pack(plain_scene("box"), {});
  const vec3 first = load(good).meshes.at(0).positions.at(0);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    const std::string said = said_of(changed_primitive(good, [&](json::Value& e, GlbFile& all) {
      const auto wanted = std::as_bytes(std::span(&first, 1)), with = std::as_bytes(std::span(&bad, 1));
      const auto packed_mesh = all.binary.begin() + static_cast<std::ptrdiff_t>(begin_of(e, all));
      const auto at = std::search(packed_mesh, all.binary.end(), wanted.begin(), wanted.end());
      ASSERT_NE(at, all.binary.end());
      std::ranges::copy(with, at + sizeof(float));
    }));
    EXPECT_EQ(said, place + ".attributes.POSITION: element 0 is NaN or infinite") << bad;
  }
}

TEST(Draco, OtherBitstreamsAreNamed) {
  const Bytes good = pack(plain_scene("box"), {});
  const auto with_byte = [&](std::size_t at, int value) {
    return said_of(changed_primitive(good, [&](json::Value& e, GlbFile& all) {
      all.binary[begin_of(e, all) + at] = static_cast<std::byte>(value);
    }));
  };
  const std::string damaged = place + ": the packed mesh is damaged or cut short";
  EXPECT_EQ(with_byte(0, 'd'), damaged);
  EXPECT_EQ(with_byte(6, 3),
            place +
                ": holds Draco bitstream 2.3, glTF's is 2.2 (unpack it first, for example with: "
                "gltf-transform copy IN.glb OUT.glb, which writes plain accessors)");
  EXPECT_EQ(with_byte(7, 0), place + ": holds no Draco mesh");
  EXPECT_EQ(with_byte(8, 7), damaged);
}

TEST(Draco, DamagedDataIsAnErrorOrAScene) {
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Bytes good = pack(plain_scene("box"), {method, 11});
    Pcg32 random(1);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
      const Bytes damaged = changed_primitive(good, [&](json::Value& e, GlbFile& all) {
        const std::size_t begin = begin_of(e, all), length = all.binary.size() - begin;
        all.binary[begin + random.next() % length] ^= static_cast<std::byte>(1u << (random.next() % 8));
      });
      const std::string said = said_of(damaged);
      refused += said == "no error" ? 0 : 1;
      EXPECT_THAT(said, AnyOf("no error", StartsWith("f: "))) << i;
    }
    EXPECT_GT(refused, 100);
  }
}

TEST(Draco, TruncatedDataIsAnError) {
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Bytes good = pack(plain_scene("box"), {method, 11});
    const auto cut_to = [&](std::size_t length) {
      return said_of(changed_primitive(good, [&](json::Value& e, GlbFile& all) {
        all.json["bufferViews"][static_cast<std::size_t>(e["bufferView"].number())]["byteLength"] = length;
      }));
    };
    for (std::size_t length = 0; length < 60; ++length)
      EXPECT_THAT(cut_to(length), HasSubstr(place)) << length;
  }
}

/// A Draco file of `method` that announces so many faces and points, and ends.
Bytes announcing(std::uint8_t method, const std::vector<std::uint32_t>& counts) {
  std::string data = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, static_cast<char>(method), 0, 0};
  for (std::uint32_t count : counts) {
    for (; count > 127; count >>= 7) data.push_back(static_cast<char>(count | 128));
    data.push_back(static_cast<char>(count));
  }
  data.resize(data.size() + 100);
  const auto bytes = std::as_bytes(std::span(data));
  return {bytes.begin(), bytes.end()};
}

TEST(Draco, SizesAreCheckedBeforeMemoryIsTaken) {
  const auto said_with = [&](const Bytes& data, std::uint64_t accessors) {
    GlbFile glb(plain_scene("box"));
    json::Value& primitive = glb.json["meshes"][std::size_t{0}]["primitives"][std::size_t{0}];
    primitive["attributes"].erase("TEXCOORD_0");
    for (const char* key : {"POSITION", "NORMAL"})
      glb.json["accessors"][static_cast<std::size_t>(primitive["attributes"][key].number())] = {
          {"componentType", 5126}, {"type", "VEC3"}, {"count", accessors}};
    glb.json["accessors"][static_cast<std::size_t>(primitive["indices"].number())] = {
        {"componentType", 5125}, {"type", "SCALAR"}, {"count", accessors}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", glb.json["bufferViews"].size()},
                                                             {"attributes", {{"POSITION", 0}}}};
    glb.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.append(data)}, {"byteLength", data.size()}});
    return said_of(glb.write());
  };
  const std::uint32_t many = 900'000'000;
  const std::string too_much = "of decoded data, too much for its size";
  // Faces, points; way of traversal, points, faces, attributes with seams, symbols, splits
  EXPECT_THAT(said_with(announcing(0, {many, 3}), 3 * std::uint64_t{many}), HasSubstr(too_much));
  EXPECT_THAT(said_with(announcing(0, {many, 3}), 36),
              HasSubstr("has 900000000 triangles, its accessors have 12"));
  EXPECT_THAT(said_with(announcing(0, {1, many}), 36),
              HasSubstr("has 900000000 points, its accessors have 36"));
  EXPECT_THAT(said_with(announcing(1, {0, 3, many, 0, many, 0}), 3 * std::uint64_t{many}),
              HasSubstr(too_much));
  EXPECT_THAT(said_with(announcing(1, {0, 3, 12, 0, 12, many}), 36), HasSubstr("damaged or cut short"));
}

}  // namespace
}  // namespace ssphh::scene_io
