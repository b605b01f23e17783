#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/log.h>
#include <ssphh/core/memory.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/bake.h"
#include "commands/bake_update.h"
#include "results/geometry_builds.h"

namespace ssphh::app {
namespace {

using probes::VizMethod;

void refuse(const std::vector<std::string>& given, const char* needs) {
  if (!given.empty()) throw Error(given.front(), needs);
}

probes::LightOperator operator_of(const BakeOptions& o, std::size_t probes) {
  if (o.op) return *o.op;
  const bool asked = !o.of_paths.empty() || o.farm.any() || o.params.gen != probes::GenMode::full;
  if (asked || probes <= most_probes_for_paths) return probes::LightOperator::path;
  log_info(
      "{} probes are lit by transport between surfels, in seconds: --operator path traces paths from each",
      probes);
  return probes::LightOperator::surfel;
}

/// Records hold every bounce, so there are none unasked beside probes that are to hold fewer, unless light
/// that is baked must be kept somewhere.
int records_of(const BakeOptions& o) {
  const bool every_bounce = o.op == probes::LightOperator::surfel ||
                            (o.op == probes::LightOperator::path && o.params.gen == probes::GenMode::full &&
                             o.params.path.max_depth >= rays::usual_max_depth);
  return every_bounce || !o.transport.records.baked.empty() ? o.usual_records : 0;
}

/// Decides on VIZ, which it returns, and refuses options that would have no effect.
probes::VizMethod resolve(BakeOptions& o, std::size_t probes) {
  const probes::LightOperator op = operator_of(o, probes);
  o.op = op;
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
  o.transport.records.points = o.records.value_or(records_of(o));
  if (o.transport.records.points == 0 && !o.transport.records.baked.empty())
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
  require_work_for(o.farm, op, params.viz);
  return *o.viz;
}

/// Keeps surfels within memory; whether that makes fewer of them than there might be.
bool fit_into_memory(BakeOptions& o) {
  transport::TransportParams& params = o.transport.transport;
  const auto bytes =
      o.max_memory > 0 ? static_cast<std::uint64_t>(o.max_memory * 1e9) : memory_of_machine() / 2;
  const int most = bake::surfels_within(bytes, params.link_rays);
  if (most >= params.most_surfels) return false;
  params.most_surfels = most;
  return true;
}

/// Fills the result's set, which INIT made, by options that are resolved.
void fill(BakeResult& result, const BakeOptions& o, const trace::SharedGeometry& geometry,
          const scene::Scene& scene, const std::filesystem::path& checkpoint, const FarmSession* session,
          const Control& control) {
  const bool path = o.op == probes::LightOperator::path;
  const bool links = o.transport.viz;
  probes::Baseline baseline{links ? o.transport.viz_params.neighbors : o.params.viz_params.neighbors,
                            links ? o.transport.viz_params.threshold : o.params.viz_params.threshold,
                            o.transport.records.points,
                            o.transport.transport.most_surfels,
                            scene::scene_items(scene, o.scene.time),
                            {}};
  if (!path || o.transport.fit || o.transport.viz || o.transport.records.points > 0) {
    const trace::TransportScene source(geometry, scene);
    if (path) {
      bake::add_transport(source, result.set, o.transport, result.transport, control);
    } else {
      result.set =
          bake::bake_transport(source, std::move(result.set), o.transport, result.transport, control);
    }
  }
  if (path || o.params.viz) {
    const trace::PathTracer tracer(geometry, scene, o.scene.time);
    std::optional<farm::FarmCrew> crew;
    if (session) crew.emplace(session->options(), scene, o.scene.time);
    result.set = bake::bake(tracer, std::move(result.set), o.params, checkpoint, result.paths, control,
                            crew ? &*crew : nullptr);
    if (crew) result.farm = crew->report();
    if (path) baseline.trials = bake::make_trials(tracer, result.set, control);
  }
  result.set.baseline = std::move(baseline);
  const std::vector<scene::LightMode> modes = scene::light_modes(scene);
  bake::set_light_modes(trace::TransportScene(geometry, scene), result.set, modes, control);
}

double viz_seconds(const BakeResult& r) {
  return r.paths.viz_seconds + r.transport.viz_seconds;
}

/// Finds places and fills the set, where nothing is taken from an earlier bake.
void run_full_bake(const BakeOptions& options, BakeResult& result, BakeWatcher& watcher,
                   const Control& control) {
  BakeOptions o = options;
  const std::optional<FarmSession> session = farm_session(o.farm);
  const scene::Scene scene = load_lit_scene(o.scene, watcher.files);
  o.params.path.seed = o.seed;
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  result.place = place_for(geometry, scene, o.scene.time, o.place, "", control);
  result.set = result.place
                   ? place::init_from_placement(scene, result.place->placement, o.degree, o.scene.time)
                   : place::init_from_scene(scene, o.degree, o.scene.time);
  o.transport.records.baked = bake::baked_indices(scene::light_modes(scene));
  for (const std::string& line : bake::blurred_shadows(scene)) log_warning("{}", line);
  result.viz = resolve(o, result.set.probes.size());

  const bool limited = fit_into_memory(o);
  const std::filesystem::path checkpoint = o.output + ".checkpoint";
  if (!o.resume) std::filesystem::remove(checkpoint);
  fill(result, o, geometry, scene, checkpoint, session ? &*session : nullptr, control);
  bake::TransportBakeReport& t = result.transport;
  if (limited && t.coarsest_surfel > t.finest_surfel) {
    t.warnings.push_back(
        fmt::format("surfels grow to {:.3g} m, to stay within memory: more --max-memory or fewer --link-rays "
                    "leave them small",
                    t.coarsest_surfel));
    log_warning("{}", t.warnings.back());
  }
  if (watcher.see) watcher.see({geometry, scene, result.set, true});
}

}  // namespace

void set_effort(BakeOptions& options, bake::Quality quality) {
  const bake::Effort effort = bake::effort_of(quality);
  transport::TransportParams& params = options.transport.transport;
  options.params.path.spp = effort.spp;
  params.directions = effort.directions;
  params.link_rays = effort.link_rays;
  params.surfels_per_radius = effort.surfels_per_radius;
  params.most_surfels = effort.most_surfels;
  options.usual_records = effort.records;
}

BakeOptions::BakeOptions() {
  set_effort(*this, bake::Quality::good);
}

void require_work_for(const FarmChoice& farm, probes::LightOperator op, bool viz_by_path) {
  if (farm.any() && op != probes::LightOperator::path && !viz_by_path)
    throw Error(fmt::format("--operator {}", name_of(op)),
                "is done here, in seconds; a farm does GEN and VIZ by path tracing",
                "leave out --broker and --local");
}

BakeResult run_bake(const BakeOptions& options, const Control& control) {
  BakeWatcher nobody;
  return run_bake_watched(options, nobody, control);
}

BakeResult run_bake_watched(const BakeOptions& options, BakeWatcher& watcher, const Control& control) {
  const GeometryBuilds builds;
  if (options.tolerance && options.update.empty() && !options.watch)
    throw Error("--tolerance", "is of an update", "give --update FILE, too");
  if (options.only.any() && options.update.empty())
    throw Error("--only-probes, --only-box and --only-lights",
                "are of an update: the rest is taken from its file", "give --update FILE, too");
  BakeResult result;
  if (options.update.empty()) {
    run_full_bake(options, result, watcher, control);
  } else {
    run_bake_update(options, result, watcher, control);
  }
  probes::write_probe_file(result.set, options.output);
  std::filesystem::remove(options.output + ".checkpoint");
  result.geometry_builds = builds.count();
  return result;
}

/// Numbers of transport are null where there was none; `iterations` also where only weights were fitted.
json::Value to_json(const BakeResult& r, const BakeOptions& o) {
  const bake::TransportBakeReport& t = r.transport;
  const auto if_any = [](bool any, const auto& value) { return any ? json::Value(value) : json::Value(); };
  const probes::LightOperator op = r.set.generator.op;
  const bool solved = op != probes::LightOperator::path, network = t.surfels > 0;
  std::vector<std::string> warnings = t.warnings;
  for (const std::string& warning : r.paths.warnings) {
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
  }
  json::Value object = {{"output", o.output},
                        {"operator", name_of(op)},
                        {"probes", r.set.probes.size()},
                        {"degree", r.set.degree},
                        {"light_groups", r.set.light_groups.size()},
                        {"baked_groups", probes::baked_groups(r.set)},
                        {"edges", probes::edge_count(r.set)},
                        {"gen", name_of(r.set.generator.gen)},
                        {"gen_seconds", r.paths.gen_seconds},
                        {"viz_seconds", viz_seconds(r)},
                        {"transport_seconds", if_any(solved, t.seconds)},
                        {"surfels", if_any(network, t.surfels)},
                        {"links", if_any(network, t.links)},
                        {"iterations", if_any(solved, t.iterations)},
                        {"contraction", if_any(network, t.contraction)},
                        {"fitted", r.set.fitted ? r.set.fitted->points.size() : 0},
                        {"fit_seconds", if_any(r.set.fitted.has_value(), t.fit_seconds)},
                        {"records", r.set.surface ? r.set.surface->points.size() : 0},
                        {"record_seconds", if_any(r.set.surface.has_value(), t.record_seconds)},
                        {"rays", r.paths.rays + t.rays},
                        {"resumed", r.paths.resumed},
                        {"viz", r.viz == VizMethod::none ? "off" : name_of(r.viz)},
                        {"warnings", warnings},
                        {"geometry_builds", r.geometry_builds}};
  if (r.farm) object["farm"] = farm_json(*r.farm);
  if (r.place) object["placement"] = place_json(*r.place);
  if (r.update) object["update"] = update_json(*r.update, o);
  return object;
}

std::string sizes_text(float finest, float coarsest) {
  if (finest == coarsest) return fmt::format("{:.3g} m", finest);
  return fmt::format("{:.3g} to {:.3g} m", finest, coarsest);
}

std::string to_text(const BakeResult& r, const BakeOptions& o) {
  std::string text =
      fmt::format("{}: {} probes of degree {}, {} light groups, {} edges", o.output, r.set.probes.size(),
                  r.set.degree, r.set.light_groups.size(), probes::edge_count(r.set));
  const bake::TransportBakeReport& t = r.transport;
  const bool path = r.set.generator.op == probes::LightOperator::path;
  if (t.surfels > 0) {
    text += fmt::format("\n{} surfels of {}, {} links", t.surfels,
                        sizes_text(t.finest_surfel, t.coarsest_surfel), t.links);
    if (!path) {
      text += fmt::format("; {} iterations, a bounce keeps at most {:.3g} of the light; {:.2f} s",
                          t.iterations, t.contraction, t.seconds);
    }
  }
  if (r.set.surface && t.record_seconds > 0)
    text += fmt::format("\nlight kept at {} surface points in {:.2f} s", r.set.surface->points.size(),
                        t.record_seconds);
  if (const std::vector<std::string> baked = probes::baked_groups(r.set); !baked.empty())
    text += fmt::format("\ndirect light kept, too, of {}", fmt::join(baked, ", "));
  if (r.set.fitted && t.fit_seconds > 0)
    text +=
        fmt::format("\nweights fitted at {} points in {:.2f} s", r.set.fitted->points.size(), t.fit_seconds);
  if (path) text += fmt::format("\nGEN {:.2f} s", r.paths.gen_seconds);
  if (r.viz != VizMethod::none)
    text +=
        fmt::format("\nVIZ from {} {:.2f} s", r.viz == VizMethod::path ? "paths" : "links", viz_seconds(r));
  text += fmt::format("\n{} rays", r.paths.rays + t.rays);
  if (r.farm) text += "\n" + farm_text(*r.farm);
  if (r.paths.resumed > 0) {
    const std::size_t stages = std::size_t{path} + (r.viz == VizMethod::path);
    text += fmt::format("\n{} of {} steps were taken from the checkpoint", r.paths.resumed,
                        r.set.probes.size() * stages);
  }
  if (r.place) text += "\n" + place_text(*r.place);
  if (r.update) text += "\n" + update_text(*r.update, o);
  return text;
}

}  // namespace ssphh::app
