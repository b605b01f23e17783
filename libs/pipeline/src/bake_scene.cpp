#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/log.h>
#include <ssphh/core/memory.h>
#include <ssphh/core/require.h>
#include <ssphh/core/require_named.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::pipeline {
namespace {

using probes::VizMethod;

std::filesystem::path tiles_of(const std::filesystem::path& checkpoint) {
  return checkpoint.string() + ".tiles";
}

void refuse(const std::vector<std::string>& given, const char* needs) {
  if (!given.empty()) throw Error(given.front(), needs);
}

probes::LightOperator operator_of(const BakeSettings& o, std::size_t probes, bool farm) {
  if (o.op) return *o.op;
  const bool asked = !o.of_paths.empty() || farm || o.params.gen != probes::GenMode::full;
  if (asked || probes <= most_probes_for_paths) return probes::LightOperator::path;
  log_info(
      "{} probes are lit by transport between surfels, in seconds: --operator path traces paths from each",
      probes);
  return probes::LightOperator::surfel;
}

/// A furnished flat has so many probes, for which the usual records are enough; a town has more of both.
constexpr double probes_of_a_flat = 150;

/// Records hold every bounce, so there are none unasked beside probes that are to hold fewer, unless light
/// that is baked must be kept somewhere.
int records_of(const BakeSettings& o, std::size_t probes, bool keeps_asked) {
  const bool every_bounce = o.op == probes::LightOperator::surfel ||
                            (o.op == probes::LightOperator::path && o.params.gen == probes::GenMode::full &&
                             o.params.path.max_depth >= rays::usual_max_depth);
  if (!every_bounce && !keeps_asked) return 0;
  const double flats = std::clamp(static_cast<double>(probes) / probes_of_a_flat, 1.0, double{most_flats});
  const double most = std::max<double>(o.usual_records, transport::most_records);
  return static_cast<int>(std::min(flats * o.usual_records, most));
}

/// Whether one network need not serve all probes.
bool in_tiles(const BakeSettings& o) {
  return o.op != probes::LightOperator::bounce && !o.transport.fit;
}

/// Decides on VIZ, which it returns, and refuses options that would have no effect. `keeps_asked`: the scene
/// asks to keep a group's direct light.
probes::VizMethod resolve(BakeSettings& o, std::size_t probes, std::size_t tiles, bool farm,
                          bool keeps_asked) {
  const probes::LightOperator op = *o.op;
  const bool path = op == probes::LightOperator::path, transfer = o.params.viz_params.matrix;
  bake::BakeParams& params = o.params;
  if (!o.viz) {
    o.viz = transfer || (path && probes <= most_probes_for_paths) ? VizMethod::path
            : probes <= most_probes_for_links                     ? VizMethod::links
                                                                  : VizMethod::none;
    if (o.viz == VizMethod::none)
      log_info("VIZ is left out for more than {} probes: --viz links if HIER is to run",
               most_probes_for_links);
  }
  if (transfer && o.viz != VizMethod::path)
    throw Error("--viz-transfer", "needs VIZ by path tracing", "use --viz path");
  if (!path && params.gen != probes::GenMode::full)
    throw Error(fmt::format("--gen {}", name_of(params.gen)),
                "is of --operator path; the light of surfels has every bounce");
  params.keep_light = !path;
  if (!path) o.transport.op = op;
  params.viz = o.viz == VizMethod::path;
  params.viz_params.neighbors = o.neighbors.value_or(-1);
  params.viz_params.threshold = o.threshold;
  params.viz_params.source = o.viz_source;
  params.viz_path = {o.viz_max_depth.value_or(params.path.max_depth),
                     o.viz_passes.value_or(params.path.passes), o.viz_spp.value_or(params.path.spp),
                     params.path.seed};
  o.transport.records.points = o.records.value_or(records_of(o, probes / tiles, keeps_asked));
  if (o.transport.records.points == 0 && keeps_asked)
    throw Error("--records 0", "leaves no place for the light of groups that are baked",
                "leave it out, or bake no group's direct light: --light-mode GROUP=mixed");
  o.transport.viz = o.viz == VizMethod::links;
  o.transport.viz_params.neighbors = o.neighbors.value_or(default_link_neighbors);
  o.transport.viz_params.threshold = o.threshold;
  o.transport.viz_params.source = o.viz_source;
  const bool transport = o.transport.fit || o.transport.viz || o.transport.records.points > 0;
  if (!path && !params.viz) refuse(o.of_paths, "is of path tracing: use --operator path or --viz path");
  if (path && !transport)
    refuse(o.of_transport, "is of transport: use --operator surfel, bounce, --viz links, --records or --fit");
  if (o.viz == VizMethod::none) refuse(o.of_viz, "is of VIZ: use --viz links or path");
  if (o.viz != VizMethod::path) refuse(o.of_viz_paths, "is of VIZ by path tracing: use --viz path");
  require_work_for(farm, op, params.viz);
  return *o.viz;
}

/// Keeps surfels within memory; whether that makes fewer of them than there might be.
bool fit_into_memory(BakeSettings& o) {
  transport::TransportParams& params = o.transport.transport;
  const auto bytes =
      o.max_memory > 0 ? static_cast<std::uint64_t>(o.max_memory * 1e9) : memory_of_machine() / 2;
  const int most = bake::surfels_within(bytes, params.link_rays);
  if (most >= params.most_surfels) return false;
  params.most_surfels = most;
  return true;
}

/// By transport, as settings that are resolved ask for.
void transport(SceneBake& result, const BakeSettings& o, std::span<const probes::Tile> tiles,
               const trace::TransportScene& source, const scene::Scene& scene,
               const std::filesystem::path& checkpoint, bake::TileCrew* crew, const Control& control) {
  const bool path = o.op == probes::LightOperator::path;
  bake::TiledParams params{o.transport, path};
  if (!o.tiles.empty()) {
    const auto modes = bake::light_modes(scene, o.transport.records.points > 0);
    params.finish = [&source, modes](probes::ProbeSet& tile) {
      bake::set_light_modes(source, tile, modes, {});
    };
    probes::TileFolder folder(o.tiles, bake::tiled_key(source, result.set, tiles, params),
                              {tiles.begin(), tiles.end()});
    bake::transport_into_folder(source, result.set, tiles, params, folder, result.transport, control, crew);
    result.set.light_groups = folder.read(0).light_groups;
    return;
  }
  if (tiles.size() > 1) {
    std::optional<probes::TileFolder> folder;
    if (!checkpoint.empty())
      folder.emplace(tiles_of(checkpoint), bake::tiled_key(source, result.set, tiles, params),
                     std::vector(tiles.begin(), tiles.end()));
    bake::transport_in_tiles(source, result.set, tiles, params, folder ? &*folder : nullptr, result.transport,
                             control, crew);
  } else if (path) {
    bake::add_transport(source, result.set, o.transport, result.transport, control);
  } else {
    result.set = bake::bake_transport(source, std::move(result.set), o.transport, result.transport, control);
  }
}

/// Fills the result's set, which INIT made, by settings that are resolved.
void fill(SceneBake& result, const BakeSettings& o, std::span<const probes::Tile> tiles,
          const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
          const std::filesystem::path& checkpoint, bake::BakeCrew* crew, bake::TileCrew* tile_crew,
          const Control& control) {
  const bool path = o.op == probes::LightOperator::path;
  const bool links = o.transport.viz;
  probes::Baseline baseline{links ? o.transport.viz_params.neighbors : o.params.viz_params.neighbors,
                            links ? o.transport.viz_params.threshold : o.params.viz_params.threshold,
                            o.transport.records.points,
                            o.transport.transport.most_surfels,
                            scene::scene_items(scene, time),
                            {}};
  if (!path || o.transport.fit || o.transport.viz || o.transport.records.points > 0) {
    transport(result, o, tiles, trace::TransportScene(geometry, scene), scene, checkpoint, tile_crew,
              control);
    if (!o.tiles.empty()) return;
  }
  if (path || o.params.viz) {
    const trace::PathTracer tracer(geometry, scene, time);
    result.set = bake::bake(tracer, std::move(result.set), o.params, checkpoint, result.paths, control, crew);
    if (path) baseline.trials = bake::make_trials(tracer, result.set, control);
  }
  result.set.baseline = std::move(baseline);
  const std::vector<scene::LightMode> modes = bake::light_modes(scene, result.set.surface.has_value());
  bake::set_light_modes(trace::TransportScene(geometry, scene), result.set, modes, control);
}

}  // namespace

void set_effort(BakeSettings& settings, bake::Quality quality) {
  const bake::Effort effort = bake::effort_of(quality);
  transport::TransportParams& params = settings.transport.transport;
  settings.params.path.spp = effort.spp;
  params.directions = effort.directions;
  params.link_rays = effort.link_rays;
  params.surfels_per_radius = effort.surfels_per_radius;
  params.most_surfels = effort.most_surfels;
  settings.usual_records = effort.records;
}

BakeSettings::BakeSettings() {
  set_effort(*this, bake::Quality::good);
}

void require_work_for(bool farm, probes::LightOperator op, bool viz_by_path) {
  if (farm && op != probes::LightOperator::path && !viz_by_path)
    throw Error(fmt::format("--operator {}", name_of(op)),
                "is done here, in seconds; a farm does GEN and VIZ by path tracing, and scenes in tiles",
                "leave out --broker and --local");
}

SceneBake bake_scene(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
                     const PlaceOptions& places, const BakeSettings& settings,
                     const std::filesystem::path& checkpoint, const Control& control, bake::BakeCrew* crew,
                     bake::TileCrew* tile_crew) {
  require(!(settings.max_memory < 0) && std::isfinite(settings.max_memory), "memory of a bake",
          "must be gigabytes, or 0 for half of the machine's");
  require(settings.records.value_or(0) >= 0 && settings.usual_records >= 0, "records of a bake",
          "fewer than 0 surface points");
  if (settings.op) require_named("light operator", *settings.op);
  if (settings.viz) require_named("VIZ method", *settings.viz);
  require_named("source of VIZ", settings.viz_source);
  BakeSettings o = settings;
  o.params.path.seed = o.seed;
  SceneBake result;
  warn_about_lamps(geometry, scene, time);
  result.place = place_for(geometry, scene, time, places, "", control);
  result.set = result.place ? place::init_from_placement(scene, result.place->placement, o.degree, time)
                            : place::init_from_scene(scene, o.degree, time);
  for (const std::string& line : bake::blurred_shadows(scene)) log_warning("{}", line);
  const bool keeps_asked = std::ranges::any_of(
      scene.light_modes, [](const scene::GroupMode& asked) { return scene::keeps_direct(asked.mode); });
  o.op = operator_of(o, result.set.probes.size(), crew != nullptr);
  if (!o.tiles.empty() && o.op != probes::LightOperator::surfel)
    throw Error(o.tiles.string(), fmt::format("light by operator {} is not baked in tiles", name_of(*o.op)),
                "use --operator surfel, or write a .sphl file");
  if (!o.tiles.empty() && o.transport.fit)
    throw Error(o.tiles.string(), "weights are not fitted in tiles",
                "leave out --fit, or write a .sphl file");
  if (o.tiles.empty() && result.set.probes.size() > probes::limits::probes)
    throw Error(fmt::format("{} probes", result.set.probes.size()),
                fmt::format("are more than the {} of a probe file", probes::limits::probes),
                "write a folder of tiles: -o NAME.tiles");
  const std::vector<probes::Tile> tiles = bake::make_tiles(
      result.set, in_tiles(o) ? o.most_probes_in_tile : std::max<std::size_t>(result.set.probes.size(), 1));
  if (tiles.size() > 1) log_info("{} probes are lit in {} tiles", result.set.probes.size(), tiles.size());
  const bool tiles_for_crew = tile_crew && (tiles.size() > 1 || !o.tiles.empty());
  result.viz = resolve(o, result.set.probes.size(), tiles.size(), crew && !tiles_for_crew, keeps_asked);
  o.transport.records.baked = bake::baked_indices(bake::light_modes(scene, o.transport.records.points > 0));

  const bool limited = fit_into_memory(o);
  fill(result, o, tiles, geometry, scene, time, checkpoint, crew, tile_crew, control);
  bake::TransportBakeReport& t = result.transport;
  if (limited && t.coarsest_surfel > t.finest_surfel) {
    t.warnings.push_back(
        fmt::format("surfels grow to {:.3g} m, to stay within memory: more --max-memory or fewer --link-rays "
                    "leave them small",
                    t.coarsest_surfel));
    log_warning("{}", t.warnings.back());
  }
  return result;
}

void remove_checkpoint(const std::filesystem::path& checkpoint) {
  std::filesystem::remove(checkpoint);
  if (const std::filesystem::path tiles = tiles_of(checkpoint); std::filesystem::exists(tiles / "tiles.json"))
    probes::TileFolder(tiles).remove();
}

probes::ProbeSet bake_surfaces(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
                               bake::Quality quality, std::uint64_t seed, const Control& control) {
  BakeSettings settings;
  set_effort(settings, quality);
  settings.op = probes::LightOperator::surfel;
  settings.viz = probes::VizMethod::none;
  settings.seed = seed;
  return bake_scene(geometry, scene, time, {}, settings, {}, control).set;
}

}  // namespace ssphh::pipeline
