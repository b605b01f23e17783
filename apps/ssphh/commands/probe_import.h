#pragma once
/// `ssphh probe import`: the light of a probe from a picture of the sphere around it, by whatever renderer.

#include <string>

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
  std::string input;  ///< picture, linear radiance [W sr⁻¹ m⁻²]
  image::Layout layout = image::Layout::cross_v;
  std::string sphl;           ///< probe that the picture is of, by name
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

/// Throws Error for pictures of another shape than the layout's and for numbers that are not finite or
/// negative, for a probe that there is not, where neither or both of scene and set are given, and for files.
ProbeImportResult run_probe_import(const ProbeImportOptions& options, const Control& control = {});
json::Value to_json(const ProbeImportResult& result, const ProbeImportOptions& options);
std::string to_text(const ProbeImportResult& result, const ProbeImportOptions& options);

}  // namespace ssphh::app
