#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/gi/leak.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "commands/live_method.h"
#include "commands/relight_animation.h"
#include "options/method_options.h"
#include "options/probe_options.h"
#include "options/scene_options.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

struct RespondOptions {
  SceneOptions scene;
  std::string method = "ssphh", output;
  std::vector<std::string> parameters, events;
  int frames = 60, before = 1, points = 512;
  float clearance = 0.05f;
  gi::LeakParams truth{.path = {.max_depth = 25, .passes = 1, .spp = 1024, .seed = 0}};
};

/// A frame after the event.
struct Frame {
  double ms;
  gi::LookupError error;
};

/// Frames until the error is, and stays, as good as the last frame's: within a tenth of it or half a per
/// cent.
int frames_to_settle(const std::vector<Frame>& frames) {
  const double last = frames.back().error.mean_error;
  const double bound = std::max(1.1 * last, last + 0.005);
  int settled = static_cast<int>(frames.size());
  while (settled > 1 && frames[static_cast<std::size_t>(settled) - 2].error.mean_error <= bound) --settled;
  return settled;
}

std::string csv_text(const std::vector<Frame>& frames) {
  std::string text = "frame,ms,ratio,mean_error,p95_relative,relmse\n";
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const gi::LookupError& e = frames[f].error;
    text += fmt::format("{},{:.4f},{:.6g},{:.6g},{:.6g},{:.6g}\n", f + 1, frames[f].ms, e.ratio, e.mean_error,
                        e.p95_relative, e.relmse);
  }
  return text;
}

void respond(Context& context, RespondOptions& o) {
  const scene::Scene scene = load_scene(o.scene);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::TransportScene surfaces(geometry, scene);
  const RelightAnimation event(surfaces, scene, o.scene.time, o.events);
  const scene::LightingState before = event.frame(0), after = event.frame(1);
  if (before == after) throw Error("--event", "nothing changes", "give two different keys, as in time=0:1");
  LiveMethod live(o.method, o.parameters, geometry, scene, context.control);

  const scene::Scene lit = scene::with_lighting(scene, after);
  const trace::PathTracer tracer(geometry, lit, after.time);
  o.truth.path.seed = context.seed;
  const std::vector<scene::SurfacePoint> points =
      gi::reachable_points(surfaces, viewpoints(scene, {}, after.time), after.time,
                           {o.points, context.seed, o.clearance}, context.control);
  const gi::TruthAtPoints truth = gi::trace_truth(tracer, points, o.truth, context.control);

  for (int f = 0; f < o.before; ++f) live.update(before, context.control);
  const double first_ms = 1e3 * live.update_seconds();
  const gi::LookupError stale =
      gi::lookup_error(gi::look_up(live.method().light(), points, context.control), truth.estimates);
  std::vector<Frame> frames;
  {
    ProgressStage progress(context.control, "responding", static_cast<std::uint64_t>(o.frames), "frames");
    for (int f = 0; f < o.frames; ++f) {
      context.control.check();
      live.update(after, context.control);
      const std::vector<vec3> found = gi::look_up(live.method().light(), points, context.control);
      frames.push_back({1e3 * live.update_seconds(), gi::lookup_error(found, truth.estimates)});
      progress.advance(1);
    }
  }

  std::vector<double> ms;
  json::Value list = json::Value::array();
  for (const Frame& frame : frames) {
    ms.push_back(frame.ms);
    list.push_back({{"ms", frame.ms}, {"ratio", frame.error.ratio}, {"mean_error", frame.error.mean_error}});
  }
  const double median_ms = percentile(ms, 0.5);
  const int settled = frames_to_settle(frames);
  if (!o.output.empty()) write_file(o.output, csv_text(frames));

  const gi::LookupError& last = frames.back().error;
  json::Value object = {{"method", o.method},
                        {"points", points.size()},
                        {"noise", last.noise},
                        {"before_error", stale.mean_error},
                        {"first_error", frames.front().error.mean_error},
                        {"last_error", last.mean_error},
                        {"last_ratio", last.ratio},
                        {"frames_to_settle", settled},
                        {"first_ms", frames.front().ms},
                        {"median_ms", median_ms},
                        {"before_ms", first_ms}};
  object.update(live.json());
  object["frames"] = std::move(list);
  context.result(
      object,
      fmt::format("{}: {}\nmean error at {} points: {:.1f} % with the light of before, {:.1f} % after one "
                  "frame, {:.1f} % after {} (ratio {:.3f})\nsettled after {} frame{}, {:.3g} ms a frame "
                  "(the first {:.3g})",
                  o.method, live.text(), points.size(), 100 * stale.mean_error,
                  100 * frames.front().error.mean_error, 100 * last.mean_error, o.frames, last.ratio, settled,
                  settled == 1 ? "" : "s", median_ms, frames.front().ms));
}

}  // namespace

void add_respond_command(Command app, Context& context) {
  auto options = std::make_shared<RespondOptions>();
  RespondOptions& o = *options;
  Command command =
      add_command(app, context, "respond", "Change lamps or doors at once and see how fast a method follows",
                  [&context, options] { respond(context, *options); });
  add_scene_options(command, o.scene);
  std::vector<std::string> names;
  for (const gi::MethodEntry& entry : gi::method_table()) names.emplace_back(entry.name);
  command.option("--method", o.method, "Method; `ssphh methods` tells of each").one_of(names);
  add_method_parameters(command, o.parameters);
  command
      .option("--event", o.events,
              "What changes, NAME=BEFORE:AFTER with the names of `relight --animate`: time (doors), "
              "LIGHT.position, LIGHT.intensity, GROUP.scale ...; may be repeated. Default: time=0:END "
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
  command.footer("Errors as of `ssphh measure`, against path tracing of the scene after the event.");
}

}  // namespace ssphh::app
