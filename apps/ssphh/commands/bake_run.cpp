#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/probes/probe_file.h>

#include "commands/bake.h"
#include "commands/bake_update.h"
#include "results/geometry_builds.h"

namespace ssphh::app {
namespace {

using probes::VizMethod;

double viz_seconds(const BakeResult& r) {
  return r.paths.viz_seconds + r.transport.viz_seconds;
}

/// Of Cycles within its folder, where no bake by our paths finds it.
std::filesystem::path checkpoint_of(const BakeOptions& o) {
  return o.output + (o.renderer == Renderer::cycles ? ".cycles/checkpoint" : ".checkpoint");
}

/// Where nothing is taken from an earlier bake.
void run_full_bake(const BakeOptions& o, BakeResult& result, BakeWatcher& watcher, const Control& control) {
  const bool by_cycles = o.renderer == Renderer::cycles;
  FarmChoice choice = o.farm;
  choice.renderer = o.renderer;
  const std::optional<FarmSession> session = farm_session(choice);
  const scene::Scene scene = load_lit_scene(o.scene, watcher.files);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  std::optional<farm::FarmCrew> farm;
  if (session) farm.emplace(session->options(), scene, o.scene.time);
  std::optional<CyclesCrew> cycles;
  pipeline::BakeSettings settings = o;
  if (probes::is_tile_folder(o.output)) settings.tiles = o.output;
  if (by_cycles && !session) {
    cycles.emplace(geometry, scene, o.scene.time,
                   CyclesOptions{o.output + ".cycles", o.threads, std::chrono::seconds(o.time_limit)});
  }
  if (by_cycles) {
    std::filesystem::create_directories(o.output + ".cycles");
    if (!settings.records) settings.records = 0;  // they would hold our light
  }
  const std::filesystem::path checkpoint = checkpoint_of(o);
  if (!o.resume) pipeline::remove_checkpoint(checkpoint);
  pipeline::SceneBake& baked = result;
  bake::BakeCrew* const crew = farm ? static_cast<bake::BakeCrew*>(&*farm) : cycles ? &*cycles : nullptr;
  baked = pipeline::bake_scene(geometry, scene, o.scene.time, o.place, settings, checkpoint, control, crew,
                               farm ? &*farm : nullptr);
  if (farm) result.farm = farm->report();
  if (by_cycles) result.set.baseline.reset();  // an update would go on with our light
  if (watcher.see) watcher.see({geometry, scene, result.set, true});
}

}  // namespace

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
  if (probes::is_tile_folder(options.output) && (options.watch || !options.update.empty()))
    throw Error(options.output, "tiles are not updated", "write a .sphl file, or bake them anew");
  if (options.update.empty()) {
    run_full_bake(options, result, watcher, control);
  } else {
    run_bake_update(options, result, watcher, control);
  }
  if (!probes::is_tile_folder(options.output)) probes::write_probe_file(result.set, options.output);
  pipeline::remove_checkpoint(checkpoint_of(options));
  result.geometry_builds = builds.count();
  return result;
}

namespace {

/// Whose direct light records keep.
std::vector<std::string> kept_groups(const probes::ProbeSet& set) {
  std::vector<std::string> groups = probes::baked_groups(set), mirrored = probes::mirrored_groups(set);
  groups.insert(groups.end(), mirrored.begin(), mirrored.end());
  return groups;
}

}  // namespace

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
                        {"baked_groups", kept_groups(r.set)},
                        {"edges", probes::edge_count(r.set)},
                        {"gen", name_of(r.set.generator.gen)},
                        {"gen_seconds", r.paths.gen_seconds},
                        {"viz_seconds", viz_seconds(r)},
                        {"transport_seconds", if_any(solved, t.seconds)},
                        {"tiles", t.tiles},
                        {"surfels", if_any(network, t.surfels)},
                        {"links", if_any(network, t.links)},
                        {"iterations", if_any(solved, t.iterations)},
                        {"contraction", if_any(network, t.contraction)},
                        {"solve_error", if_any(op == probes::LightOperator::surfel, t.error)},
                        {"fitted", r.set.fitted ? r.set.fitted->points.size() : 0},
                        {"fit_seconds", if_any(r.set.fitted.has_value(), t.fit_seconds)},
                        {"records", r.set.surface ? r.set.surface->points.size() : t.records},
                        {"record_seconds", if_any(r.set.surface || t.records > 0, t.record_seconds)},
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
  std::string text = fmt::format(
      "{}: {} of degree {}, {}, {}", o.output, counted(r.set.probes.size(), "probe"), r.set.degree,
      counted(r.set.light_groups.size(), "light group"), counted(probes::edge_count(r.set), "edge"));
  const bake::TransportBakeReport& t = r.transport;
  const bool path = r.set.generator.op == probes::LightOperator::path;
  if (t.tiles > 1) text += fmt::format("\n{} tiles", t.tiles);
  if (t.resumed > 0) text += fmt::format(", {} of them taken from an earlier run", t.resumed);
  if (t.surfels > 0) {
    text += fmt::format("\n{} of {}, {}", counted(t.surfels, "surfel"),
                        sizes_text(t.finest_surfel, t.coarsest_surfel), counted(t.links, "link"));
    if (!path) {
      text += fmt::format("; {}, a bounce keeps at most {:.3g} of the light",
                          counted(t.iterations, "iteration"), t.contraction);
      if (t.error > 0) text += fmt::format(", {:.2g} % are missing at most", 100 * t.error);
      text += fmt::format("; {:.2f} s", t.seconds);
    }
  }
  if (t.records > 0)
    text += fmt::format("\nlight kept at {} in {:.2f} s",
                        counted(r.set.surface ? r.set.surface->points.size() : t.records, "surface point"),
                        t.record_seconds);
  if (const std::vector<std::string> baked = kept_groups(r.set); !baked.empty())
    text += fmt::format("\ndirect light kept, too, of {}", fmt::join(baked, ", "));
  if (r.set.fitted && t.fit_seconds > 0)
    text += fmt::format("\nweights fitted at {} in {:.2f} s", counted(r.set.fitted->points.size(), "point"),
                        t.fit_seconds);
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
