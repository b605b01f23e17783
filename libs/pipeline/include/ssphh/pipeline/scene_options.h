#pragma once
/// Which scene, and how it is lit: from a file or a name to the scene that somebody works on.

#include <string>
#include <vector>

#include <ssphh/core/files_read.h>
#include <ssphh/pipeline/sky_options.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::pipeline {

struct SceneOptions {
  std::string source;  ///< file or builtin:NAME
  std::string overlay, environment;
  std::string unit;  ///< of the file's lengths (scene_io/unit.h); empty: what overlays say, else metres
  float environment_intensity = 1;
  float environment_rotation = 0;  ///< degrees
  bool lambert = false;
  bool keep_dark_light = false;  ///< as scene_io::LoadOptions
  SkyOptions sky;
  float time = 0;                        ///< seconds
  std::vector<std::string> light_modes;  ///< "GROUP=MODE"; the group's name may hold a "=", too
};

/// "GROUP=MODE"; throws Error for anything else.
scene::GroupMode read_light_mode(const std::string& text);

/// Throws Error as scene_io::load_scene does, for modes that are none and for groups that the scene has not.
scene::Scene load_scene(const SceneOptions& options);

/// For those who look at light: a scene without any gets a neutral studio around it, and a warning.
scene::Scene load_lit_scene(const SceneOptions& options);

/// Loads and lights it likewise; `files` are those that it was read from, as far as it came before it threw,
/// and the overlay beside SCENE, be there one or not.
scene::Scene load_lit_scene(const SceneOptions& options, std::vector<FileStamp>& files);

/// Warns about SPHLs that shine from inside of a body, where nobody would see their light.
void warn_about_lamps(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time);

}  // namespace ssphh::pipeline
