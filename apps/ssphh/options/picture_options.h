#pragma once
/// The options of the commands that make pictures; PictureOptions of those that hand one to another renderer.

#include <optional>
#include <string>

#include <ssphh/core/enum_names.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene_io/renderer_export.h>
#include <ssphh/trace/render_state.h>
#include <ssphh/trace/scene_geometry.h>

#include "options/command_line.h"
#include "options/scene_options.h"

namespace ssphh::app {

/// What the camera sees, or the whole sphere around it: equirectangular, or as a strip of 6×1 faces.
enum class PictureProjection { camera, equirect, cube };
constexpr auto enum_table(PictureProjection) {
  using enum PictureProjection;
  return std::to_array<EnumName<PictureProjection>>(
      {{camera, "camera"}, {equirect, "equirect"}, {cube, "cube"}});
}
trace::Projection projection_of(PictureProjection projection, const scene::Camera& camera);

void add_camera_option(Command command, std::string& camera);
/// The camera of that name, or the scene's first; study::default_view() of a scene that has none, by its
/// geometry where that has been built already.
scene::CameraPose camera_of(const scene::Scene& scene, const std::string& name, float time,
                            trace::SharedGeometry geometry = {});
/// --width and --height in pixels, each at most `most`.
void add_size_options(Command command, int& width, int& height, int most = 16384);
Option add_max_depth_option(Command command, int& max_depth);
/// --exposure auto|EV; none stands for auto.
void add_exposure_option(Command command, std::optional<float>& exposure, const std::string& help);

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
