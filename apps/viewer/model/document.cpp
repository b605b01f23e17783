#include "document.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/file.h>
#include <ssphh/scene/placed_camera.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>

#include "lengths.h"
#include "overlay_file.h"

namespace ssphh::viewer {

Document make_document(std::string source, scene::Scene scene, float time) {
  Document document;
  document.source = std::move(source);
  document.history = History<Edits>(edits_of(scene));
  document.duration = scene::animation_duration(scene);
  document.time = time;
  document.bounds = scene::world_bounds(scene, scene::world_matrices(scene, time));
  document.opened = document.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return document;
}

std::vector<scene::ProbePlace> Document::places() const {
  const std::vector<mat4> world = scene::world_matrices(*scene, time);
  std::vector<scene::ProbePlace> places;
  for (const SphlEdit& sphl : edits().sphls) {
    if (sphl.enabled) places.push_back({sphl.name, sphl_position(*scene, world, sphl), sphl.radius});
  }
  return places;
}

bool Document::follow_lamps() {
  if (lamps_are_of(*scene)) return true;
  // Once all lamps are as they were, so is the scene.
  scene = lamps_are_of(*opened) ? opened : std::make_shared<const scene::Scene>(with_lamps(*opened, edits()));
  return true;
}

View start_view(const Document& document, const std::string& camera) {
  const std::vector<CameraEdit>& cameras = document.edits().cameras;
  const auto named =
      std::ranges::find_if(cameras, [&](const CameraEdit& c) { return camera.empty() || c.name == camera; });
  if (named == cameras.end() && !camera.empty()) {
    if (const auto placed = scene::placed_camera(camera)) return view_of(placed->pose, placed->distance);
    std::vector<std::string> names;
    for (const CameraEdit& c : cameras) names.push_back(c.name);
    throw Error(document.source, fmt::format("has no camera \"{}\"", camera),
                names.empty() ? "it has none" : fmt::format("its cameras: {}", fmt::join(names, ", ")));
  }
  if (named != cameras.end() && named->view) return *named->view;
  const bool of_scene = named != cameras.end();
  const scene::CameraPose pose = scene::camera_pose(
      *document.opened, of_scene ? document.opened->cameras[named->source].name : "", document.time);
  const vec3 eye(pose.world[3]);
  const float distance = document.bounds.empty() ? 3 : glm::distance(eye, document.bounds.center());
  return view_of(pose, std::max(distance, lengths_of(document.bounds).least));
}

scene::Scene scene_to_save(const Document& document) {
  scene::Scene scene = edited_scene(*document.opened, document.edits(), document.time, DarkLight::kept);
  const auto by_node = [](const auto& a, const auto& b) { return a.node < b.node; };
  std::ranges::stable_sort(scene.lights, by_node);
  std::ranges::stable_sort(scene.sphls, by_node);
  scene::validate(scene);
  return scene;
}

namespace {

/// A scene is opened with the overlay of its name beside it: neither may appear beside a stranger.
void check_neighbors(const Document& document, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  const std::string stem = file.stem().stem().string();
  const auto beside = [&](const std::string& ending) { return file.parent_path() / (stem + ending); };
  const bool overlay = file.string().ends_with(overlay_ending);
  std::error_code ignored;
  if (!overlay && fs::exists(scene_io::overlay_beside(file.string()), ignored))
    throw Error(file.string(),
                "the overlay of that name beside it would change the scene whenever it is opened",
                "choose another name");
  for (const char* ending : {".glb", ".gltf", ".obj"}) {
    if (!overlay || !fs::exists(beside(ending), ignored)) continue;
    const OpenedFiles below = opened_files(document.source, document.overlay);
    const bool own = below.overlays.empty() && fs::equivalent(beside(ending), below.scene, ignored);
    if (!own)
      throw Error(file.string(), fmt::format("{} beside it would be opened with these edits", stem + ending),
                  "choose another name");
  }
}

}  // namespace

void save_document(const Document& document, const std::filesystem::path& file) {
  check_neighbors(document, file);
  if (file.string().ends_with(overlay_ending)) {
    if (document.recovered)
      throw Error(file.string(), "a recovered scene holds edits that an overlay would leave out",
                  "save it as .glb");
    return write_file(file, json::print(overlay_of(document, file.parent_path()), 2) + "\n");
  }
  if (file.extension() != ".glb")
    throw Error(file.string(), "scenes are saved as GLB, edits as overlays",
                "let the name end with .glb or .ssphh.json");
  scene_io::write_glb(file, scene_to_save(document));
}

}  // namespace ssphh::viewer
