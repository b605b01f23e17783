/// Buffer views packed by meshoptimizer: scenes packed here are the scenes that they were.

#include <algorithm>
#include <functional>

#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>

#include "error_message.h"
#include "glb_file.h"
#include "gltf_bytes.h"

namespace ssphh::scene_io {
namespace {

using test::GlbBuilder;
using test::GlbFile;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes packed(const std::string& mode, const void* data, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> out;
  if (mode == "ATTRIBUTES") {
    out.resize(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
  } else {
    std::vector<unsigned> indices(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (stride == 2) {
        indices[i] = static_cast<const std::uint16_t*>(data)[i];
      } else {
        indices[i] = static_cast<const std::uint32_t*>(data)[i];
      }
    }
    const bool triangles = mode == "TRIANGLES";
    out.resize(triangles ? meshopt_encodeIndexBufferBound(count, 65536)
                         : meshopt_encodeIndexSequenceBound(count, 65536));
    out.resize(triangles ? meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), count)
                         : meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), count));
  }
  EXPECT_FALSE(out.empty());
  const auto* begin = reinterpret_cast<const std::byte*>(out.data());
  return {begin, begin + out.size()};
}

/// The file with the views of all accessors packed, indices in `index_mode`; the plain bytes are in no
/// buffer.
Bytes pack(const Bytes& plain, const std::string& index_mode, const char* name = "EXT_meshopt_compression") {
  const GlbFile in(plain);
  GlbFile out(plain);
  out.json["buffers"].push_back({{"byteLength", in.binary.size()}});
  out.json["buffers"][std::size_t{1}]["extensions"][name]["fallback"] = true;
  for (const json::Value& accessor : in.json["accessors"].elements()) {
    const auto v = static_cast<std::size_t>(accessor["bufferView"].number());
    const std::string type = accessor["type"].string();
    const bool indices = accessor["componentType"].number() != 5126;
    const auto count = static_cast<std::size_t>(accessor["count"].number());
    const Bytes bytes = in.view(v);
    const std::size_t stride = bytes.size() / count;
    const std::string mode = indices ? index_mode : "ATTRIBUTES";
    const Bytes data = packed(mode, bytes.data(), count, stride);
    json::Value& view = out.json["bufferViews"][v];
    view["buffer"] = 1;
    view["extensions"][name] = {{"buffer", 0},          {"byteOffset", out.append(data)},
                                {"count", count},       {"byteLength", data.size()},
                                {"byteStride", stride}, {"mode", mode}};
  }
  out.json["extensionsUsed"].push_back(name);
  out.json["extensionsRequired"].push_back(name);
  return out.write();
}

TEST(Meshopt, PackedScenesAreThoseThatWerePacked) {
  for (const char* name : {"cornell", "two-rooms", "house"}) {
    const Bytes plain = export_glb(scene::make_builtin(name));
    const scene::Scene wanted = load(plain);
    for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      const scene::Scene found = load(pack(plain, "INDICES", extension));
      EXPECT_EQ(scene::scene_hash(found), scene::scene_hash(wanted)) << name;
      EXPECT_EQ(scene::light_hash(found), scene::light_hash(wanted)) << name;
      EXPECT_EQ(found.ignored, wanted.ignored);
    }
  }
}

// The codec of triangle lists may begin a triangle at another of its corners.
TEST(Meshopt, PackedTrianglesKeepOrderAndOrientation) {
  const Bytes plain = export_glb(scene::make_builtin("house"));
  const scene::Scene wanted = load(plain), found = load(pack(plain, "TRIANGLES"));
  ASSERT_EQ(found.meshes.size(), wanted.meshes.size());
  for (std::size_t m = 0; m < found.meshes.size(); ++m) {
    const auto &a = found.meshes[m], &b = wanted.meshes[m];
    EXPECT_EQ(a.positions, b.positions);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
      const uvec3 x = a.triangles[t], y = b.triangles[t];
      ASSERT_TRUE(x == y || x == uvec3(y.y, y.z, y.x) || x == uvec3(y.z, y.x, y.y)) << m << " " << t;
    }
  }
}

/// A triangle of three vertices, one of whose views is packed from `data` with `filter`.
struct Filtered {
  GlbBuilder builder;
  int positions = 0;

  Bytes glb(const std::string& attribute, int accessor) const {
    return builder.glb(
        fmt::format("\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":[{{\"attributes\":"
                    "{{\"POSITION\":{}{}}}}}]}}]",
                    positions, attribute.empty() ? "" : fmt::format(",\"{}\":{}", attribute, accessor)));
  }

  /// The index of a view of 3 elements.
  int view(const std::vector<std::uint8_t>& data, std::size_t stride, const char* filter) {
    const Bytes bytes = packed("ATTRIBUTES", data.data(), 3, stride);
    std::vector<std::uint8_t> plain(bytes.size());
    std::memcpy(plain.data(), bytes.data(), bytes.size());
    const std::size_t begin = builder.size();
    builder.view(plain);
    return builder.packed_view(
        3 * stride, stride,
        fmt::format("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"byteStride\":{},"
                    "\"count\":3,\"mode\":\"ATTRIBUTES\",\"filter\":\"{}\"}}",
                    begin, bytes.size(), stride, filter));
  }
};

TEST(Meshopt, FiltersAreUndone) {
  const std::vector<vec4> normals = {{0, 0, 1, 0}, {1, 0, 0, 0}, {-0.6f, 0, -0.8f, 0}};
  Filtered file;
  std::vector<std::uint8_t> exponents(36), octahedral(24);
  const std::vector<float> positions = {0, 0, 0, 1, 0.3f, 0, 0, 1000, 7};
  meshopt_encodeFilterExp(exponents.data(), 3, 12, 15, positions.data());
  meshopt_encodeFilterOct(octahedral.data(), 3, 8, 16, &normals[0].x);
  file.positions = file.builder.accessor(
      fmt::format("\"bufferView\":{},\"componentType\":5126,\"type\":\"VEC3\",\"count\":3",
                  file.view(exponents, 12, "EXPONENTIAL")));
  const int normal = file.builder.accessor(fmt::format(
      "\"bufferView\":{},\"componentType\":5122,\"normalized\":true,\"type\":\"VEC3\",\"count\":3",
      file.view(octahedral, 8, "OCTAHEDRAL")));
  const scene::Scene scene = load(file.glb("NORMAL", normal));
  ASSERT_EQ(scene.meshes.size(), 1u);
  for (std::size_t i = 0; i < 3; ++i) {
    const vec3 wanted(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    // 15 bits of mantissa
    EXPECT_LE(glm::length(scene.meshes[0].positions[i] - wanted), glm::length(wanted) / (1 << 14));
    EXPECT_LE(glm::length(scene.meshes[0].normals[i] - vec3(normals[i])), 3.0f / 32767);
  }
}

Bytes changed_packing(const Bytes& file,
                      const std::function<void(json::Value& extension, GlbFile& all)>& change) {
  GlbFile glb(file);
  change(glb.json["bufferViews"][std::size_t{0}]["extensions"]["EXT_meshopt_compression"], glb);
  return glb.write();
}

TEST(Meshopt, WhatTheExtensionForbidsIsNamed) {
  const Bytes good = pack(export_glb(scene::make_builtin("box")), "TRIANGLES");
  ASSERT_EQ(said_of(good), "no error");
  const std::string place = "f: bufferViews[0].extensions.EXT_meshopt_compression";
  const auto said_with = [&](const char* key, const json::Value& value) {
    return said_of(changed_packing(good, [&](json::Value& extension, GlbFile&) { extension[key] = value; }));
  };
  EXPECT_EQ(said_with("byteStride", 10), place + ".byteStride: 10 cannot be, in mode ATTRIBUTES");
  EXPECT_EQ(said_with("mode", "TRIANGLES"), place + ".byteStride: 12 cannot be, in mode TRIANGLES");
  EXPECT_THAT(said_with("mode", "LINES"), HasSubstr(place + ".mode: "));
  EXPECT_THAT(said_with("filter", "COLOR"), HasSubstr(place + ".filter: "));
  EXPECT_EQ(said_with("filter", "QUATERNION"), place + ".filter: does not suit the mode and the byteStride");
  EXPECT_THAT(said_with("count", 7),
              HasSubstr(place + ": 7 elements of 12 bytes are unpacked, the view has "));
  EXPECT_THAT(said_with("byteOffset", 1 << 20), HasSubstr(place + ": bytes 1048576 to "));
  EXPECT_THAT(said_with("buffer", 2), HasSubstr(place + ".buffer: index 2 out of range"));
  EXPECT_EQ(said_with("byteLength", 20), place + ": the packed data is damaged or cut short");
}

TEST(Meshopt, VersionsToComeAreNamed) {
  const Bytes good = pack(export_glb(scene::make_builtin("box")), "TRIANGLES");
  const Bytes newer = changed_packing(good, [&](json::Value& extension, GlbFile& all) {
    all.binary[static_cast<std::size_t>(extension["byteOffset"].number())] = std::byte{0xa1};
  });
  EXPECT_EQ(
      said_of(newer),
      "f: bufferViews[0].extensions.EXT_meshopt_compression: is packed in a way that meshoptimizer 0.18 "
      "does not read (unpack it first, for example with: gltf-transform copy IN.glb OUT.glb, which writes "
      "plain accessors)");
}

TEST(Meshopt, DamagedDataIsAnErrorOrAScene) {
  const Bytes good = pack(export_glb(scene::make_builtin("box")), "TRIANGLES");
  Pcg32 random(1);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const Bytes damaged = changed_packing(good, [&](json::Value&, GlbFile& all) {
      all.binary[random.next() % all.binary.size()] ^= static_cast<std::byte>(1u << (random.next() % 8));
    });
    const std::string said = said_of(damaged);
    refused += said == "no error" ? 0 : 1;
    EXPECT_TRUE(said == "no error" || said.starts_with("f: ")) << said;
  }
  EXPECT_GT(refused, 10);
}

// A thousand elements in few bytes are fine, four thousand million are not.
TEST(Meshopt, SizesAreCheckedBeforeMemoryIsTaken) {
  const Bytes good = pack(export_glb(scene::make_builtin("box")), "TRIANGLES");
  const Bytes greedy = changed_packing(good, [&](json::Value& extension, GlbFile& all) {
    const std::uint64_t count = 4'000'000'000;
    extension["count"] = count;
    json::Value& view = all.json["bufferViews"][std::size_t{0}];
    view["byteLength"] = count * 12;
    all.json["buffers"][std::size_t{1}]["byteLength"] = count * 12;
  });
  EXPECT_THAT(said_of(greedy), HasSubstr("of decoded data, too much for its size"));
}

}  // namespace
}  // namespace ssphh::scene_io
