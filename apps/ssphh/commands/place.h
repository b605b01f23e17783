#pragma once
/// `ssphh place`: places for SPHLs, found and written as an overlay of the scene.

#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

#include "options/place_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

struct PlaceOverlayOptions {
  SceneOptions scene;
  PlaceOptions place;  ///< its probes: as --probes says, but not `scene`; empty: auto
  std::string output;  ///< overlay to write, NAME.ssphh.json: a scene of its own
};

/// Finds places and writes an overlay that names the scene, repeats the overlay that lies on it and adds the
/// places, those of the scene's own SPHLs apart. Throws Error where the output is the scene itself, where
/// there is nothing to place, for two overlays at once, for files that cannot be read or written, and as
/// place::place_probes does; Cancelled when asked to stop.
PlaceResult run_place(const PlaceOverlayOptions& options, const Control& control = {});

json::Value to_json(const PlaceResult& result, const PlaceOverlayOptions& options);
std::string to_text(const PlaceResult& result, const PlaceOverlayOptions& options);

}  // namespace ssphh::app
