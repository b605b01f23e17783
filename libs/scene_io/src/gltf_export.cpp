#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf_export.h>

#include "gltf_export_parts.h"

namespace ssphh::scene_io {
namespace {

void append_u32(std::vector<std::byte>& file, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::byte>(value >> shift & 0xff));
}

/// Header and the two chunks, padded to four bytes (glTF 2.0, chapter 4).
std::vector<std::byte> pack(std::string text, const std::vector<std::byte>& binary) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::uint64_t size = 12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (size > 0xffffffff) throw Error("glTF export", "the scene is larger than a GLB file can be (4 GiB)");
  std::vector<std::byte> file;
  file.reserve(size);
  append_u32(file, 0x46546c67);  // "glTF"
  append_u32(file, 2);
  append_u32(file, static_cast<std::uint32_t>(size));
  append_u32(file, static_cast<std::uint32_t>(text.size()));
  append_u32(file, 0x4e4f534a);  // "JSON"
  const auto text_bytes = std::as_bytes(std::span(text));
  file.insert(file.end(), text_bytes.begin(), text_bytes.end());
  if (!binary.empty()) {
    append_u32(file, static_cast<std::uint32_t>(binary.size()));
    append_u32(file, 0x004e4942);  // "BIN"
    file.insert(file.end(), binary.begin(), binary.end());
  }
  return file;
}

}  // namespace

std::vector<std::byte> export_glb(const scene::Scene& scene, const json::Value& extras) {
  scene::check_indices(scene);
  GltfExport out(scene);
  export_materials(out);
  const json::Value roots = export_nodes(out);
  export_animations(out);
  json::Value shown;
  if (!scene.name.empty()) shown["name"] = scene.name;
  if (!roots.empty()) shown["nodes"] = roots;
  if (json::Value environment = export_environment(out); !environment.is_null())
    shown["extras"]["ssphh"]["environment"] = std::move(environment);
  if (json::Value modes = export_light_modes(out); !modes.is_null())
    shown["extras"]["ssphh"]["light_modes"] = std::move(modes);
  for (const std::string& group : scene.dark_groups) shown["extras"]["ssphh"]["dark_groups"].push_back(group);
  if (extras.is_object())
    for (const auto& [name, value] : extras.members()) shown["extras"]["ssphh"][name] = value;
  if (shown.is_null()) shown = json::Value::object();

  json::Value document;
  document["asset"] = {{"generator", "ssphh"}, {"version", "2.0"}};
  if (!out.lights.empty()) {
    document["extensions"]["KHR_lights_punctual"]["lights"] = std::move(out.lights);
  }
  if (!out.profiles.empty()) {
    document["extensions"]["EXT_lights_ies"]["lights"] = std::move(out.profiles);
  }
  if (!out.extensions.empty())
    document["extensionsUsed"] = json::Array(out.extensions.begin(), out.extensions.end());
  document["scene"] = 0;
  document["scenes"] = json::Value::array({std::move(shown)});
  // Empty arrays are not allowed.
  const auto add = [&](const char* key, json::Value& array) {
    if (!array.empty()) document[key] = std::move(array);
  };
  add("nodes", out.nodes);
  add("cameras", out.cameras);
  add("meshes", out.meshes);
  add("materials", out.materials);
  add("textures", out.textures);
  add("images", out.images);
  add("samplers", out.samplers);
  add("animations", out.animations);
  add("accessors", out.accessors);
  add("bufferViews", out.buffer_views);
  if (!out.binary.empty()) document["buffers"] = json::Value::array({{{"byteLength", out.binary.size()}}});
  // Names that are not UTF-8 must not stop the export.
  return pack(json::print(document), out.binary);
}

void write_glb(const std::filesystem::path& path, const scene::Scene& scene) {
  write_file(path, export_glb(scene));
}

}  // namespace ssphh::scene_io
