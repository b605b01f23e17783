#include "commands/bake_watch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>

#include "commands/bake_update.h"
#include "options/picture_options.h"
#include "results/pictures.h"
#include "results/tev.h"

namespace ssphh::app {
namespace {

using namespace std::chrono_literals;

constexpr auto glance = 100ms,
               rest = 300ms;  ///< between looks at the files; without a save, until it is over
constexpr float most_stops_off = 2;
constexpr int preview_width = 480, preview_height = 270, preview_samples = 4;

/// A small picture of the scene in the probes' light, from its first camera. The same random numbers each
/// time: what differs between two pictures of a scene is due to the probes.
class Preview {
 public:
  explicit Preview(const BakeOptions& o)
      : file_(o.preview), name_(file_.empty() ? o.output + " preview" : file_), viewer_(o.tev) {}

  bool wanted() const { return !file_.empty() || viewer_; }

  image::Image draw(const SeenLight& seen, const Control& control) {
    const trace::PathTracer tracer(seen.geometry, seen.scene, seen.set.generator.time);
    const probes::IrradianceLookup lookup(seen.set, tracer, probes::lookup_params({}, seen.set));
    trace::RenderParams params;
    params.width = preview_width, params.height = preview_height;
    params.camera = camera_of(seen.scene, "", seen.set.generator.time, seen.geometry);
    params.projection = projection_of(PictureProjection::camera, params.camera.camera);
    params.path.passes = 1, params.path.spp = preview_samples;
    trace::RenderState state;
    tracer.render_with(lookup, params, state, {nullptr, control.cancel});
    const image::Image picture = trace::resolve(state.color, state.passes_done);
    viewer_.show(name_, picture);
    if (file_.empty()) return picture;
    const float suitable = suitable_exposure(picture);
    if (std::abs(exposure_.value_or(suitable + 2 * most_stops_off) - suitable) > most_stops_off)
      exposure_ = suitable;
    write_picture(file_, picture, {.exposure = *exposure_});
    return picture;
  }

 private:
  std::string file_, name_;  ///< no file: for the viewer alone
  TevViewer viewer_;
  /// Of the picture before, as long as it serves: with one of its own for each, light that comes and goes
  /// would not show.
  std::optional<float> exposure_;
};

/// Σ |a − b| / Σ b.
double share_off(const image::Image& a, const image::Image& b) {
  const std::array<double, 3> mean = mean_radiance(b);
  const double all = (mean[0] + mean[1] + mean[2]) / 3;
  return all > 0 ? metrics::compare(b, a).mae / all : 0;
}

std::string round_text(const WatchRound& round, std::size_t probes) {
  if (round.changed.empty()) return "saved: nothing that decides the light has changed";
  std::string text =
      fmt::format("changed: {}; {} of {} probes baked, {:.3g} M rays, {:.1f} s", changes_text(round.changed),
                  round.baked, probes, 1e-6 * static_cast<double>(round.rays), round.seconds);
  if (round.was_off)
    text += fmt::format("; with the light of before the picture was {:.2g} % off", 100 * *round.was_off);
  return text;
}

/// What follows a bake: updates of what it wrote.
BakeOptions updates_of(BakeOptions options) {
  options.update = options.output;
  if (options.viz != probes::VizMethod::none) options.viz.reset();
  options.not_of_update.clear();
  return options;
}

/// What was read last, and what was read before and still may be wanted by a scene that could not be read.
std::vector<FileStamp> together(std::vector<FileStamp> files, const std::vector<FileStamp>& before) {
  for (const FileStamp& stamp : before) {
    if (std::ranges::find(files, stamp.path, &FileStamp::path) == files.end())
      files.push_back(stamp_of(stamp.path));
  }
  return files;
}

}  // namespace

bool wait_for_save(const std::vector<FileStamp>& files, const Control& control) {
  const auto now = [&] {
    std::vector<FileStamp> stamps;
    for (const FileStamp& file : files) stamps.push_back(stamp_of(file.path));
    return stamps;
  };
  std::vector<FileStamp> seen = files;
  auto since = std::chrono::steady_clock::now();
  while (!control.cancelled()) {
    const std::vector<FileStamp> stamps = now();
    if (stamps != seen) {
      seen = stamps;
      since = std::chrono::steady_clock::now();
    } else if (seen != files && std::chrono::steady_clock::now() - since >= rest) {
      return true;
    }
    std::this_thread::sleep_for(glance);
  }
  return false;
}

BakeWatch run_bake_watch(const BakeOptions& options, const Control& control) {
  const SceneOptions& scene = options.scene;
  if (scene.source.starts_with("builtin:") && scene.overlay.empty() && scene.environment.empty())
    throw Error("--watch", fmt::format("{} is no file that could be saved", scene.source));
  if (options.renderer == Renderer::cycles)
    throw Error("--renderer cycles", "is not for --watch, whose updates go on with our path tracer's light");
  BakeWatch watch;
  BakeWatcher watcher;
  Preview preview(options);
  std::optional<image::Image> before, after;
  if (preview.wanted()) {
    watcher.see = [&](const SeenLight& seen) { (seen.done ? after : before) = preview.draw(seen, control); };
  }
  watch.first = run_bake_watched(options, watcher, control);
  const BakeOptions update = updates_of(options);
  const std::size_t probes = watch.first.set.probes.size();
  const auto there = std::ranges::count_if(watcher.files, &FileStamp::exists);
  log_info("{}: {} baked; watching {}; Ctrl-C ends it", options.output, counted(probes, "probe"),
           counted(there, "file"));
  std::vector<FileStamp> files = watcher.files;
  while (wait_for_save(files, control)) {
    WatchRound round;
    const Stopwatch stopwatch;
    before.reset(), after.reset();
    try {
      const BakeResult result = run_bake_watched(update, watcher, control);
      files = watcher.files;
      round.changed = result.update->changed;
      round.baked = result.update->plan.probes.size();
      round.rays = result.paths.rays + result.transport.rays;
      round.seconds = stopwatch.seconds();
      if (before && after) round.was_off = share_off(*before, *after);
      log_info("{}: {}", options.output, round_text(round, probes));
    } catch (const Cancelled&) {
      break;
    } catch (const Error& e) {
      files = together(watcher.files, files);
      round.problem = e.what();
      log(LogLevel::error, fmt::format("{}; waiting for the next save", e.what()));
    }
    watch.rounds.push_back(std::move(round));
  }
  return watch;
}

json::Value to_json(const BakeWatch& watch, const BakeOptions& options) {
  json::Value rounds = json::Value::array();
  for (const WatchRound& round : watch.rounds) {
    rounds.push_back({{"changed", changed_json(round.changed)},
                      {"probes_baked", round.baked},
                      {"rays", round.rays},
                      {"seconds", round.seconds},
                      {"picture_was_off", round.was_off ? json::Value(*round.was_off) : json::Value()},
                      {"problem", round.problem.empty() ? json::Value() : json::Value(round.problem)}});
  }
  return {{"first", to_json(watch.first, options)}, {"rounds", rounds}};
}

std::string to_text(const BakeWatch& watch, const BakeOptions& options) {
  const auto failed =
      std::ranges::count_if(watch.rounds, [](const WatchRound& round) { return !round.problem.empty(); });
  return fmt::format("{}\n{} baked, {} could not be", to_text(watch.first, options),
                     counted(std::ssize(watch.rounds) - failed, "save was", "saves were"), failed);
}

}  // namespace ssphh::app
