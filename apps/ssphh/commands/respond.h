#pragma once
/// `ssphh respond`: lamps or doors change at once, and a method follows frame by frame.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>

#include "options/scene_options.h"

namespace ssphh::app {

using pipeline::MethodFigures;

struct RespondOptions {
  SceneOptions scene;
  std::string method = "ssphh";         ///< of methods::all_methods()
  std::vector<std::string> parameters;  ///< of the method, each as "NAME=VALUE"
  /// What changes, each as "NAME=BEFORE:AFTER"; none: the scene's animations go from start to end.
  std::vector<std::string> events;
  int before = 1;           ///< frames before the event, over 0
  int frames = 60;          ///< frames after it, over 0
  int points = 512;         ///< surface points to compare at, over 0
  float clearance = 0.05f;  ///< only points with so much free space before them [m]
  std::uint64_t seed = 0;   ///< of points and paths
  /// Of the truth; its seed is not read.
  study::LeakParams truth{.path = {.max_depth = rays::usual_max_depth, .passes = 1, .spp = 1024, .seed = 0}};
  std::string output;  ///< CSV file of the frames; empty: none
};

/// A frame after the event.
struct RespondFrame {
  double ms = 0;  ///< of the method's update
  study::LookupError error;
};

/// All errors are against path tracing of the scene after the event.
struct RespondResult {
  std::vector<rays::SurfacePoint> points;
  study::LookupError stale;          ///< of the light of before
  double before_ms = 0;              ///< of the last update before the event
  std::vector<RespondFrame> frames;  ///< none is missing
  MethodFigures method;              ///< after the last frame
};

/// Makes the method, plays the event, and writes the frames where they are to be kept. Throws Error where
/// nothing changes or there are no frames, for a scene that cannot be read and a file that cannot be
/// written, for unknown methods, parameters and names of events, and as study::reachable_points and
/// study::trace_truth do; Cancelled when asked to stop.
RespondResult run_respond(const RespondOptions& options, const Control& control = {});

/// Frames until the error is, and stays, as good as the last frame's: within a tenth of it or half a per
/// cent. `frames` is not empty.
int frames_to_settle(const std::vector<RespondFrame>& frames);

json::Value to_json(const RespondResult& result, const RespondOptions& options);
std::string to_text(const RespondResult& result, const RespondOptions& options);

}  // namespace ssphh::app
