#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/scene_io/gltf.h>

#include "gltf_parts.h"

namespace ssphh::scene_io {

std::optional<json::Cursor> extension(const json::Cursor& object, const char* name) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<json::Cursor> extra(const json::Cursor& object, const char* name) {
  const auto extras = object.find("extras");
  return extras && extras->is_object() ? extras->find(name) : std::nullopt;
}

std::string light_group_extra(const json::Cursor& object) {
  const auto group = extra(object, "light_group");
  return group ? group->text() : std::string{};
}

scene::Scene load_gltf(std::span<const std::byte> data, const std::filesystem::path& path, float time) {
  require(std::isfinite(time), "time", "must be finite");
  GltfDocument document(data, path);
  scene::Scene scene;
  GltfImport import{.document = document,
                    .scene = scene,
                    .texture_of_image = {},
                    .meshes_of_mesh = {},
                    .mesh_read = {},
                    .vertex_arrays = {},
                    .node_of_node = {},
                    .shapes = {},
                    .bent = {},
                    .weight_keys = {},
                    .profiles = {}};
  check_structure(document);
  import_materials(import);
  import_nodes(import);
  import_animations(import);
  import_light_groups(import);
  pose_meshes(import, time);
  if (scene.name.empty()) scene.name = path.stem().string();
  scene.ignored = document.ignored.lines();
  return scene;
}

}  // namespace ssphh::scene_io
