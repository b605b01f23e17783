#pragma once
/// `ssphh web`: a folder that any web host serves and that shows the scene, lit, in a browser.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/bake/effort.h>
#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/lightmap/chart.h>
#include <ssphh/lightmap/layout.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct WebOptions {
  SceneOptions scene;
  std::string probes;                           ///< file whose light is taken; empty: it is baked first
  bake::Quality quality = bake::Quality::good;  ///< of that bake
  std::uint64_t seed = 0;                       ///< of that bake, and of pictures
  std::string output;                           ///< folder to write
  bool replace = false;                         ///< also a folder with files that are not of this command
  std::string page;                             ///< folder of the built page; empty: page_folder()
  lightmap::ChartParams charts;
  lightmap::LayoutParams layout;
  int direct_samples = 64;           ///< of each emitter with an extent and texel
  bool merge_groups = false;         ///< one lightmap of all light
  std::optional<int> poses;          ///< of what moves; none: 5, or 1 of a probe file or where nothing moves
  std::vector<std::string> movable;  ///< lamps that the page drags, by name; "all": those that can be
  /// Most between the places whose light is found [m]; none: 1, or 0.5 for a spot, whose bright disc moves.
  std::optional<float> movable_step;
  float movable_reach = 2;           ///< of these places from the lamp's own, along each axis [m]
  std::optional<int> movable_size;   ///< texels along these lightmaps' width; none: a quarter of the scene's
  std::optional<int> truth;          ///< samples a pixel of path-traced pictures; none: no pictures
  std::vector<std::string> cameras;  ///< of these pictures; empty: all
  int width = 960, height = 540;     ///< of these pictures [pixels]
  std::optional<float> exposure;     ///< EV; none: what suits each camera's picture
  image::ToneCurve tonemap = image::ToneCurve::clip;
  bool force = false;  ///< go on, with a warning, where the probes are of another scene
};

/// A file of the folder.
struct WebFile {
  std::string name;  ///< below the folder, with slashes
  std::size_t bytes = 0;
};

/// A lamp that the page drags.
struct WebMovable {
  std::string name;
  std::size_t places = 0;  ///< at which its light was found
};

struct WebResult {
  std::vector<WebFile> files;
  std::size_t bytes = 0;  ///< of all files
  std::vector<std::string> cameras, groups;
  std::vector<float> times;  ///< of the poses [s]
  std::vector<WebMovable> movable;
  int width = 0, height = 0;
  float density = 0;  ///< texels per metre
  std::vector<std::string> notes;
  /// Of the bakes of the light; of that of lamps elsewhere; of all else.
  double bake_seconds = 0, lamp_seconds = 0, seconds = 0;
};

/// share/ssphh/web beside the folder of this program: of the build tree, or installed.
std::string page_folder();

/// Writes the folder (docs/web.md) under another name first, and replaces one that it wrote before. Throws
/// Error before any work where the page was not built, where the folder may not be written or holds other
/// files, for an unknown camera, for lamps that cannot be moved, and for charts that do not fit; Cancelled
/// when asked to stop, and then nothing is written.
WebResult run_web(const WebOptions& options, const Control& control = {});
json::Value to_json(const WebResult& result, const WebOptions& options);
std::string to_text(const WebResult& result, const WebOptions& options);

}  // namespace ssphh::app
