#pragma once
/// A bake of a scene from nothing: places, light, edges, records, with whatever nobody asked for decided as
/// suits the scene.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/effort.h>
#include <ssphh/bake/tiled_transport.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/control.h>
#include <ssphh/pipeline/places.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::pipeline {

/// Where neither is given: light and VIZ by paths up to so many probes, then by surfels and their links, VIZ
/// up to so many. A probe takes half a second by paths and a hundredth by surfels, VIZ a pass over all probes
/// for each; nobody waits long for that unasked.
inline constexpr std::size_t most_probes_for_paths = 64, most_probes_for_links = 512;
/// Edges of a probe that VIZ by links keeps unless told otherwise: 1.2 kB each at degree 9.
inline constexpr int default_link_neighbors = 16;

/// Records take their time: a town gets no more than so many times as many as a flat.
inline constexpr int most_flats = 2;

struct BakeSettings {
  BakeSettings();  ///< of quality `good`

  /// What finds the probes' light; none given: path for few probes, with a farm, and with options of path
  /// tracing, else surfel.
  std::optional<probes::LightOperator> op;
  /// What finds the edges; none given: what suits the operator and the number of probes.
  std::optional<probes::VizMethod> viz;
  int degree = 9;  ///< highest band of the probes' functions, 0..10
  std::uint64_t seed = 0;
  /// GEN and VIZ by paths. Its seed, keep_light, viz and viz_path are not read, nor are the neighbours, the
  /// threshold and the source of VIZ: they follow from the other settings.
  bake::BakeParams params;
  /// How light is found by transport; its operator, viz and number of records are not read either, nor the
  /// same of its VIZ.
  bake::TransportBakeParams transport;
  std::optional<int> neighbors;  ///< most edges of a probe, strongest first; -1: all
  /// Surface points that keep light; none given: usual_records where probes hold every bounce, too, or a
  /// light group is baked, else 0.
  std::optional<int> records;
  /// For as many as 150 probes, a furnished flat's; in proportion for more, up to most_flats times as many
  /// and transport::most_records. Of a scene in tiles each gets as many.
  int usual_records = transport::usual_records;
  /// More probes than that are lit in tiles, by networks of their own; but not with fitted weights, nor by
  /// `bounce`, which need one network of all.
  std::size_t most_probes_in_tile = bake::most_probes_in_tile;
  /// Folder of tiles to write, *.tiles (probes::TileFolder): the result has probes without light, and memory
  /// holds one tile at a time. Empty: none.
  std::filesystem::path tiles;
  double max_memory = 0;  ///< that surfels and their links may take [GB]; 0: half of the machine's
  float threshold = 0;    ///< only edges with P above it, from 0 up
  probes::VizSource viz_source = probes::VizSource::intensity;  ///< of VIZ by paths and by links
  std::optional<int> viz_max_depth, viz_passes, viz_spp;        ///< of VIZ by paths; none: as of GEN
  /// Names of options that were given and stand only with path tracing, transport, VIZ or VIZ by paths: they
  /// are refused where these have nothing to do.
  std::vector<std::string> of_paths, of_transport, of_viz, of_viz_paths;
};

/// Settings as `quality` has them.
void set_effort(BakeSettings& settings, bake::Quality quality);

/// Throws Error where a farm is there and this bake has nothing for it.
void require_work_for(bool farm, probes::LightOperator op, bool viz_by_path);

/// What a bake made and took.
struct SceneBake {
  probes::ProbeSet set;
  probes::VizMethod viz = probes::VizMethod::none;  ///< what found the edges
  bake::BakeReport paths;                           ///< of GEN and VIZ by paths
  bake::TransportBakeReport transport;              ///< of transport, VIZ by links and the fit
  std::optional<PlaceResult> place;                 ///< where places were looked for
};

/// Finds places in the scene posed at `time`, and the light there. A farm's `crew` does GEN and VIZ by paths,
/// its `tile_crew` the tiles of a scene in tiles.
/// Warns in the log as its parts do. Throws Error for settings that exclude each other, and as
/// place::place_probes, bake::bake and bake::bake_transport do; Cancelled when asked to stop, which leaves
/// `checkpoint`, and of a scene in tiles CHECKPOINT.tiles beside it, for the next call with the same
/// arguments (bake::bake tells of it).
SceneBake bake_scene(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
                     const PlaceOptions& places, const BakeSettings& settings,
                     const std::filesystem::path& checkpoint, const Control& control = {},
                     bake::BakeCrew* crew = nullptr, bake::TileCrew* tile_crew = nullptr);

/// Removes what a bake left, once its result is safe.
void remove_checkpoint(const std::filesystem::path& checkpoint);

/// The same with places found by themselves and light by surfels, kept in records of surfaces, without VIZ:
/// for what is made of light at surfaces.
probes::ProbeSet bake_surfaces(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
                               bake::Quality quality, std::uint64_t seed, const Control& control = {});

}  // namespace ssphh::pipeline
