#include <algorithm>
#include <utility>

#include <ssphh/core/log.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/scene/lambertian.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/studio.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/thing_emission.h>

namespace ssphh::pipeline {

scene::GroupMode read_light_mode(const std::string& text) {
  const std::string where = "--light-mode " + text;
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos || sign == 0)
    throw Error(where, "is not GROUP=MODE", "write sky=baked, for instance");
  return {text.substr(0, sign), enum_named<scene::LightMode>(where, text.substr(sign + 1))};
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
  load.keep_dark_light = options.keep_dark_light;
  load.sun_sky = sun_sky_of(options.sky);
  scene::Scene scene = scene_io::load_scene(options.source, load);
  tell_of_sun(scene);
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
        "--sky or --environment FILE)",
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

void warn_about_lamps(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time) {
  const auto shines = [](const scene::Light& light) { return light.type == scene::LightType::sphl; };
  if (std::ranges::none_of(scene.lights, shines)) return;
  for (const std::string& name : trace::buried_lamps(scene, trace::PathTracer(geometry, scene, time), time)) {
    log_warning(
        "SPHL \"{}\" seems to shine from inside of a body: most of what it sees are back faces (move it, or "
        "give it a radius that holds the body)",
        name);
  }
}

}  // namespace ssphh::pipeline
