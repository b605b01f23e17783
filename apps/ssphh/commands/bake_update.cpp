#include "commands/bake_update.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/bake/light_modes.h>
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
  if (!old.baseline) throw Error(file, "has no baseline to compare the scene with", in_full);
  if (seed != 0 && seed != g.seed)
    throw Error(fmt::format("--seed {}", seed),
                fmt::format("{} was baked with seed {}, and an update bakes as it was baked", file, g.seed),
                "leave out --seed, or --update");
}

/// Places stay in an update, so what the scene says of them must be what it said.
void require_same_places(const std::string& file, const probes::ProbeSet& old, const scene::Scene& scene) {
  for (const scene::ProbePlace& place : scene::sphl_places(scene, old.generator.time)) {
    const bool known = std::ranges::any_of(old.probes, [&](const probes::Probe& probe) {
      return probe.name == place.name && probe.position == place.position && probe.radius == place.radius;
    });
    if (!known)
      throw Error(fmt::format("SPHL \"{}\"", place.name),
                  fmt::format("has moved since {} was baked, or is new: an update keeps all places", file),
                  in_full);
  }
}

/// The scene's groups: those that the set knows keep their modes where the scene leaves them open.
void adopt_groups(probes::ProbeSet& set, const scene::Scene& scene) {
  const std::vector<probes::LightGroup> before = set.light_groups;
  bake::adopt_groups(set, scene::light_groups(scene));
  const std::vector<scene::LightMode> asked = bake::light_modes(scene, set.surface.has_value());
  for (std::size_t g = 0; g < asked.size(); ++g) {
    probes::LightGroup& group = set.light_groups[g];
    const auto known = std::ranges::find(before, group.name, &probes::LightGroup::name);
    group.mode =
        known == before.end() ? asked[g] : scene::asked_light_mode(scene, group.name).value_or(known->mode);
  }
}

bake::BakeParams params_of(const probes::ProbeSet& old) {
  const probes::GeneratorInfo& g = old.generator;
  bake::BakeParams params;
  params.gen = g.gen;
  params.path = bake::path_of(g, bake::BakeStage::gen);
  params.viz_path = bake::path_of(g, bake::BakeStage::viz);
  params.face_size = g.face_size;
  params.viz_params = {std::ranges::any_of(old.probes,
                                           [](const probes::Probe& probe) {
                                             return std::ranges::any_of(probe.edges,
                                                                        [](const probes::Edge& edge) {
                                                                          return !edge.matrix.values.empty();
                                                                        });
                                           }),
                       old.baseline->viz_neighbors, old.baseline->viz_threshold, g.viz_source, g.viz_paths};
  return params;
}

/// Networks of nearly the same scene have other surfels: their edges differ by as much in any case, so that
/// smaller changes of a probe's light are not worth new ones unless asked for.
constexpr float link_noise = 0.05f;

/// Probes whose edges by links are found anew.
std::vector<std::uint32_t> probes_for_links(const bake::UpdatePlan& plan, const BakeOptions& o) {
  std::vector<std::uint32_t> which;
  for (const std::uint32_t i : plan.probes) {
    if (o.tolerance || o.only.any() || plan.changed[i] > link_noise) which.push_back(i);
  }
  return which;
}

std::string change_text(const scene::ChangedItem& item) {
  std::vector<std::string_view> changes;
  for (const scene::ItemChange change : item.changes) changes.push_back(name_of(change));
  return fmt::format("{} \"{}\" ({})", name_of(item.kind), item.name, fmt::join(changes, ", "));
}

/// What an update works on.
struct Update {
  const BakeOptions& options;
  const scene::Scene& scene;
  trace::SharedGeometry geometry;
  bake::LightScope scope;
  bool edges;  ///< are found anew as far as they are stale
  const FarmSession* session;
  BakeResult& result;
  const Control& control;

  /// GEN and VIZ by paths of some probes.
  void bake(const trace::PathTracer& tracer, bake::BakeParams params) const {
    probes::ProbeSet& set = result.set;
    const std::filesystem::path checkpoint = options.output + ".checkpoint";
    if (!options.resume) std::filesystem::remove(checkpoint);
    std::optional<farm::FarmCrew> crew;
    if (session) crew.emplace(session->options(), scene, set.generator.time);
    set = bake::bake(tracer, std::move(set), params, checkpoint, result.paths, control,
                     crew ? &*crew : nullptr);
    if (crew) result.farm = crew->report();
  }

  /// Where light is path traced.
  void by_paths(const trace::PathTracer& tracer) const {
    probes::ProbeSet& set = result.set;
    bake::UpdatePlan& plan = result.update->plan;
    plan = bake::plan_update(tracer, set, options.tolerance, scope, control);
    if (!scope.probes)
      log_info("{} of {} probes have changed by more than {:.2g} % of their light", plan.probes.size(),
               set.probes.size(), 100 * plan.tolerance);
    bake::TransportBakeParams transport = bake::transport_params_of(set);
    bake::BakeParams params = params_of(set);
    params.viz = edges && set.generator.viz == VizMethod::path;
    params.only = plan.probes;
    params.only_groups = scope.groups;
    if (!plan.probes.empty()) bake(tracer, params);
    transport.viz = transport.viz && edges;
    transport.fit = transport.fit && !options.only.any();
    bake::add_transport(trace::TransportScene(geometry, scene), set, transport, result.transport, control,
                        {scope, probes_for_links(plan, options)});
    probes::merge_groups(set);
    bake::renew_trials(set, plan);
  }

  /// Where it is found by transport.
  void by_transport(const trace::PathTracer& tracer) const {
    probes::ProbeSet& set = result.set;
    bake::TransportBakeParams params = bake::transport_params_of(set);
    params.viz = params.viz && edges;
    params.fit = params.fit && !options.only.any();
    const float edge_change = options.tolerance.value_or(link_noise);
    bake::TransportUpdate found =
        bake::update_in_tiles(trace::TransportScene(geometry, scene), set, params, bake::most_probes_in_tile,
                              scope, edge_change, result.transport, control);
    if (edges && set.generator.viz == VizMethod::path) {
      bake::BakeParams viz = params_of(set);
      viz.keep_light = true;
      viz.only.emplace();
      for (std::uint32_t i = 0; i < found.changed.size(); ++i)
        if (found.changed[i] > edge_change) viz.only->push_back(i);
      if (!viz.only->empty()) bake(tracer, viz);
    }
    bake::UpdatePlan& plan = result.update->plan;
    plan.probes = std::move(found.probes);
    plan.changed = std::move(found.changed);
    plan.seconds = 0;
  }
};

}  // namespace

void run_bake_update(const BakeOptions& options, BakeResult& result, BakeWatcher& watcher,
                     const Control& control) {
  if (!options.not_of_update.empty())
    throw Error(options.not_of_update.front(), "an update bakes as the file of --update was baked",
                "leave it out, or leave out --update");
  if (options.viz && *options.viz != VizMethod::none)
    throw Error(fmt::format("--viz {}", name_of(*options.viz)),
                "an update finds edges as the file of --update was baked",
                "leave it out, or keep all edges as they were with --viz off");
  probes::ProbeSet& set = result.set;
  set = probes::read_probe_file(options.update);
  require_updatable(options.update, set, options.seed);
  const bool path = set.generator.op == probes::LightOperator::path;
  pipeline::require_work_for(options.farm.any(), set.generator.op, set.generator.viz == VizMethod::path);
  const std::optional<FarmSession> session = farm_session(options.farm);
  SceneOptions scene_options = options.scene;
  scene_options.time = set.generator.time;
  const scene::Scene scene = load_lit_scene(scene_options, watcher.files);
  require_same_places(options.update, set, scene);
  if (const std::string modes = bake::mode_difference(set, scene); !modes.empty())
    throw Error(options.update, "was baked with " + modes, in_full);

  BakeUpdate& update = result.update.emplace();
  update.op = set.generator.op;
  std::vector<scene::SceneItem> items = scene::scene_items(scene, set.generator.time);
  update.changed = scene::changed_items(set.baseline->items, items);
  set.generator.scene = scene.name.substr(0, probes::limits::text);
  set.generator.scene_hash = scene::light_hash(scene);
  result.viz = set.generator.viz;
  adopt_groups(set, scene);
  const bake::LightScope scope = light_scope(options.only, set);
  if (update.changed.empty() && !scope.probes) return;
  log_info("changed since {}: {}", options.update, changes_text(update.changed));

  const bool bodies = scene::bodies_changed(update.changed);
  if (bodies && scope.groups)
    log_warning(
        "bodies have changed, too: light of other groups than those of --only-lights still stands where "
        "it fell before");
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::PathTracer tracer(geometry, scene, set.generator.time);
  if (watcher.see) watcher.see({geometry, scene, set, false});
  const Update work{options,
                    scene,
                    geometry,
                    scope,
                    !options.viz && !scope.groups && bodies,
                    session ? &*session : nullptr,
                    result,
                    control};
  if (path) {
    work.by_paths(tracer);
  } else {
    work.by_transport(tracer);
  }
  bake::set_light_modes(trace::TransportScene(geometry, scene), set, bake::light_modes(set), control, scope);
  if (watcher.see) watcher.see({geometry, scene, set, true});
  // What is left out by hand is still to be compared with what it was baked in
  if (!options.only.any()) set.baseline->items = std::move(items);
}

std::string changes_text(const std::vector<scene::ChangedItem>& changed) {
  if (changed.empty()) return "nothing";
  constexpr std::size_t most = 6;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(changed.size(), most); ++i) texts.push_back(change_text(changed[i]));
  if (changed.size() > most) texts.push_back(fmt::format("and {} more", changed.size() - most));
  return fmt::format("{}", fmt::join(texts, ", "));
}

json::Value changed_json(const std::vector<scene::ChangedItem>& changed) {
  json::Value list = json::Value::array();
  for (const scene::ChangedItem& item : changed) {
    json::Value changes = json::Value::array();
    for (const scene::ItemChange change : item.changes) changes.push_back(name_of(change));
    list.push_back({{"kind", name_of(item.kind)}, {"name", item.name}, {"changes", changes}});
  }
  return list;
}

json::Value update_json(const BakeUpdate& update, const BakeOptions& options) {
  json::Value baked = json::Value::array();
  for (const std::uint32_t i : update.plan.probes) baked.push_back(i);
  json::Value shares = json::Value::array();
  for (const float share : update.plan.changed) shares.push_back(share);
  return {{"from", options.update},
          {"changed", changed_json(update.changed)},
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
  if (options.only.any())
    text += fmt::format(
        "\nbaked by hand: {} of {} probes; the rest was kept, and is still to be compared by an "
        "update without --only",
        plan.probes.size(), plan.changed.size());
  else if (update.op != probes::LightOperator::path)
    text += fmt::format("\nall light was found anew: that of {} of {} probes has changed", plan.probes.size(),
                        plan.changed.size());
  else
    text += fmt::format(
        "\n{} of {} probes were baked anew; the light of the others has changed by less "
        "than {:.2g} % and was kept (the bake's own noise: {:.2g} %); compared in {:.2f} s",
        plan.probes.size(), plan.changed.size(), 100 * plan.tolerance, 100 * plan.noise, plan.seconds);
  return text;
}

}  // namespace ssphh::app
