#include "document.h"

#include <algorithm>

#include <ssphh/scene_io/gltf_export.h>

namespace ssphh::viewer {

Document make_document(std::string source, scene::Scene scene, float time) {
  Document document;
  document.source = std::move(source);
  document.history = History<Edits>(edits_of(scene));
  document.duration = scene::animation_duration(scene);
  document.time = time;
  document.bounds = scene::world_bounds(scene, scene::world_matrices(scene, time));
  document.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return document;
}

View start_view(const Document& document, const std::string& camera) {
  const scene::CameraPose pose = scene::camera_pose(*document.scene, camera, document.time);
  const vec3 eye(pose.world[3]);
  const float distance = document.bounds.empty() ? 3 : glm::distance(eye, document.bounds.center());
  return view_of(pose, std::max(distance, 0.1f));
}

scene::Scene scene_to_save(const Document& document) {
  scene::Scene scene = edited_scene(*document.scene, document.edits(), document.time);
  const auto by_node = [](const auto& a, const auto& b) { return a.node < b.node; };
  std::ranges::stable_sort(scene.lights, by_node);
  std::ranges::stable_sort(scene.sphls, by_node);
  scene::validate(scene);
  return scene;
}

void save_document(const Document& document, const std::filesystem::path& file) {
  if (file.extension() != ".glb")
    throw Error(file.string(), "scenes are saved as GLB", "let the name end with .glb");
  scene_io::write_glb(file, scene_to_save(document));
}

}  // namespace ssphh::viewer
