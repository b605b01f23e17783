#pragma once
/// Scenes from files and names. Formats: glTF 2.0 and GLB, Wavefront OBJ/MTL, overlays (docs/scenes.md).

#include <filesystem>
#include <optional>
#include <string>

#include <ssphh/scene/scene.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene_io {

struct LoadOptions {
  /// Side file that adds cameras, lights, SPHLs and more. Empty: SCENE.ssphh.json beside SCENE.glb (.gltf,
  /// .obj), if there is one.
  std::string overlay{};
  /// Unit of length of the scene file (unit.h), in place of what overlays say. Empty: theirs, else metres.
  std::string unit{};
  /// Seconds at which skins and morph targets give meshes their shape (gltf.h).
  float time = 0;
  /// Equirectangular .hdr or .exr (or any image); replaces the scene's own environment. Empty: none.
  std::string environment{};
  float environment_intensity = 1;  ///< factor on the image
  /// Radians about +y, counter-clockwise seen from above; of the scene's own environment, beyond its
  /// rotation.
  float environment_rotation = 0;
  /// Dark light groups keep what they emit, for those who turn them up again; else the scene is
  /// scene::without_dark_light(), as renderers take it.
  bool keep_dark_light = false;
  /// Clear sky and sun; replaces any environment.
  std::optional<scene::SunSkyParams> sun_sky{};
};

/// SCENE.ssphh.json of SCENE.glb, whether or not there is one.
std::filesystem::path overlay_beside(const std::string& source);

/// `source`: "builtin:NAME", a scene file, or an overlay that names its scene. The format is told from the
/// content, then from the extension. The result is valid (scene::validate); what the file holds and nobody
/// uses stands in Scene::ignored and is warned about once. Throws Error naming file and place.
scene::Scene load_scene(const std::string& source, const LoadOptions& options = {});

}  // namespace ssphh::scene_io
