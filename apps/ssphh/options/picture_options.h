#pragma once
/// The options of the commands that make pictures; PictureOptions of those that hand one to another renderer.

#include <optional>
#include <string>

#include <ssphh/pipeline/render_scene.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene_io/renderer_export.h>

#include "options/command_line.h"
#include "options/scene_options.h"

namespace ssphh::app {

using pipeline::camera_of;
using pipeline::PictureProjection;

void add_camera_option(Command command, std::string& camera);
/// --width and --height in pixels, each at most `most`.
void add_size_options(Command command, int& width, int& height, int most = 16384);
/// --at of a picture of the whole sphere.
void add_at_option(Command command, std::string& at);
/// Where an SPHL of that name stands at a time, or "X,Y,Z" [m]. Throws Error that lists the SPHLs.
vec3 place_of(const scene::Scene& scene, const std::string& text, float time);
Option add_max_depth_option(Command command, int& max_depth);
/// --exposure auto|EV; none stands for auto.
void add_exposure_option(Command command, std::optional<float>& exposure, const std::string& help);
/// --tev HOST:PORT, for a TevViewer.
Option add_tev_option(Command command, std::string& address, const std::string& help);

struct PictureOptions {
  SceneOptions scene;
  std::string camera;                     ///< by name; empty: the scene's first
  int width = 1280, height = 720;         ///< pixels, over 0
  int max_depth = rays::usual_max_depth;  ///< scattering events of a path
  int spp = 64;                           ///< samples per pixel
};

/// SCENE and its options, --camera, --width, --height, --max-depth, --spp.
void add_picture_options(Command command, PictureOptions& options);

scene_io::ExportSettings export_settings(const PictureOptions& options, const scene::Scene& scene);

}  // namespace ssphh::app
