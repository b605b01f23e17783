#include "commands/bake_update.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/log.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::app {
namespace {

using probes::VizMethod;

constexpr const char* in_full = "bake it in full: leave out --update";

void require_updatable(const std::string& file, const probes::ProbeSet& old, std::uint64_t seed) {
  const probes::GeneratorInfo& g = old.generator;
  if (g.op != probes::LightOperator::path)
    throw Error(
        file, fmt::format("its light is of --operator {}, which an update cannot do in part", name_of(g.op)),
        in_full);
  if (!old.baseline) throw Error(file, "has no baseline to compare the scene with", in_full);
  if (old.surface) throw Error(file, "holds surface records, which an update cannot find in part", in_full);
  if (seed != 0 && seed != g.seed)
    throw Error(fmt::format("--seed {}", seed),
                fmt::format("{} was baked with seed {}, and an update bakes as it was baked", file, g.seed),
                "leave out --seed, or --update");
}

/// Places stay in an update, so what the scene says of them must be what it said.
void require_same_places(const std::string& file, const probes::ProbeSet& old, const scene::Scene& scene) {
  for (const scene::SphlPlace& place : scene::sphl_places(scene, old.generator.time)) {
    const bool known = std::ranges::any_of(old.probes, [&](const probes::Probe& probe) {
      return probe.name == place.name && probe.position == place.position && probe.radius == place.radius;
    });
    if (!known)
      throw Error(fmt::format("SPHL \"{}\"", place.name),
                  fmt::format("has moved since {} was baked, or is new: an update keeps all places", file),
                  in_full);
  }
}

bake::BakeParams params_of(const probes::ProbeSet& old) {
  const probes::GeneratorInfo& g = old.generator;
  bake::BakeParams params;
  params.gen = g.gen;
  params.path = {g.max_depth, g.passes, g.spp, g.seed};
  params.face_size = g.face_size;
  params.viz_params = {std::ranges::any_of(old.probes,
                                           [](const probes::Probe& probe) {
                                             return std::ranges::any_of(probe.edges,
                                                                        [](const probes::Edge& edge) {
                                                                          return !edge.matrix.values.empty();
                                                                        });
                                           }),
                       old.baseline->viz_neighbors, old.baseline->viz_threshold};
  return params;
}

/// Probes whose edges by links are found anew. Networks of nearly the same scene have other surfels: their
/// edges differ by some 5 % in any case, so that smaller changes are not worth a network unless asked for.
std::vector<std::uint32_t> probes_for_links(const bake::UpdatePlan& plan, std::optional<float> asked) {
  constexpr float link_noise = 0.05f;
  std::vector<std::uint32_t> which;
  for (const std::uint32_t i : plan.probes) {
    if (asked || plan.changed[i] > link_noise) which.push_back(i);
  }
  return which;
}

void fit_anew(const trace::TransportScene& source, BakeResult& result, const Control& control) {
  const probes::GeneratorInfo& g = result.set.generator;
  bake::TransportBakeParams params;
  params.transport.directions = g.directions;
  params.transport.surfel_size = g.surfel_size;
  params.transport.link_rays = g.link_rays;
  params.fit = true;
  bake::TransportBakeReport report;
  bake::add_transport(source, result.set, params, report, control);
  report.viz_seconds += result.transport.viz_seconds;
  report.rays += result.transport.rays;
  result.transport = std::move(report);
}

std::string change_text(const scene::ChangedItem& item) {
  std::vector<std::string_view> changes;
  for (const scene::ItemChange change : item.changes) changes.push_back(name_of(change));
  return fmt::format("{} \"{}\" ({})", name_of(item.kind), item.name, fmt::join(changes, ", "));
}

/// At most a few of them by name.
std::string changes_text(const std::vector<scene::ChangedItem>& changed) {
  if (changed.empty()) return "nothing";
  constexpr std::size_t most = 6;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(changed.size(), most); ++i) texts.push_back(change_text(changed[i]));
  if (changed.size() > most) texts.push_back(fmt::format("and {} more", changed.size() - most));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

void run_bake_update(const BakeOptions& options, BakeResult& result, const Control& control) {
  if (!options.not_of_update.empty())
    throw Error(options.not_of_update.front(), "an update bakes as the file of --update was baked",
                "leave it out, or leave out --update");
  if (options.viz && *options.viz != VizMethod::none)
    throw Error(fmt::format("--viz {}", name_of(*options.viz)),
                "an update finds edges as the file of --update was baked",
                "leave it out, or keep all edges as they were with --viz off");
  const std::optional<FarmSession> session = farm_session(options.farm);
  probes::ProbeSet& set = result.set;
  set = probes::read_probe_file(options.update);
  require_updatable(options.update, set, options.seed);
  SceneOptions scene_options = options.scene;
  scene_options.time = set.generator.time;
  const scene::Scene scene = load_lit_scene(scene_options);
  require_same_places(options.update, set, scene);

  BakeUpdate& update = result.update.emplace();
  std::vector<scene::SceneItem> items = scene::scene_items(scene, set.generator.time);
  update.changed = scene::changed_items(set.baseline->items, items);
  set.generator.scene = scene.name.substr(0, probes::limits::text);
  set.generator.scene_hash = scene::light_hash(scene);
  result.viz = set.generator.viz;
  if (update.changed.empty()) return;
  log_info("changed since {}: {}", options.update, changes_text(update.changed));

  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::PathTracer tracer(geometry, scene, set.generator.time);
  bake::adopt_groups(set, tracer.light_groups());
  update.plan = bake::plan_update(tracer, set, options.tolerance, control);
  const std::vector<std::uint32_t>& which = update.plan.probes;
  log_info("{} of {} probes have changed by more than {:.2g} % of their light", which.size(),
           set.probes.size(), 100 * update.plan.tolerance);

  const bool edges = !options.viz && scene::bodies_changed(update.changed);
  bake::BakeParams params = params_of(set);
  params.viz = edges && set.generator.viz == VizMethod::path;
  params.only = which;
  if (!which.empty()) {
    const std::filesystem::path checkpoint = options.output + ".checkpoint";
    if (!options.resume) std::filesystem::remove(checkpoint);
    std::optional<farm::FarmCrew> crew;
    if (session) crew.emplace(session->options(), scene, set.generator.time);
    set = bake::bake(tracer, std::move(set), params, checkpoint, result.paths, control,
                     crew ? &*crew : nullptr);
    if (crew) result.farm = crew->report();
  }
  const trace::TransportScene source(geometry, scene);
  if (edges && set.generator.viz == VizMethod::links) {
    transport::LinkVizParams viz;
    viz.neighbors = set.baseline->viz_neighbors;
    viz.threshold = set.baseline->viz_threshold;
    bake::update_edges(source, set, probes_for_links(update.plan, options.tolerance), viz, result.transport,
                       control);
  }
  if (set.fitted) fit_anew(source, result, control);
  bake::renew_baseline(set, update.plan, std::move(items));
}

json::Value update_json(const BakeUpdate& update, const BakeOptions& options) {
  json::Value changed = json::Value::array();
  for (const scene::ChangedItem& item : update.changed) {
    json::Value changes = json::Value::array();
    for (const scene::ItemChange change : item.changes) changes.push_back(name_of(change));
    changed.push_back({{"kind", name_of(item.kind)}, {"name", item.name}, {"changes", changes}});
  }
  json::Value baked = json::Value::array();
  for (const std::uint32_t i : update.plan.probes) baked.push_back(i);
  json::Value shares = json::Value::array();
  for (const float share : update.plan.changed) shares.push_back(share);
  return {{"from", options.update},
          {"changed", changed},
          {"probes", baked},
          {"changed_shares", shares},
          {"tolerance", update.plan.tolerance},
          {"noise", update.plan.noise},
          {"comparing_seconds", update.plan.seconds}};
}

std::string update_text(const BakeUpdate& update, const BakeOptions& options) {
  std::string text = fmt::format("changed since {}: {}", options.update, changes_text(update.changed));
  if (update.changed.empty()) return text + "; all probes were kept";
  const bake::UpdatePlan& plan = update.plan;
  return text + fmt::format(
                    "\n{} of {} probes were baked anew; the light of the others has changed by less "
                    "than {:.2g} % and was kept (the bake's own noise: {:.2g} %); compared in {:.2f} s",
                    plan.probes.size(), plan.changed.size(), 100 * plan.tolerance, 100 * plan.noise,
                    plan.seconds);
}

}  // namespace ssphh::app
