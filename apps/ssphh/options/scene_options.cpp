#include "options/scene_options.h"

#include <algorithm>
#include <utility>

#include <ssphh/core/log.h>
#include <ssphh/scene/lambertian.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/studio.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/unit.h>

namespace ssphh::app {
namespace {

/// "GROUP=MODE"; throws Error for anything else.
scene::GroupMode read_light_mode(const std::string& text) {
  const std::string where = "--light-mode " + text;
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos || sign == 0)
    throw Error(where, "is not GROUP=MODE", "write sky=baked, for instance");
  return {text.substr(0, sign), enum_named<scene::LightMode>(where, text.substr(sign + 1))};
}

std::string light_mode_problem(const std::string& text) {
  try {
    read_light_mode(text);
    return {};
  } catch (const Error& e) {
    return e.problem();
  }
}

}  // namespace

void add_scene_options(Command command, SceneOptions& options, bool posed, const std::string& source) {
  command.option(source, options.source, "File (.glb .gltf .obj, or an overlay .ssphh.json) or builtin:NAME")
      .required();
  const Command scene = command.under("Scene");
  if (posed) {
    scene.option("--time", options.time, "Pose the scene's animations at this time [s]");
  }
  scene.option("--overlay", options.overlay,
               "Side file that adds lights, cameras, SPHLs (docs/scenes.md); default: SCENE.ssphh.json if "
               "there is one");
  scene
      .option("--unit", options.unit,
              "Unit of the file's lengths: mm, cm, m, inch, metres per unit, or auto to guess it; default: "
              "metres")
      .check(scene_io::unit_problem, "UNIT");
  scene.flag("--lambert", options.lambert,
             "All surfaces Lambertian of their base colour: what every renderer computes alike");
  const Option environment =
      scene.option("--environment", options.environment,
                   "Equirectangular .hdr or .exr around the scene, in place of its own");
  scene
      .option("--environment-intensity", options.environment_intensity,
              "Factor on the environment's radiance")
      .non_negative();
  scene.option("--environment-rotation", options.environment_rotation,
               "Degrees about +y, counter-clockwise seen from above; also turns a scene's own");
  scene.flag("--sun-sky", options.sun_sky, "Analytic sun and sky (Preetham) in place of the environment")
      .excludes(environment);
  scene.option("--sun-elevation", options.sun_elevation, "Degrees above the horizon").range(0.0f, 90.0f);
  scene.option("--sun-azimuth", options.sun_azimuth, "Degrees by compass: 0 is −z, 90 is +x");
  scene.option("--turbidity", options.turbidity, "Haze: 2 very clear, 10 hazy").range(1.7f, 10.0f);
  scene
      .option("--light-mode", options.light_modes,
              "How a light group's light reaches pictures with probes: realtime, mixed (indirect light as "
              "baked) or baked (direct light, too); default: what the scene says, else realtime")
      .check(light_mode_problem, "GROUP=MODE")
      .repeatable();
}

namespace {

/// The scene as its file and its overlay tell of it, lit as the options ask.
scene::Scene load_file(const SceneOptions& options) {
  scene_io::LoadOptions load;
  load.overlay = options.overlay;
  load.unit = options.unit;
  load.time = options.time;
  load.environment = options.environment;
  load.environment_intensity = options.environment_intensity;
  load.environment_rotation = glm::radians(options.environment_rotation);
  if (options.sun_sky) {
    scene::SunSkyParams& sky = load.sun_sky.emplace();
    sky.elevation = glm::radians(options.sun_elevation);
    sky.azimuth = glm::radians(options.sun_azimuth - 90);
    sky.turbidity = options.turbidity;
  }
  scene::Scene scene = scene_io::load_scene(options.source, load);
  return options.lambert ? scene::lambertian(std::move(scene)) : scene;
}

scene::Scene with_modes(scene::Scene scene, const SceneOptions& options) {
  for (const std::string& text : options.light_modes) {
    const auto [group, mode] = read_light_mode(text);
    scene::set_light_mode(scene, group, mode);
  }
  return scene;
}

}  // namespace

scene::Scene load_scene(const SceneOptions& options) {
  return with_modes(load_file(options), options);
}

scene::Scene load_lit_scene(const SceneOptions& options) {
  scene::Scene scene = load_file(options);
  if (scene::light_groups(scene).empty()) {
    log_warning(
        "{}: no lights: a neutral studio lights it (add lights to the file or by --overlay, or give "
        "--sun-sky or --environment FILE)",
        options.source);
    scene::add_studio(scene);
  }
  return with_modes(std::move(scene), options);
}

scene::Scene load_lit_scene(const SceneOptions& options, std::vector<FileStamp>& files) {
  const FilesRead read;
  const FileStamp beside = stamp_of(scene_io::overlay_beside(options.source));
  const auto keep = [&] {
    files = read.stamps();
    if (std::ranges::find(files, beside.path, &FileStamp::path) == files.end()) files.push_back(beside);
  };
  try {
    scene::Scene scene = load_lit_scene(options);
    keep();
    return scene;
  } catch (const Error&) {
    keep();
    throw;
  }
}

}  // namespace ssphh::app
