#pragma once
/// The options of every command that may place probes, and what it prints about them.

#include <optional>
#include <string>

#include <ssphh/core/json.h>
#include <ssphh/place/place.h>
#include <ssphh/trace/scene_geometry.h>

#include "options/command_line.h"

namespace ssphh::app {

struct PlaceOptions {
  std::string probes;  ///< scene, auto, auto:METRES or a number; empty: the command's default
  float clearance = 0.04f;
  int levels = 1, max_probes = 4096;
};

/// With `files`, --probes also takes a probe file, for is_probe_file() to tell.
void add_place_options(Command command, PlaceOptions& options, bool files = false);

/// Whether --probes names a probe file by its extension.
bool is_probe_file(const PlaceOptions& options);

struct PlaceResult {
  place::Placement placement;
  double seconds = 0;
};

/// Places probes as the options say; none for `scene`. Empty options stand for `fallback`; where that is
/// empty too, for `scene` if the scene has SPHLs, else for `auto` with a note on stderr.
std::optional<PlaceResult> place_for(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                     float time, const PlaceOptions& options, const std::string& fallback,
                                     const Control& control);

json::Value place_json(const PlaceResult& result);
std::string place_text(const PlaceResult& result);

}  // namespace ssphh::app
