#pragma once
/// `ssphh bake`: the light at every SPHL of a scene and between them, as a probe file.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/bake/update.h>
#include <ssphh/core/control.h>
#include <ssphh/core/files_read.h>
#include <ssphh/core/json.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/scene/scene_items.h>
#include <ssphh/trace/scene_geometry.h>

#include "commands/bake_only.h"
#include "commands/cycles.h"
#include "options/farm_options.h"
#include "options/place_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

/// What the bake is to be, and where from and to.
struct BakeOptions : pipeline::BakeSettings {
  SceneOptions scene;
  PlaceOptions place;
  FarmChoice farm;     ///< that does GEN and VIZ by paths, if there is any
  std::string output;  ///< probe file to write: .sphl or .sphl.json; OUTPUT.checkpoint beside it
  Renderer renderer = Renderer::path;  ///< that does GEN and VIZ by paths
  int threads = 0;                     ///< of Cycles; 0: all
  int time_limit = 3600;               ///< seconds that each run of Cycles may take
  bool resume = true;                  ///< go on where OUTPUT.checkpoint of an interrupted bake ends
  /// Probe file of an earlier bake, of which is kept what the scene's changes do not reach; empty: none. The
  /// parameters of the bake are that file's.
  std::string update;
  std::optional<float> tolerance;  ///< of an update: share of light, plan_update()
  BakeOnly only;                   ///< of an update: what is baked by hand
  /// Names of options that were given and stand only without an update.
  std::vector<std::string> not_of_update;
  bool watch = false;   ///< go on with updates whenever the scene's files are saved
  std::string preview;  ///< of a watch: picture to draw of each bake; empty: none
  std::string tev;      ///< of a watch: "HOST:PORT" of a tev that shows the picture; empty: none
};

/// What an update found.
struct BakeUpdate {
  std::vector<scene::ChangedItem> changed;                 ///< none: nothing was compared
  probes::LightOperator op = probes::LightOperator::path;  ///< what finds the light
  bake::UpdatePlan plan;  ///< of light by transport: what has changed, probes whose bits have
};

/// The set is as it was written.
struct BakeResult : pipeline::SceneBake {
  std::optional<farm::FarmReport> farm;  ///< of a farm that was asked and had anything to do
  std::optional<BakeUpdate> update;      ///< where there was one
  std::uint64_t geometry_builds = 0;     ///< acceleration structures that were built
};

/// Bakes and writes the probe file. Warns in the log as its parts do. Throws Error for scenes that cannot be
/// read, options that exclude each other, files that cannot be written, a farm that cannot be reached, and as
/// pipeline::bake_scene does; Cancelled when asked to stop, which leaves OUTPUT.checkpoint for the next call
/// with the same options.
BakeResult run_bake(const BakeOptions& options, const Control& control = {});

/// A scene and its probes, as somebody who watches a bake may look at them.
struct SeenLight {
  const trace::SharedGeometry& geometry;
  const scene::Scene& scene;
  const probes::ProbeSet& set;
  bool done;  ///< false: with the light that an update begins with
};

/// Who watches a bake.
struct BakeWatcher {
  std::vector<FileStamp> files;               ///< that the scene was read from; also where it throws
  std::function<void(const SeenLight&)> see;  ///< none: nobody looks
};

/// run_bake() under somebody's eyes.
BakeResult run_bake_watched(const BakeOptions& options, BakeWatcher& watcher, const Control& control);

json::Value to_json(const BakeResult& result, const BakeOptions& options);
std::string to_text(const BakeResult& result, const BakeOptions& options);

}  // namespace ssphh::app
