#pragma once
/// The options of the commands that hand one picture to another renderer.

#include <string>

#include <ssphh/scene_io/renderer_export.h>

#include "options/command_line.h"
#include "options/scene_options.h"

namespace ssphh::app {

struct PictureOptions {
  SceneOptions scene;
  std::string camera;
  int width = 1280, height = 720, max_depth = 25, spp = 64;
};

/// SCENE and its options, --camera, --width, --height, --max-depth, --spp.
void add_picture_options(Command command, PictureOptions& options);

scene_io::ExportSettings export_settings(const PictureOptions& options, const scene::Scene& scene);

}  // namespace ssphh::app
