#pragma once
/// `ssphh probe import`: the light of a probe from a picture of the sphere around it, by whatever renderer.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/probes/probe_set.h>

#include "options/scene_options.h"

namespace ssphh::app {

/// What of the light the picture shows: what surfaces reflect, which those that look it up get beside direct
/// light; or lamps and sky seen directly.
enum class LightPart { reflected, emitted };
constexpr auto enum_table(LightPart) {
  using enum LightPart;
  return std::to_array<EnumName<LightPart>>({{reflected, "reflected"}, {emitted, "emitted"}});
}

struct ProbeImportOptions {
  /// Linear radiance [W sr⁻¹ m⁻²]: one picture of the whole sphere, or those of the six cameras of
  /// scene_io::cube_cameras().
  std::vector<std::string> images;
  std::optional<image::Layout> layout;  ///< of one picture
  /// As `images`, lamps and sky alone, which `images` show as well: taken off them, and the emitted part.
  std::vector<std::string> emitted;
  /// SPHL whose sphere is all that shines in the pictures, as VIZ has it: they become an edge of the set;
  /// empty: they are light.
  std::string viz_from;
  probes::VizSource viz_source = probes::VizSource::intensity;  ///< how bright that sphere was
  std::string sphl;                                             ///< probe that the pictures are of, by name
  SceneOptions scene;         ///< whose SPHLs a new set has, dark at first; no source: `into` has them
  std::string into;           ///< probe file whose set gets the light; empty: the scene's
  std::string group = "all";  ///< light group; one that the set lacks is added
  LightPart part = LightPart::reflected;
  int degree = 9;      ///< of a new set
  std::string output;  ///< probe file to write
};

struct ProbeImportResult {
  probes::ProbeSet set;
  int probe = 0;      ///< that got the light
  int face_size = 0;  ///< pixels of the cube that was projected
};

/// Throws Error for pictures that are neither one of a layout nor six faces, for numbers that are not finite
/// or negative, for a probe that there is not, for an edge beside edges of another VizSource, where neither
/// or both of scene and set are given, and for files.
ProbeImportResult run_probe_import(const ProbeImportOptions& options, const Control& control = {});
json::Value to_json(const ProbeImportResult& result, const ProbeImportOptions& options);
std::string to_text(const ProbeImportResult& result, const ProbeImportOptions& options);

}  // namespace ssphh::app
