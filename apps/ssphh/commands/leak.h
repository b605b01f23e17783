#pragma once
/// `ssphh leak`: the light that probes put where path tracing finds none.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/study/leak.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct LeakOptions {
  SceneOptions scene;  ///< its time is not read
  std::string probes;  ///< probe file
  probes::LookupSpec lookup;
  std::optional<float> time;  ///< seconds; none: that of the probe file
  bool force = false;         ///< go on, with a warning, where the probes are of another scene
  int points = 2048;          ///< surface points to measure at, over 0
  std::uint64_t seed = 0;     ///< of points and paths
  study::LeakParams params;   ///< its seed is not read

  std::string output;             ///< leak map to draw: .png or .exr; empty: none
  std::string camera;             ///< of the map, by name; empty: the scene's first
  int width = 320, height = 180;  ///< pixels
  int map_spp = 64;               ///< paths per pixel
};

/// What the map that was written shows.
struct LeakMapFigures {
  std::size_t dark = 0;  ///< pixels
  float scale = 0;  ///< irradiance shown in the last colour, in shares of the mean; 0: the map is numbers
};

struct LeakResult {
  std::vector<rays::SurfacePoint> points;
  study::LeakReport report;                                  ///< at these
  probes::WeightMethod weights = probes::WeightMethod::mls;  ///< that the lookup blended with
  float time = 0;                                            ///< seconds; pose of the scene
  std::uint64_t geometry_builds = 0;                         ///< acceleration structures that were built
  std::optional<LeakMapFigures> map;
};

/// Measures, and draws the map if there is to be one. Warns in the log about another time than the bake's
/// and about a scene without indirect light. Throws Error for a map's name that is of another kind (before
/// anything else), for files that cannot be read or written, for an unknown camera, for probes of another
/// scene, for lookups that the file does not serve, and as study::reachable_points and study::measure_leak
/// do; Cancelled when asked to stop.
LeakResult run_leak(const LeakOptions& options, const Control& control = {});

json::Value to_json(const LeakResult& result, const LeakOptions& options);
std::string to_text(const LeakResult& result, const LeakOptions& options);

}  // namespace ssphh::app
