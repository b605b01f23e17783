#include "picture_options.h"

namespace ssphh::app {

void add_picture_options(CLI::App& command, PictureOptions& o) {
  add_scene_options(command, o.scene);
  command.add_option("--camera", o.camera, "Camera by name; default: the scene's first");
  command.add_option("--width", o.width, "Pixels")->check(CLI::Range(1, 65536))->capture_default_str();
  command.add_option("--height", o.height, "Pixels")->check(CLI::Range(1, 65536))->capture_default_str();
  command
      .add_option("--max-depth", o.max_depth,
                  "Scattering events: 0 emitters only, 1 direct light, 2 one bounce …")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_option("--spp", o.spp, "Samples per pixel")
      ->check(CLI::Range(2, 1 << 20))
      ->capture_default_str();
}

scene_io::ExportSettings export_settings(const PictureOptions& o, const scene::Scene& scene) {
  return {
      scene::camera_pose(scene, o.camera, o.scene.time), o.scene.time, o.width, o.height, o.max_depth, o.spp};
}

}  // namespace ssphh::app
