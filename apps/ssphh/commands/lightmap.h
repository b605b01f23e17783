#pragma once
/// `ssphh lightmap`: the light of still surfaces as textures, and the scene with the coordinates that lead
/// into them.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/bake/effort.h>
#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/lightmap/chart.h>
#include <ssphh/lightmap/layout.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct LightmapOptions {
  SceneOptions scene;
  std::string probes;                           ///< file whose light is taken; empty: it is baked first
  bake::Quality quality = bake::Quality::good;  ///< of that bake
  std::uint64_t seed = 0;                       ///< of that bake
  std::string output;                           ///< GLB file; the textures are named after it
  lightmap::ChartParams charts;
  lightmap::LayoutParams layout;
  bool groups = false;        ///< a texture for each light group
  bool direct = false;        ///< with light straight from emitters
  int direct_samples = 256;   ///< of each emitter with an extent and texel
  bool divide_by_pi = false;  ///< E/π in place of E
  bool force = false;         ///< go on, with a warning, where the probes are of another scene
};

/// The textures of one light group, or of all together.
struct LightmapFiles {
  std::string group;  ///< empty: all
  std::string exr, ktx2, rgbm;
  float rgbm_scale = 1;
  vec3 mean{0};  ///< of the texels that surfaces have
};

struct LightmapResult {
  std::size_t surfaces = 0;  ///< with a lightmap
  std::size_t charts = 0, texels = 0;
  std::size_t hidden = 0;  ///< texels within or under other bodies, which take the light of neighbours
  int width = 0, height = 0;
  float density = 0;  ///< texels per metre
  std::vector<LightmapFiles> files;
  std::vector<std::string> direct_groups;  ///< whose direct light is in the textures
  std::vector<std::string> notes;
  double bake_seconds = 0, seconds = 0;  ///< of the bake of the light; of all else
};

/// Writes OUT.glb, and OUT.lightmap.exr, .ktx2 and .rgbm.png beside it (docs/lightmaps.md). Throws Error for
/// scenes and probe files that cannot be read or do not belong together, and as lightmap::make_charts and
/// lay_out do; Cancelled when asked to stop, and then nothing is written.
LightmapResult run_lightmap(const LightmapOptions& options, const Control& control = {});
json::Value to_json(const LightmapResult& result, const LightmapOptions& options);
std::string to_text(const LightmapResult& result, const LightmapOptions& options);

}  // namespace ssphh::app
