#include "options/scene_options.h"

#include <ssphh/core/error.h>
#include <ssphh/scene_io/unit.h>

namespace ssphh::app {
namespace {

std::string light_mode_problem(const std::string& text) {
  try {
    pipeline::read_light_mode(text);
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
              "baked), baked (direct light, too) or diffuse (as baked, with sharp reflections of the "
              "environment); default: what the scene says, else diffuse for an environment without a sharp "
              "sun and realtime for lamps")
      .check(light_mode_problem, "GROUP=MODE")
      .repeatable();
}

}  // namespace ssphh::app
