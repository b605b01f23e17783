#pragma once
/// What `ssphh render` may be told, whoever makes the picture.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/rays/radiance_source.h>

#include "options/farm_options.h"
#include "options/picture_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

/// Rays of the CPU, or a frame of the real-time renderer.
enum class RenderBackend { cpu, gl };
constexpr auto enum_table(RenderBackend) {
  using enum RenderBackend;
  return std::to_array<EnumName<RenderBackend>>({{cpu, "cpu"}, {gl, "gl"}});
}

struct RenderOptions {
  SceneOptions scene;
  FarmChoice farm;                      ///< that traces, if there is any: for methods path and ssphh
  std::string method;                   ///< what finds indirect light; empty: as method_of() says
  std::vector<std::string> parameters;  ///< of the method, as NAME=VALUE
  RenderBackend backend = RenderBackend::cpu;
  std::uint64_t seed = 0;

  std::string output;  ///< picture to write: .exr or .hdr (linear radiance), .png or .jpg (tone mapped)
  std::string png;     ///< tone-mapped PNG to write as well; empty: none
  /// Float images to write beside the output, as OUT.NAME.exr, and of `groups` one for each light group.
  /// OpenGL draws direct, indirect, albedo and normal.
  std::vector<trace::RenderLayer> aovs;
  /// Names of methods::Drawing: of the method, drawn over the finished picture.
  std::vector<std::string> draw;
  std::optional<float> exposure;  ///< of tone-mapped pictures, in stops; none: what suits the picture
  image::ToneCurve tonemap = image::ToneCurve::clip;
  std::string tev;  ///< "HOST:PORT" of a tev that shows the picture, after each pass; empty: none

  int width = 1280, height = 720;  ///< pixels, over 0
  std::string camera;              ///< by name; empty: the scene's first
  PictureProjection projection = PictureProjection::camera;
  std::string at;  ///< place of a whole sphere: a SPHL by name, or "X,Y,Z"; empty: the camera's

  int max_depth =
      rays::usual_max_depth;  ///< scattering events of a path: 0 emitters only, 1 direct light, 2 one bounce
  int passes = 1;             ///< over 0; finished ones survive a cancel in OUTPUT.state
  int spp = 16;               ///< samples per pixel and pass, over 0; OpenGL takes up to 16 in all
  bool resume = false;        ///< go on from OUTPUT.state

  std::string probes;  ///< probe file, for method ssphh; empty: probes are placed and lit for the picture
  probes::LookupSpec lookup;  ///< of the probes
  bool force = false;         ///< go on, with a warning, where the probes are of another scene or pose

  float occlusion = 0;     ///< OpenGL dims SPHLs' light by what stands within so many metres; 0: it does not
  int indirect_scale = 1;  ///< OpenGL looks indirect light up at every so-many-th pixel each way, 1..8
};

/// The method, path or one of methods::all_methods(): the given one, else ssphh where there are probes or
/// OpenGL draws, else path.
std::string method_of(const RenderOptions& options);
/// Throws Error for a name that none has, with the nearest.
std::vector<methods::Drawing> drawings_of(const RenderOptions& options);

void add_render_options(Command command, RenderOptions& options);

}  // namespace ssphh::app
