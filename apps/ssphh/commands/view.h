#pragma once
/// `ssphh view`: a scene lit by probes, in a window.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

#include "options/farm_options.h"
#include "options/scene_options.h"
#include "viewer.h"

namespace ssphh::app {

struct ViewOptions {
  SceneOptions scene;  ///< its source may be empty: a window that waits for a file to be dropped
  /// The viewer's own. Source, time, load, width, height, panels, farm are not read: they are those of the
  /// others.
  viewer::ViewerOptions viewer;
  std::string tev;  ///< "HOST:PORT" of a tev that shows pictures, each pass of a truth too; empty:
                    ///< pictures alone, where tev listens by itself
  FarmChoice farm;  ///< that does GEN and VIZ, if there is any
  std::vector<std::string> values;  ///< of viewer::setting_names(), in its order; empty ones: as they are
  std::string size = "1440x810";    ///< of the window, as "WIDTHxHEIGHT": 64 to 16384 pixels each
  bool no_panels = false;           ///< the picture alone
};

/// Opens the window and returns when it is closed or all that the options ask for is done. Throws Error for a
/// size that is written otherwise, a farm that cannot be started and as viewer::run_viewer() does; Cancelled
/// when asked to stop.
viewer::ViewerReport run_view(const ViewOptions& options, const Control& control = {});

json::Value to_json(const viewer::ViewerReport& report, const ViewOptions& options);
std::string to_text(const viewer::ViewerReport& report, const ViewOptions& options);

}  // namespace ssphh::app
