// A glTF file with all that is read, as the scene it becomes; and every member of it changed, one at a time:
// which line of the scene is another then, or what is said. In expected/gltf.txt and
// expected/gltf-changes.txt.

#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>

#include "error_message.h"
#include "expected_text.h"
#include "export_fixture.h"
#include "glb_builder.h"
#include "scene_text.h"
#include "text_changes.h"

namespace ssphh::scene_io {
namespace {

using test::GlbBuilder;

struct File {
  json::Value document;
  std::vector<std::byte> binary;
};

/// The two chunks of a GLB file (glTF 2.0, chapter 4).
File unpack(const std::vector<std::byte>& glb) {
  const auto u32 = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, glb.data() + at, 4);
    return value;
  };
  const std::size_t size = u32(12), begin = 20 + size;
  const char* text = reinterpret_cast<const char*>(glb.data()) + 20;
  File file{test::sorted(test::parse_json({text, size})), {}};
  if (begin + 8 <= glb.size())
    file.binary.assign(glb.begin() + static_cast<std::ptrdiff_t>(begin) + 8, glb.end());
  return file;
}

std::vector<std::byte> pack(const File& file) {
  return GlbBuilder::container(print(file.document), file.binary);
}

constexpr const char* members = R"(
"scene": 0,
"scenes": [{"name": "all", "nodes": [0, 5, 7], "extras": {"ssphh": {"environment": {
    "name": "sky", "light_group": "dome", "color": [0.5, 0.25, 1], "rotation": 0.75,
    "image": {"bufferView": 0, "width": 2, "height": 1}}}}}, {"nodes": [8]}],
"nodes": [
  {"name": "root", "translation": [1, 2, 3], "rotation": [0, 1.2, 0, 1.6], "scale": [2, 0.5, 1], "children": [1, 2, 3, 4]},
  {"name": "shape", "mesh": 0, "matrix": [0,2,0,0, 0,0,3,0, 5,0,0,0, 1,2,3,1], "extras": {"light_group": "panel"}},
  {"name": "eye", "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
  {"name": "SPHL-1", "extras": {"sphl": {"name": "probe", "radius": 0.25, "enabled": false}}, "camera": 1},
  {"name": "crowd", "mesh": 1, "extras": {"light_group": "many"}, "extensions": {"EXT_mesh_gpu_instancing":
    {"attributes": {"TRANSLATION": 7, "ROTATION": 8, "SCALE": 9, "_ID": 10}}}},
  {"extensions": {"KHR_lights_punctual": {"light": 1}}, "mesh": 2, "children": [6]},
  {"name": "SPHL", "extensions": {"KHR_lights_punctual": {"light": 2}}, "extras": {"sphl": true, "light_group": "day"}, "skin": 0},
  {"name": "ball", "extensions": {"KHR_lights_punctual": {"light": 3}}},
  {"name": "unseen", "mesh": 3}],
"cameras": [
  {"name": "near", "type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.5, "znear": 0.1}},
  {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": -2, "zfar": 9, "znear": 0.1}}],
"extensionsUsed": ["KHR_lights_punctual", "KHR_materials_sheen"],
"extensionsRequired": ["KHR_texture_transform", "KHR_materials_sheen"],
"extensions": {"KHR_lights_punctual": {"lights": [
  {"type": "point", "name": "bulb", "color": [1, 0.5, 0.25], "intensity": 7, "range": 9, "extras": {"light_group": "lamps"}},
  {"type": "spot", "intensity": 3, "spot": {"innerConeAngle": 0.125, "outerConeAngle": 0.375}},
  {"type": "directional", "name": "sun", "range": 4, "extras": {"ssphh": {"angular_radius": 0.01}}},
  {"type": "point", "name": "globe", "intensity": 5, "extras": {"ssphh": {"type": "sphere", "radius": 0.25, "radiance": 6}}}]}},
"meshes": [
  {"name": "roof", "primitives": [
    {"attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3, "TEXCOORD_1": 4, "COLOR_0": 5, "_EXTRA": 3},
     "indices": 6, "material": 0, "targets": [{"POSITION": 1}]},
    {"attributes": {"POSITION": 0}, "mode": 5, "material": 1}, {"attributes": {"POSITION": 0}, "mode": 0},
    {"attributes": {"POSITION": 0}, "mode": 1}, {"attributes": {"POSITION": 0}, "mode": 2},
    {"attributes": {"POSITION": 0}, "mode": 3}]},
  {"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 11}, "mode": 6}]},
  {"name": "few", "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 12, "material": 2}]},
  {"name": "hidden", "primitives": [{"attributes": {"NORMAL": 1}}]}],
"materials": [
  {"name": "rich", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.75], "metallicFactor": 0.625,
     "roughnessFactor": 0.375, "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
     {"offset": [0.125, 0.25], "scale": [2, 3], "rotation": 0.5, "texCoord": 0}}}, "metallicRoughnessTexture": {"index": 1}},
   "emissiveFactor": [1, 0.5, 0.25], "emissiveTexture": {"index": 1, "texCoord": 1}, "normalTexture": {"index": 2, "scale": 0.5},
   "occlusionTexture": {"index": 0}, "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
   "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_ior": {"ior": 1.25},
     "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 1, 0]}, "KHR_materials_sheen": {}},
   "extras": {"ssphh": {"diffuse_roughness": -0.5, "specular_roughness": -0.25}}},
  {"name": "sign", "extensions": {"KHR_materials_unlit": {}, "KHR_materials_ior": {"ior": 0}}, "alphaMode": "BLEND"}, {}],
"textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 1}, {"source": 0}],
"images": [{"name": "inside", "bufferView": 1, "mimeType": "image/png"}, {"uri": "data:image/png;base64,PNG"}],
"samplers": [{"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}, {"magFilter": 9729, "wrapS": 10497}],
"skins": [{"joints": [0, 1], "inverseBindMatrices": 13, "skeleton": 0}],
"animations": [{"name": "move", "channels": [
    {"sampler": 0, "target": {"node": 0, "path": "translation"}}, {"sampler": 1, "target": {"node": 0, "path": "rotation"}},
    {"sampler": 0, "target": {"node": 3, "path": "scale"}}, {"sampler": 0, "target": {"node": 1, "path": "scale"}},
    {"sampler": 0, "target": {"node": 8, "path": "scale"}}, {"sampler": 0, "target": {"path": "scale"}},
    {"sampler": 0, "target": {"node": 0, "path": "weights"}}],
  "samplers": [{"input": 14, "output": 15, "interpolation": "STEP"}, {"input": 14, "output": 16, "interpolation": "CUBICSPLINE"}]},
  {"channels": [{"sampler": 0, "target": {"node": 6, "path": "translation"}}], "samplers": [{"input": 14, "output": 15}]}]
)";

std::string base64(const std::vector<std::byte>& bytes) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? alphabet[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

File everything() {
  GlbBuilder b;
  b.view<float>({1, 2, 3, 4, 5, 6});                                        // the sky
  b.view(image::encode_png(image::Rgba8{2, 1, {1, 2, 3, 4, 5, 6, 7, 8}}));  // an image
  b.add<float>({0, 0, 0, 2, 0, 0.5f, 0.25f, 3, 1, 1, 1, 4, 7, 8, 9}, 5126, "VEC3", 5);
  b.add<std::int8_t>({127, 0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0, 0, -127, 0, 0, 89, 89, 0}, 5120, "VEC3", 5,
                     ",\"normalized\":true,\"byteOffset\":0");
  b.add<float>({1, 0, 0, 1, 0, 1, 0, -1, 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1, -1}, 5126, "VEC4", 5);
  b.add<std::uint16_t>({0, 65535, 13107, 0, 32768, 100, 65535, 65535, 1, 2}, 5123, "VEC2", 5,
                       ",\"normalized\":true");
  b.add<float>({0.5f, 0.25f, 0.75f, 0, 1, 1, 2, -1, 4, 4}, 5126, "VEC2", 5);
  b.add<std::uint8_t>({255, 0, 51, 255, 102, 255, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 8, 7, 6}, 5121, "VEC4", 5,
                      ",\"normalized\":true");
  const int indices = b.view<std::uint16_t>({0, 0, 0, 1, 2, 2, 1, 3, 0, 4});  // the first two are left out
  b.accessor(fmt::format(
      "\"bufferView\":{},\"byteOffset\":4,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6", indices));
  b.add<float>({1, 2, 3, 4, 5, 6}, 5126, "VEC3", 2);  // 7: instances
  b.add<std::int16_t>({0, 32767, 0, 0, 0, 0, 0, 32767}, 5122, "VEC4", 2, ",\"normalized\":true");
  b.add<float>({1, 1, 1, 2, 3, 4}, 5126, "VEC3", 2);
  b.add<float>({1, 2}, 5126, "SCALAR", 2);
  b.add<std::uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 65535, 9, 99, 999, 1, 10, 100}, 5123, "VEC3", 5,
                       ",\"normalized\":true");  // 11: colours without alpha
  b.add<std::uint32_t>({2, 1, 0}, 5125, "SCALAR", 3);
  b.add<float>(std::vector<float>(48, 1), 5126, "MAT4", 2, ",\"byteOffset\":64");
  b.add<float>({0, 0.5f}, 5126, "SCALAR", 2);  // 14: times
  const int changed = b.view<std::uint8_t>({1, 0, 0, 0}), values = b.view<float>({9, 8, 7});
  b.accessor(
      fmt::format("\"componentType\":5126,\"type\":\"VEC3\",\"count\":2,\"sparse\":{{\"count\":1,\"indices\":"
                  "{{\"bufferView\":{},\"componentType\":5121}},\"values\":{{\"bufferView\":{}}}}}",
                  changed, values));
  b.add<float>({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 5126, "VEC4", 6);
  std::string text = members;
  text.replace(text.find("PNG"), 3,
               base64(image::encode_png(image::Rgba8{1, 2, {9, 8, 7, 255, 6, 5, 4, 255}})));
  return unpack(b.glb(text));
}

/// Of a file what it reads as, or what is said.
std::string read_text(const std::vector<std::byte>& glb) {
  std::string text;
  const std::string said = test::message_of([&] { text = test::scene_text(load_gltf(glb, "all.glb")); });
  return said == "no error" ? text : said + "\n";
}

TEST(GltfText, AllThatIsReadStandsInTheScene) {
  test::expect_text_of("libs/scene_io/tests/expected/gltf.txt", read_text(pack(everything())));
}

TEST(GltfText, EveryMemberCounts) {
  set_log_sink([](LogLevel, const std::string&) {});
  File file = everything();
  const std::vector<std::string> before = test::lines_of(read_text(pack(file)));
  std::string text;
  test::change_members(file.document, [&](const std::string& change) {
    text += change + "\n" + test::news(read_text(pack(file)), before);
  });
  set_log_sink({});
  test::expect_text_of("libs/scene_io/tests/expected/gltf-changes.txt", text);
}

TEST(GltfText, EveryByteOfTheContainerCounts) {
  File file;
  file.document = test::parse_json(R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4}]})");
  file.binary.resize(4);
  const std::vector<std::byte> whole = pack(file);
  const std::vector<std::string> before = test::lines_of(read_text(whole));
  const std::size_t binary_header = whole.size() - 12;
  std::string text;
  for (std::size_t i = 0; i < whole.size() - 4; i += i == 19 ? binary_header - 19 : 1) {
    for (const int step : {-1, 1}) {
      std::vector<std::byte> changed = whole;
      changed[i] = static_cast<std::byte>(static_cast<int>(changed[i]) + step);
      const std::string other = read_text(changed);
      text += fmt::format("byte {} by {}\n", i < 20 ? i : i - binary_header + 100, step) +
              test::news(other, before);
    }
  }
  for (const std::size_t length : {0, 4, 11, 12, 19, 20, 27})
    text +=
        fmt::format("{} bytes\n", length) +
        test::news(read_text({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), before);
  test::expect_text_of("libs/scene_io/tests/expected/glb-bytes.txt", text);
}

/// What is written, member by member, and the arrays by their means.
TEST(GltfText, TheExportWritesWhatTheListSays) {
  scene::Scene scene = test::scene_of_everything();
  scene.cameras.resize(2);
  for (scene::Camera& camera : scene.cameras) camera.name = "c", camera.node = 1;
  scene.cameras[1].orthographic = true, scene.cameras[1].yheight = 3, scene.cameras[0].aspect = 1.5f;
  scene.sphls = {{"west", 0, 0.07f, true}, {"east", 1, 0.3f, false}};
  scene.nodes[3].matrix = mat4(2), (*scene.nodes[3].matrix)[3].w = 1;
  scene.nodes[4].matrix = mat4(1), scene.nodes[4].name = "SPHL of nobody";
  scene.nodes[5].parent = 2, scene.nodes[5].local = {};
  scene.meshes[1].uvs[0].clear(),
      scene.meshes[2].tangents.assign(scene.meshes[2].positions.size(), vec4(1, 0, 0, -1));
  scene.instances[2].light_group = "g", scene.instances.push_back({1, 2, 5, "g"}),
  scene.instances.push_back({3, 2, -1, "h"});
  scene.animations.resize(3);
  scene.animations[1].name = "turn";
  scene.animations[1].channels = {
      {0, scene::AnimationPath::rotation, scene::Interpolation::step, {0, 2}, {{0, 0, 0, 1}, {0, 1, 0, 0}}},
      {1, scene::AnimationPath::scale, scene::Interpolation::linear, {1}, {vec4(3)}}};
  scene.animations[2].channels = {{2,
                                   scene::AnimationPath::translation,
                                   scene::Interpolation::cubic_spline,
                                   {1},
                                   {vec4(1), vec4(2), vec4(3)}}};
  scene.environment->group = "dome";
  const File file = unpack(export_glb(scene));
  std::string text = print(file.document, 1) + "\n";
  for (const json::Value& view : file.document["bufferViews"].elements()) {
    const auto begin = test::count_of(view["byteOffset"]), length = test::count_of(view["byteLength"]);
    std::vector<float> values(length / 4);
    std::memcpy(values.data(), file.binary.data() + begin, values.size() * 4);
    const bool floats = std::all_of(values.begin(), values.end(), [](float v) {
      return v == 0 || (std::abs(v) > 1e-9f && std::abs(v) < 1e9f);
    });
    const std::vector<std::uint8_t> bytes(
        reinterpret_cast<const std::uint8_t*>(file.binary.data()) + begin,
        reinterpret_cast<const std::uint8_t*>(file.binary.data()) + begin + length);
    text += floats ? "floats " + test::field_text(values) + "\n" : "bytes " + test::field_text(bytes) + "\n";
  }
  test::expect_text_of("libs/scene_io/tests/expected/gltf-export.txt", text);
}

}  // namespace
}  // namespace ssphh::scene_io
