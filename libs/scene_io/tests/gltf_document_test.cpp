/// Containers, JSON, buffers and their views, made byte by byte: each limit at its edge, and what is said of
/// what lies beyond.

#include "gltf_document.h"

#include <fstream>

#include <gtest/gtest.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using ssphh::test::memory_dir;
using ssphh::test::message_of;
using ssphh::test::TempDir;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string u32(std::uint32_t value) {
  return {static_cast<char>(value), static_cast<char>(value >> 8), static_cast<char>(value >> 16),
          static_cast<char>(value >> 24)};
}

/// Chunks begin at multiples of four bytes.
std::string chunk(std::uint32_t type, std::string data) {
  data.resize((data.size() + 3) / 4 * 4, ' ');
  return u32(static_cast<std::uint32_t>(data.size())) + u32(type) + data;
}

constexpr std::uint32_t json_type = 0x4e4f534a, bin_type = 0x004e4942;
const std::string asset = R"("asset":{"version":"2.0"})";

std::string glb(const std::string& chunks, std::uint32_t version = 2, int more = 0) {
  const auto length = static_cast<std::uint32_t>(12 + chunks.size()) + static_cast<std::uint32_t>(more);
  return "glTF" + u32(version) + u32(length) + chunks;
}

std::string said_of_document(const std::string& file) {
  return message_of([&] { GltfDocument(bytes_of(file), "f"); });
}

std::string said_of_json(const std::string& members) {
  return said_of_document("{" + asset + "," + members + "}");
}

TEST(GltfContainer, ChunksLieWithinTheFile) {
  const std::string json = chunk(json_type, "{" + asset + "}"), bin = chunk(bin_type, "abcd");
  EXPECT_EQ(said_of_document(glb(json + bin)), "no error");
  EXPECT_EQ(said_of_document(glb(json) + "what follows"), "no error");
  EXPECT_EQ(said_of_document("glTF" + u32(2)), "f: the GLB header is cut short");
  EXPECT_EQ(said_of_document("glTF" + u32(2) + u32(12)), "f: the GLB file has no JSON chunk");
  EXPECT_EQ(said_of_document(glb(json, 1)), "f: is GLB version 1, only 2 can be read");
  const std::string size = std::to_string(12 + json.size());
  EXPECT_EQ(said_of_document(glb(json, 2, 1)), "f: is cut short: the GLB header says " +
                                                   std::to_string(13 + json.size()) +
                                                   " bytes, the file has " + size);
  EXPECT_EQ(said_of_document(glb(json + bin.substr(0, 7))), "f: the header of GLB chunk 1 is cut short");
  EXPECT_EQ(said_of_document(glb(json + bin.substr(0, 8))), "f: GLB chunk 1 says 4 bytes, 0 are left");
  EXPECT_EQ(said_of_document(glb(json + bin.substr(0, 11))), "f: GLB chunk 1 says 4 bytes, 3 are left");
  EXPECT_EQ(said_of_document(glb(bin)), "f: the first GLB chunk is not JSON");
}

TEST(GltfContainer, TheFirstBinaryChunkCountsAndOthersAreSkipped) {
  const std::string json = chunk(json_type, "{" + asset + R"(,"buffers":[{"byteLength":3}]})");
  const std::string file = glb(json + chunk(7, "four") + chunk(bin_type, "abcd") + chunk(bin_type, "efgh"));
  GltfDocument document(bytes_of(file), "f");
  EXPECT_TRUE(document.is_glb());
  const auto bytes = document.buffer(0);
  ASSERT_EQ(bytes.size(), 3u);
  EXPECT_EQ(static_cast<char>(bytes[2]), 'c');
  const std::string text = "{" + asset + "}";
  EXPECT_FALSE(GltfDocument(bytes_of(text), "f").is_glb());
}

TEST(GltfVersion, IsTwo) {
  const auto version = [](const std::string& members) {
    return said_of_document(R"({"asset":{)" + members + "}}");
  };
  EXPECT_EQ(version(R"("version":"2.0")"), "no error");
  EXPECT_EQ(version(R"("version":"2.1")"), "no error");
  EXPECT_EQ(version(R"("version":"2.1","minVersion":"2.0")"), "no error");
  EXPECT_EQ(version(R"("version":"1.0")"), "f: asset.version: glTF 1.0 cannot be read, only 2.0");
  EXPECT_EQ(version(R"("version":"2.1","minVersion":"2.1")"),
            "f: asset.minVersion: glTF 2.1 cannot be read, only 2.0");
  EXPECT_EQ(version(""), "f: asset: \"version\" is missing");
  EXPECT_EQ(said_of_document("{}"), "f: \"asset\" is missing");
  EXPECT_EQ(said_of_document("[]"), "f: must be a JSON object");
}

TEST(GltfExtensions, ThatAreRequiredAreKnownOrOnlyAddToTheLook) {
  const auto required = [](const std::string& name) {
    return said_of_json(R"("extensionsRequired":["KHR_lights_punctual",")" + name + "\"]");
  };
  for (const char* good :
       {"EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength",
        "KHR_materials_ior", "KHR_materials_specular", "KHR_materials_unlit", "KHR_mesh_quantization",
        "KHR_texture_transform", "KHR_materials_sheen"})
    EXPECT_EQ(required(good), "no error") << good;
  const auto refused = [](const std::string& name, const std::string& hint) {
    return "f: extensionsRequired[1]: the file requires the extension " + name + ", which is not supported" +
           hint;
  };
  for (const char* packed : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                             "KHR_meshopt_compression", "EXT_texture_webp"})
    EXPECT_EQ(required(packed), "no error") << packed;
  for (const char* texture : {"EXT_texture_avif", "MSFT_texture_dds"}) {
    EXPECT_EQ(required(texture),
              refused(texture,
                      " (convert its textures to PNG, JPEG or WebP first, for example with "
                      "gltf-transform)"));
  }
  EXPECT_EQ(required("KHR_texture_basisu"),
            refused("KHR_texture_basisu",
                    " (export it with PNG, JPEG or WebP textures, or convert each of them with: ktx extract "
                    "--transcode rgba8 IN.ktx2 OUT.png)"));
  EXPECT_EQ(required("X_other"), refused("X_other", ""));
}

TEST(GltfBuffers, AreChunkFileOrText) {
  const TempDir dir(memory_dir());
  std::ofstream(dir / "b.bin") << "0123456789";
  const auto said = [&](const std::string& buffer) {
    const std::string text = "{" + asset + R"(,"buffers":[)" + buffer + "]}";
    GltfDocument document(bytes_of(text), dir / "f");
    const std::string path = (dir / "f").string();
    std::string message = message_of([&] { document.buffer(0); });
    return message.starts_with(path) ? "f" + message.substr(path.size()) : message;
  };
  EXPECT_EQ(said(R"({"byteLength":10,"uri":"b.bin"})"), "no error");
  EXPECT_EQ(said(R"({"byteLength":11,"uri":"b.bin"})"),
            "f: buffers[0]: byteLength is 11, but only 10 bytes are there");
  EXPECT_EQ(said(R"({"byteLength":3,"uri":"data:;base64,YWJj"})"), "no error");
  EXPECT_EQ(said(R"({"byteLength":4,"uri":"data:;base64,YWJj"})"),
            "f: buffers[0]: byteLength is 4, but only 3 bytes are there");
  EXPECT_EQ(said(R"({"byteLength":1})"), "f: buffers[0]: has no uri, and the file has no GLB chunk for it");
  EXPECT_TRUE(said(R"({"byteLength":1,"uri":"none.bin"})")
                  .ends_with("(buffers lie beside the glTF file; copy them along with it)"));
  EXPECT_EQ(said(R"({"byteLength":1,"uri":"data:abc"})"),
            "f: buffers[0].uri: the data URI has no comma before its data");
  EXPECT_EQ(said(R"({"byteLength":1,"uri":"data:;base64,YWJjY"})"),
            "f: buffers[0].uri: the base64 data is cut short");
  EXPECT_EQ(said(R"({"byteLength":1,"uri":"data:;base64,Y*Jj"})"),
            "f: buffers[0].uri: the base64 data holds a character that is none of base64's");
  EXPECT_EQ(said(R"({"byteLength":1,"uri":"http://x/y"})"),
            "f: buffers[0].uri: \"http://x/y\" is neither a relative file name nor a data URI");
  EXPECT_EQ(said(R"({"byteLength":1,"uri":"/b.bin"})"),
            "f: buffers[0].uri: \"/b.bin\" is not a relative file name");
  const std::string file =
      glb(chunk(json_type, "{" + asset + R"(,"buffers":[{"byteLength":1},{"byteLength":1}]}  )") +
          chunk(bin_type, "abcd"));
  GltfDocument second(bytes_of(file), "f");
  EXPECT_EQ(message_of([&] { second.buffer(1); }),
            "f: buffers[1]: has no uri, and the file has no GLB chunk for it");
}

// A buffer of ten bytes.
TEST(GltfBufferViews, LieWithinTheirBuffer) {
  const auto view_of = [](const std::string& members, std::string& said) {
    const std::string text = "{" + asset +
                             R"(,"buffers":[{"byteLength":10,"uri":"data:,0123456789"}],"bufferViews":[{)" +
                             members + "}]}";
    GltfDocument document(bytes_of(text), "f");
    std::pair<std::string, std::uint64_t> view;
    said = message_of([&] {
      const auto [bytes, stride] = document.buffer_view(0);
      view = {std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), stride};
    });
    return view;
  };
  std::string said;
  const auto expect = [&](const std::string& members, const std::string& bytes, std::uint64_t stride) {
    EXPECT_EQ(view_of(members, said), std::pair(bytes, stride)) << said;
  };
  expect(R"("buffer":0,"byteLength":10)", "0123456789", 0);
  expect(R"("buffer":0,"byteOffset":3,"byteLength":7)", "3456789", 0);
  expect(R"("buffer":0,"byteOffset":10,"byteLength":0)", "", 0);
  expect(R"("buffer":0,"byteOffset":2,"byteLength":4,"byteStride":252)", "2345", 252);
  const auto refused = [&](const std::string& members) {
    view_of(members, said);
    return said;
  };
  EXPECT_EQ(refused(R"("buffer":0,"byteOffset":4,"byteLength":7)"),
            "f: bufferViews[0]: bytes 4 to 11 are out of range, the buffer has 10");
  EXPECT_EQ(refused(R"("buffer":0,"byteOffset":11,"byteLength":0)"),
            "f: bufferViews[0]: bytes 11 to 11 are out of range, the buffer has 10");
  EXPECT_EQ(refused(R"("buffer":1,"byteLength":1)"),
            "f: bufferViews[0].buffer: index 1 out of range, the file has 1 buffers");
  EXPECT_EQ(refused(R"("buffer":0,"byteLength":1,"byteStride":253)"),
            "f: bufferViews[0].byteStride: 253 must be an integer from 0 to 252");
  EXPECT_EQ(refused(R"("buffer":0)"), "f: bufferViews[0]: \"byteLength\" is missing");
}

// 64 MiB and 64 bytes for each that the file has.
TEST(GltfMemory, IsChargedInAll) {
  const std::string text = "{" + asset + "}";
  const std::uint64_t limit = (std::uint64_t{64} << 20) + 64 * text.size();
  GltfDocument document(bytes_of(text), "f");
  const auto charge = [&](std::uint64_t bytes) {
    return message_of([&] { document.charge(bytes, document.root()); });
  };
  EXPECT_EQ(charge(limit - 1), "no error");
  EXPECT_EQ(charge(1), "no error");
  EXPECT_EQ(charge(1), "f: the file asks for more than 64 MiB of decoded data, too much for its size");
  // What is refused at once counts as all there is, and no more.
  GltfDocument full(bytes_of(text), "f");
  EXPECT_NE(message_of([&] { full.charge(limit + 1, full.root()); }), "no error");
  EXPECT_NE(message_of([&] { full.charge(0, full.root()); }), "no error") << "it stays full";
  GltfDocument other(bytes_of(text), "f");
  EXPECT_NE(message_of([&] { other.charge(~std::uint64_t{0}, other.root()); }), "no error") << "no overflow";
}

}  // namespace
}  // namespace ssphh::scene_io
