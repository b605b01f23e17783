#pragma once
/// `ssphh measure`: indirect light looked up from probes, or found by any method, against path tracing.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>

#include "commands/measure_regions.h"
#include "options/scene_options.h"

namespace ssphh::app {

using pipeline::MethodFigures;

/// Mean relative noise of a truth that is held against lookups, where nobody asks for a number of paths.
inline constexpr double usual_noise = 0.03;

struct MeasureOptions {
  SceneOptions scene;
  std::vector<std::string> probes;  ///< probe files
  std::vector<probes::WeightMethod>
      weights;                       ///< each file is looked up with each; none: as the file would have it
  std::vector<std::string> methods;  ///< each as "NAME" or "NAME,PARAMETER=VALUE,..."
  std::optional<scene::Bounds> box;  ///< all points within [m]
  std::vector<NamedBox> regions;     ///< whose errors, at as many points, are told as well
  bool views = false;                ///< the error at as many points that each camera sees is told as well
  float clearance = 0.05f;           ///< only points with so much free space before them [m]
  bool open = false;                 ///< points in the open instead of on surfaces, facing anywhere
  bool force = false;                ///< go on, with a warning, where probes are of another scene or pose
  int points = 1024;                 ///< surface points, over 0
  std::uint64_t seed = 0;            ///< of points and paths
  /// Of the truth. Seed and noise are not read: 0 paths a point stand for 512, and more until their noise is
  /// usual_noise.
  study::LeakParams params{.path = {.max_depth = rays::usual_max_depth, .passes = 1, .spp = 0, .seed = 0}};
};

/// The error at the points of one region.
struct RegionError {
  std::string name;
  int spp = 0;  ///< paths of each point's truth
  study::LookupError error;
  double leak_ratio = 0;  ///< share of the light of these points that stands on dark ones
  std::optional<double>
      unseen;  ///< share of the points that see none of the probes near them; of a probe file
};

/// One way to look light up.
struct MeasuredLight {
  std::string name;                             ///< probe file or method, as the options have it
  std::optional<probes::WeightMethod> weights;  ///< of a probe file
  std::optional<MethodFigures> method;          ///< of a method, after its first update
  study::LookupError error;                     ///< at all points
  std::optional<double> unseen;                 ///< as of a region
  std::vector<RegionError> regions;             ///< one for each of the result's
  double leak_ratio = 0;                        ///< share of its light that stands on dark points
  double lookup_us = 0;                         ///< microseconds of all threads together for one lookup
  std::optional<double> frame_ms;               ///< milliseconds of a method's update after a small change
};

struct MeasureResult {
  std::vector<rays::SurfacePoint> points;
  study::TruthAtPoints truth;           ///< at these
  std::vector<MeasuredRegion> regions;  ///< inside and outside, where there are such points; those asked for
  std::vector<MeasuredLight> lights;    ///< probe files first; none is missing
  std::uint64_t geometry_builds = 0;    ///< acceleration structures that were built
};

/// Measures all probe files and methods at the same points. Throws Error where there is nothing to measure,
/// for files that cannot be read, for probes of another scene or pose, for weights that a file does not
/// have, for unknown methods and parameters, for two regions of one name, and as
/// study::reachable_points and study::trace_truth do; Cancelled when asked to stop.
MeasureResult run_measure(const MeasureOptions& options, const Control& control = {});

json::Value to_json(const MeasureResult& result, const MeasureOptions&);
std::string to_text(const MeasureResult& result, const MeasureOptions&);

}  // namespace ssphh::app
