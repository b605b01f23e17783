#include "options/scene_options.h"

#include <utility>

#include <ssphh/scene/lambertian.h>
#include <ssphh/scene_io/load.h>

namespace ssphh::app {

void add_scene_options(Command command, SceneOptions& options, bool posed, const std::string& source) {
  command.option(source, options.source, "File (.glb .gltf .obj, or an overlay .ssphh.json) or builtin:NAME")
      .required();
  const std::string group = "Scene";
  if (posed) {
    command.option("--time", options.time, "Pose the scene's animations at this time [s]").group(group);
  }
  command
      .option("--overlay", options.overlay,
              "Side file that adds lights, cameras, SPHLs (docs/scenes.md); default: SCENE.ssphh.json if "
              "there is one")
      .group(group);
  command
      .flag("--lambert", options.lambert,
            "All surfaces Lambertian of their base colour: what every renderer computes alike")
      .group(group);
  const Option environment = command
                                 .option("--environment", options.environment,
                                         "Equirectangular .hdr or .exr around the scene, in place of its own")
                                 .group(group);
  command
      .option("--environment-intensity", options.environment_intensity,
              "Factor on the environment's radiance")
      .non_negative()
      .group(group);
  command
      .option("--environment-rotation", options.environment_rotation,
              "Degrees about +y, counter-clockwise seen from above; also turns a scene's own")
      .group(group);
  command.flag("--sun-sky", options.sun_sky, "Analytic sun and sky (Preetham) in place of the environment")
      .excludes(environment)
      .group(group);
  command.option("--sun-elevation", options.sun_elevation, "Degrees above the horizon")
      .range(0.0f, 90.0f)
      .group(group);
  command.option("--sun-azimuth", options.sun_azimuth, "Degrees by compass: 0 is −z, 90 is +x").group(group);
  command.option("--turbidity", options.turbidity, "Haze: 2 very clear, 10 hazy")
      .range(1.7f, 10.0f)
      .group(group);
}

scene::Scene load_scene(const SceneOptions& options) {
  scene_io::LoadOptions load;
  load.overlay = options.overlay;
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

}  // namespace ssphh::app
