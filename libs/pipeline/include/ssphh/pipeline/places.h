#pragma once
/// Where probes are to stand, as people ask for it: in words.

#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/place/place.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::pipeline {

struct PlaceOptions {
  std::string probes;  ///< scene, auto, auto:METRES or a number; empty: the caller's default
  float clearance = 0.04f;
  int levels = 1, max_probes = 65536;
};

/// What is wrong with `probes`, as one of these words; empty: nothing.
std::string places_problem(const std::string& probes);

/// Whether `probes` names a probe file by its extension.
bool is_probe_file(const PlaceOptions& options);

struct PlaceResult {
  place::Placement placement;
  double seconds = 0;
};

/// Places probes as the options say; none for `scene`. Empty options stand for `fallback`; where that is
/// empty too, for `scene` if the scene has SPHLs, else for `auto` with a note in the log. Throws Error for
/// words that places_problem() refuses, and as place::place_probes does.
std::optional<PlaceResult> place_for(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                     float time, const PlaceOptions& options, const std::string& fallback,
                                     const Control& control);

}  // namespace ssphh::pipeline
