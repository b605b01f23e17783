#pragma once
/// `ssphh bake`: the light at every SPHL of a scene and between them, as a probe file.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/effort.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/control.h>
#include <ssphh/core/files_read.h>
#include <ssphh/core/json.h>
#include <ssphh/scene/scene_items.h>
#include <ssphh/trace/scene_geometry.h>

#include "commands/bake_only.h"
#include "options/farm_options.h"
#include "options/place_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

/// Where neither is given: light and VIZ by paths up to so many probes, then by surfels and their links, VIZ
/// up to so many. A probe takes half a second by paths and a hundredth by surfels, VIZ a pass over all probes
/// for each; nobody waits long for that unasked.
inline constexpr std::size_t most_probes_for_paths = 64, most_probes_for_links = 512;
/// Edges of a probe that VIZ by links keeps unless told otherwise: 1.2 kB each at degree 9.
inline constexpr int default_link_neighbors = 16;

struct BakeOptions {
  BakeOptions();  ///< of quality `good`

  SceneOptions scene;
  PlaceOptions place;
  FarmChoice farm;     ///< that does GEN and VIZ by paths, if there is any
  std::string output;  ///< probe file to write: .sphl or .sphl.json; OUTPUT.checkpoint beside it
  /// What finds the probes' light; none given: path for few probes, with a farm, and with options of path
  /// tracing, else surfel.
  std::optional<probes::LightOperator> op;
  /// What finds the edges; none given: what suits the operator and the number of probes.
  std::optional<probes::VizMethod> viz;
  int degree = 9;  ///< highest band of the probes' functions, 0..10
  std::uint64_t seed = 0;
  /// GEN and VIZ by paths. Its seed, keep_light, viz and viz_path are not read, nor are the neighbours, the
  /// threshold and the source of VIZ: they follow from the other options.
  bake::BakeParams params;
  /// Of transport; its operator, viz and number of records are not read either, nor the same of its VIZ.
  bake::TransportBakeParams transport;
  std::optional<int> neighbors;  ///< most edges of a probe, strongest first; -1: all
  /// Surface points that keep light; none given: usual_records where probes hold every bounce, too, or a
  /// light group is baked, else 0.
  std::optional<int> records;
  int usual_records = transport::usual_records;
  double max_memory = 0;  ///< that surfels and their links may take [GB]; 0: half of the machine's
  float threshold = 0;    ///< only edges with P above it, from 0 up
  probes::VizSource viz_source = probes::VizSource::intensity;  ///< of VIZ by paths and by links
  std::optional<int> viz_max_depth, viz_passes, viz_spp;        ///< of VIZ by paths; none: as of GEN
  bool resume = true;  ///< go on where OUTPUT.checkpoint of an interrupted bake ends
  /// Names of options that were given and stand only with path tracing, transport, VIZ or VIZ by paths: they
  /// are refused where these have nothing to do.
  std::vector<std::string> of_paths, of_transport, of_viz, of_viz_paths;
  /// Probe file of an earlier bake, of which is kept what the scene's changes do not reach; empty: none. The
  /// parameters of the bake are that file's.
  std::string update;
  std::optional<float> tolerance;  ///< of an update: share of light, plan_update()
  BakeOnly only;                   ///< of an update: what is baked by hand
  /// Names of options that were given and stand only without an update.
  std::vector<std::string> not_of_update;
  bool watch = false;   ///< go on with updates whenever the scene's files are saved
  std::string preview;  ///< of a watch: picture to draw of each bake; empty: none
};

/// What an update found.
struct BakeUpdate {
  std::vector<scene::ChangedItem> changed;                 ///< none: nothing was compared
  probes::LightOperator op = probes::LightOperator::path;  ///< what finds the light
  bake::UpdatePlan plan;  ///< of light by transport: what has changed, probes whose bits have
};

struct BakeResult {
  probes::ProbeSet set;                             ///< as it was written
  probes::VizMethod viz = probes::VizMethod::none;  ///< what found the edges
  bake::BakeReport paths;                           ///< of GEN and VIZ by paths
  bake::TransportBakeReport transport;              ///< of transport, VIZ by links and the fit
  std::optional<farm::FarmReport> farm;             ///< of a farm that was asked and had anything to do
  std::optional<PlaceResult> place;                 ///< where places were looked for
  std::optional<BakeUpdate> update;                 ///< where there was one
  std::uint64_t geometry_builds = 0;                ///< acceleration structures that were built
};

/// Options as `quality` has them.
void set_effort(BakeOptions& options, bake::Quality quality);

/// Throws Error where a farm is asked for and this bake has nothing for it.
void require_work_for(const FarmChoice& farm, probes::LightOperator op, bool viz_by_path);

/// Bakes and writes the probe file. Warns in the log as its parts do. Throws Error for scenes that cannot be
/// read, options that exclude each other, files that cannot be written, a farm that cannot be reached, and as
/// place::place_probes, bake::bake and bake::bake_transport do; Cancelled when asked to stop, which leaves
/// OUTPUT.checkpoint for the next call with the same options.
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
