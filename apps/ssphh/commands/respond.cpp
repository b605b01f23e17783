#include "commands/respond.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/file.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "commands/relight_animation.h"
#include "options/method_options.h"
#include "options/probe_options.h"
#include "results/lookup_figures.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

std::string csv_text(const std::vector<RespondFrame>& frames) {
  std::string text = "frame,ms,ratio_r,ratio_g,ratio_b,mean_error,p95_relative,relmse,chromaticity\n";
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const study::LookupError& e = frames[f].error;
    const study::RelativeError worst = study::worst_channel(e);
    text += fmt::format("{},{:.4f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", f + 1, frames[f].ms,
                        e.channels[0].ratio, e.channels[1].ratio, e.channels[2].ratio, worst.mean_error,
                        worst.p95_relative, worst.relmse, e.chromaticity.mean_error);
  }
  return text;
}

/// Of the worst channel.
double mean_error(const study::LookupError& error) {
  return study::worst_channel(error).mean_error;
}

double median_ms(const std::vector<RespondFrame>& frames) {
  std::vector<double> ms;
  for (const RespondFrame& frame : frames) ms.push_back(frame.ms);
  return percentile(std::move(ms), 0.5);
}

}  // namespace

int frames_to_settle(const std::vector<RespondFrame>& frames) {
  const double last = mean_error(frames.back().error);
  const double bound = std::max(1.1 * last, last + 0.005);
  int settled = static_cast<int>(frames.size());
  while (settled > 1 && mean_error(frames[static_cast<std::size_t>(settled) - 2].error) <= bound) --settled;
  return settled;
}

RespondResult run_respond(const RespondOptions& o, const Control& control) {
  if (o.frames < 1 || o.before < 1) throw Error("respond", "needs a frame before and one after the event");
  std::vector<std::string> events = o.events;
  const scene::Scene scene = load_lit_scene(at_start_of_day(o.scene, events));
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::TransportScene surfaces(geometry, scene);
  const RelightAnimation event(surfaces, scene, o.scene.time, events);
  const scene::LightingState before = event.frame(0), after = event.frame(1);
  if (before == after) throw Error("--event", "nothing changes", "give two different keys, as in time=0:1");
  pipeline::LiveMethod live(o.method, o.parameters, geometry, scene, control);

  const scene::Scene lit = scene::with_lighting(scene, after);
  const trace::PathTracer tracer(geometry, lit, after.time);
  study::LeakParams params = o.truth;
  params.path.seed = o.seed;
  RespondResult result;
  result.points = study::reachable_points(surfaces, viewpoints(scene, surfaces, {}, after.time), after.time,
                                          {o.points, o.seed, o.clearance}, control);
  const study::TruthAtPoints truth = study::trace_truth(tracer, result.points, params, control);
  const auto error_now = [&] {
    return study::lookup_error(study::look_up(live.method().light(), result.points, control),
                               truth.estimates);
  };

  for (int f = 0; f < o.before; ++f) live.update(before, control);
  result.before_ms = 1e3 * live.update_seconds();
  result.stale = error_now();
  {
    ProgressStage progress(control, "responding", static_cast<std::uint64_t>(o.frames), "frames");
    for (int f = 0; f < o.frames; ++f) {
      control.check();
      live.update(after, control);
      result.frames.push_back({1e3 * live.update_seconds(), error_now()});
      progress.advance(1);
    }
  }
  result.method = live.figures();
  if (!o.output.empty()) write_file(o.output, csv_text(result.frames));
  return result;
}

json::Value to_json(const RespondResult& result, const RespondOptions& o) {
  const RespondFrame &first = result.frames.front(), &last = result.frames.back();
  json::Value object = {{"method", o.method},
                        {"points", result.points.size()},
                        {"before_error", mean_error(result.stale)},
                        {"first_error", mean_error(first.error)},
                        {"last_error", mean_error(last.error)},
                        {"frames_to_settle", frames_to_settle(result.frames)},
                        {"first_ms", first.ms},
                        {"median_ms", median_ms(result.frames)},
                        {"before_ms", result.before_ms}};
  object.update(to_json(result.method));
  json::Value& list = object["frames"] = json::Value::array();
  for (const RespondFrame& frame : result.frames) {
    json::Value one = {{"ms", frame.ms}};
    one.update(to_json(frame.error));
    list.push_back(std::move(one));
  }
  return object;
}

std::string to_text(const RespondResult& result, const RespondOptions& o) {
  const RespondFrame &first = result.frames.front(), &last = result.frames.back();
  const int settled = frames_to_settle(result.frames);
  return fmt::format(
      "{}: {}\nmean error at {} points: {:.1f} % with the light of before, {:.1f} % after one "
      "frame, {:.1f} % after {} (ratio{})\nsettled after {}, {:.3g} ms a frame "
      "(the first {:.3g})",
      o.method, to_text(result.method), result.points.size(), 100 * mean_error(result.stale),
      100 * mean_error(first.error), 100 * mean_error(last.error), o.frames, ratio_columns(last.error),
      counted(settled, "frame"), median_ms(result.frames), first.ms);
}

void add_respond_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "respond", "Change lamps or doors at once and see how fast a method follows",
                  run_respond);
  add_scene_options(command, o.scene);
  std::vector<std::string> names;
  for (const methods::MethodEntry& entry : methods::all_methods()) names.emplace_back(entry.name);
  command.option("--method", o.method, "Method; `ssphh methods` tells of each").one_of(names);
  add_method_parameters(command, o.parameters);
  command
      .option("--event", o.events,
              "What changes, NAME=BEFORE:AFTER with the names of `relight --animate`: time (doors), "
              "LIGHT.position, LIGHT.intensity, GROUP.scale, time-of-day ...; may be repeated. Default: "
              "time=0:END "
              "if the scene has animations")
      .repeatable();
  command.option("--frames", o.frames, "Frames after the event").range(1, 1 << 20);
  command.option("--before", o.before, "Frames before it").range(1, 1 << 20);
  command.option("--points", o.points, "Points to compare at, uniform by area over what can be reached")
      .range(1, 1 << 24);
  command.option("--truth-spp", o.truth.path.spp, "Paths per point of the truth").range(2, 1 << 22);
  command.option("--max-depth", o.truth.path.max_depth, "Scattering events of the truth's paths")
      .range(2, 1000);
  command.option("-o,--output", o.output, "Also write every frame here, as CSV");
  command.footer(
      "Errors as of `ssphh measure`, of the worst channel, against path tracing of the scene after the "
      "event.");
}

}  // namespace ssphh::app
