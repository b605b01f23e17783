#include "export_steps.h"

#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/core/vectors.h>
#include <ssphh/scene/area_lamp.h>

namespace ssphh::scene_io {

scene::Scene begin_export(const scene::Scene& scene, const ExportSettings& settings,
                          const std::filesystem::path& directory) {
  scene::check_indices(scene);
  require(settings.width >= 1 && settings.height >= 1, "export", "width and height must be positive");
  require(settings.max_depth >= 0 && settings.spp >= 1, "export",
          "max depth must not be negative, and there must be a sample");
  require(std::isfinite(settings.time), "export", "the time must be a finite number of seconds");
  require(!settings.cube_at || (settings.width == settings.height && is_finite(*settings.cube_at)), "export",
          "a cube map's pictures must be square, and its place finite");
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw Error(directory.string(), "the folder cannot be made: " + error.message());
  return scene::area_lamps_as_meshes(scene, settings.time);
}

void note_area_lamps(const scene::Scene& given, Differences& differences) {
  for (const scene::Light& light : given.lights)
    if (scene::is_area_lamp(light.type)) differences.add("flat lamps block other light", light.name);
}

std::vector<scene::CameraPose> cameras_of(const ExportSettings& settings) {
  if (!settings.cube_at) return {settings.camera};
  const std::array<scene::CameraPose, 6> faces = cube_cameras(*settings.cube_at);
  return {faces.begin(), faces.end()};
}

std::string for_each_face(const std::string& command) {
  return "for f in 0 1 2 3 4 5; do " + command + "; done";
}

void note_shown_emitters(const scene::Scene& scene, const FlatScene& flat, const ExportSettings& settings,
                         Differences& differences) {
  if (settings.shows_emitters) return;
  const auto note = [&](const std::string& name) {
    differences.add(
        "lamps and sky are in the pictures: make those of --max-depth 0 as well, for `ssphh probe import "
        "--emitted`",
        name);
  };
  for (const FlatMesh& mesh : flat.meshes)
    if (material_of(scene, mesh).emissive()) note(mesh.name);
  for (const FlatLight& light : flat.lights)
    if (light.light->type == scene::LightType::sphere) note(light.light->name);
  if (scene.environment) note(scene.environment->name);
}

ExportReport end_export(std::vector<std::filesystem::path> files, const TextureFiles& textures,
                        const Differences& differences, const std::string& command) {
  files.insert(files.end(), textures.written().begin(), textures.written().end());
  return {std::move(files), command, differences.lines()};
}

}  // namespace ssphh::scene_io
