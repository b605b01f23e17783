// Light that is path traced, GEN and VIZ: here or by a farm's workers.

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/trace/path_tracer.h>

#include "app.h"

namespace ssphh::viewer {
namespace {

/// Every probe is dark in every group, where light is still to come or only edges count.
void add_dark_groups(probes::ProbeSet& set, const std::vector<std::string>& groups) {
  for (const std::string& group : groups) set.light_groups.push_back({group, vec3(1)});
  for (probes::Probe& probe : set.probes)
    probe.groups.assign(set.light_groups.size(), {{}, sh::RadianceSh(set.degree)});
}

std::string done_text(const std::string& what, const std::optional<farm::FarmReport>& farm) {
  if (!farm) return what;
  std::string text = fmt::format("{}: {}", what, counted(farm->jobs, "job"));
  text += " of " + counted(farm->workers, "worker");
  if (farm->cached > 0)
    text += fmt::format(", {} of {} known", farm->cached, counted(farm->units, "result was", "results were"));
  if (farm->retries > 0) text += ", " + counted(farm->retries, "retry", "retries");
  return text;
}

}  // namespace

bool App::baking() const {
  const JobStatus status = job.status();
  return status.running && (status.name == "GEN" || status.name == "VIZ");
}

void App::start_gen(bool viz_only) {
  const std::vector<scene::ProbePlace> places = document.places();
  if (places.empty()) throw Error("GEN", "there are no SPHLs", "place some first");
  auto scene = std::make_shared<const scene::Scene>(document.edited());
  bake::BakeParams params = bake_params;
  bake::ProbeDone on_probe;
  // HIER multiplies edges with light band by band, so they must be of one degree.
  const int degree = viz_only && !light.empty() ? light.set().degree : 9;
  probes::ProbeSet set = place::init_from_scene(*scene, degree, document.time);
  const float time = document.time;
  if (viz_only) {
    // Edges beside whatever light there is: VIZ alone, in a set of its own.
    params.keep_light = true;
    params.viz = true;
    on_probe = [this](std::size_t i, const probes::Probe& probe) {
      job.hand_over([this, i, edges = probe.edges] { light.take_edges(i, edges); });
    };
  } else {
    on_probe = [this](std::size_t i, const probes::Probe& probe) {
      job.hand_over([this, i, probe] { light.take_probe(i, probe); });
    };
    probes::ProbeSet dark = set;
    add_dark_groups(dark, scene::light_groups(*scene));
    light.take(std::move(dark), "GEN");
  }
  baked_ = {viz_only, document.edits()};
  const farm::FarmOptions* at = farm && farm->used ? &farm->options() : nullptr;
  job.start(viz_only ? "VIZ" : "GEN",
            [this, geometry = geometry_, scene, set, params, on_probe, time, at](const Control& control) {
              const trace::PathTracer tracer(geometry, *scene, time);
              std::optional<farm::FarmCrew> crew;
              if (at) crew.emplace(*at, *scene, time);
              auto baked = std::make_shared<probes::ProbeSet>();
              for (const bake::BakeParams& pass : passes_of(params)) {
                probes::ProbeSet empty = set;
                if (pass.keep_light) add_dark_groups(empty, tracer.light_groups());
                bake::BakeReport bake_report;
                *baked = bake::bake(tracer, std::move(empty), pass, {}, bake_report, control,
                                    crew ? &*crew : nullptr, on_probe);
              }
              std::optional<farm::FarmReport> by;
              if (crew) by = crew->report();
              const double paths = paths_per_probe(params) * static_cast<double>(set.probes.size());
              return [this, baked, by, paths, keep = params.keep_light] {
                report.farm = by;
                if (keep) {
                  light.not_saved("VIZ");
                  say(done_text(fmt::format("VIZ: {} edges", probes::edge_count(*baked)), by));
                } else {
                  gen_rate_ = paths / job.status().seconds;
                  light.take(std::move(*baked), "GEN");
                  light.not_saved("GEN");
                  say(done_text("GEN is done", by));
                }
              };
            });
}

void App::bake_here() {
  farm->used = false;
  if (baking()) start_gen(baked_->viz_only);
  redraw();
}

/// The bake that runs ends where it is of what is no more, and begins anew once the edits have come to rest.
void App::stop_stale_bake() {
  if (!baking() || light.live() || same_light(baked_->edits, document.edits())) return;
  job.cancel();
  applied_.bakes_again = true;
  applied_.light_is_stale(window.seconds());
}

void App::restart_farm() {
  farm->restart();
  say("The local farm is started again; what waits there goes on.");
}

void App::take_farm_news() {
  if (const std::string now = farm->failure(); now != farm_failure_) {
    farm_failure_ = now;
    if (!now.empty())
      complain(
          fmt::format("{}. \"Start it again\" in the panel Farm does so; \"Bake here\" has this machine do "
                      "what waits.",
                      now));
  }
  const bool was_lost = farm->lost();
  if (!farm->poll()) return;
  if (open_tab == "Farm") redraw();
  if (!farm_failure_.empty()) return;
  if (farm->lost() == was_lost) return;
  if (was_lost) return say(fmt::format("{} answers again.", farm->endpoint()));
  const char* what = baking() && farm->used
                         ? "The bake waits for it and goes on when it answers; \"Bake here\" in the panel "
                           "Farm has it done by this machine."
                         : "Bakes wait until it does, unless \"at the farm\" in the panel Farm is off.";
  complain(fmt::format("The farm's broker at {} does not answer. {}", farm->endpoint(), what));
}

}  // namespace ssphh::viewer
