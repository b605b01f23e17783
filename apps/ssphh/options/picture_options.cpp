#include "options/picture_options.h"

namespace ssphh::app {

void add_picture_options(Command command, PictureOptions& o) {
  add_scene_options(command, o.scene);
  command.option("--camera", o.camera, "Camera by name; default: the scene's first");
  command.option("--width", o.width, "Pixels").range(1, 65536);
  command.option("--height", o.height, "Pixels").range(1, 65536);
  command
      .option("--max-depth", o.max_depth,
              "Scattering events: 0 emitters only, 1 direct light, 2 one bounce …")
      .range(0, 1000);
  command.option("--spp", o.spp, "Samples per pixel").range(2, 1 << 20);
}

scene_io::ExportSettings export_settings(const PictureOptions& o, const scene::Scene& scene) {
  return {
      scene::camera_pose(scene, o.camera, o.scene.time), o.scene.time, o.width, o.height, o.max_depth, o.spp};
}

}  // namespace ssphh::app
