#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/gi/leak.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "commands/live_method.h"
#include "options/probe_options.h"
#include "options/scene_options.h"
#include "results/geometry_builds.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

struct MeasureOptions {
  SceneOptions scene;
  std::vector<std::string> probes, methods, weights;
  std::vector<float> box;
  float clearance = 0.05f;
  bool open = false, force = false;
  int points = 1024;
  gi::LeakParams params{.path = {.max_depth = 25, .passes = 1, .spp = 1024, .seed = 0}};
};

/// Points on surfaces, or in the open near them; within the box, if one is given.
std::vector<scene::SurfacePoint> find_points(const MeasureOptions& o, const scene::TransportSource& surfaces,
                                             std::span<const vec3> origins, const Context& context) {
  std::vector<scene::SurfacePoint> points = gi::reachable_points(
      surfaces, origins, o.scene.time, {o.points, context.seed, o.clearance}, context.control);
  if (o.open) points = gi::points_in_the_open(surfaces, points, o.scene.time, context.seed);
  if (!o.box.empty()) {
    const vec3 low(o.box[0], o.box[1], o.box[2]), high(o.box[3], o.box[4], o.box[5]);
    std::erase_if(points, [&](const scene::SurfacePoint& p) {
      return !glm::all(glm::lessThanEqual(low, p.position)) ||
             !glm::all(glm::lessThanEqual(p.position, high));
    });
    if (points.empty()) throw Error("--box", "no point that can be reached lies in it");
  }
  return points;
}

/// A way to look light up, and what its line and its JSON object say beside the errors.
struct Candidate {
  std::string name, detail;
  std::shared_ptr<const scene::IndirectLight> light;
  json::Value json;
  std::shared_ptr<LiveMethod> live = nullptr;  ///< null for probe files
};

std::vector<Candidate> probe_candidates(const MeasureOptions& o, const std::vector<gi::ProbeSet>& sets,
                                        const trace::PathTracer& tracer) {
  std::vector<std::optional<gi::WeightMethod>> weights;
  for (const std::string& name : o.weights) weights.push_back(parse_enum<gi::WeightMethod>(name));
  if (weights.empty()) weights.emplace_back();
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const std::optional<gi::WeightMethod>& method : weights) {
      const gi::LookupParams params = lookup_params(o.probes[i], sets[i], {.weights = method});
      const std::string used(name_of(params.weights.chosen(sets[i].fitted.has_value())));
      candidates.push_back({o.probes[i],
                            used,
                            std::make_shared<gi::IrradianceLookup>(sets[i], tracer, params),
                            {{"probes", o.probes[i]}, {"weights", used}}});
    }
  }
  return candidates;
}

/// "NAME,PARAMETER=VALUE,...": the method stays alive as long as its light.
Candidate method_candidate(const std::string& spec, const trace::SharedGeometry& geometry,
                           const scene::Scene& scene, float time, const Control& control) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= spec.size();) {
    const std::size_t comma = std::min(spec.find(',', at), spec.size());
    words.push_back(spec.substr(at, comma - at));
    at = comma + 1;
  }
  const std::string name = words.front();
  words.erase(words.begin());
  auto live = std::make_shared<LiveMethod>(name, words, geometry, scene, control);
  live->update(scene::lighting_at(live->source(), time), control);
  json::Value json = {{"method", spec}};
  json.update(live->json());
  const scene::IndirectLight* light = &live->method().light();
  return {spec, "", {live, light}, std::move(json), live};
}

/// Microseconds of all threads' time together for one lookup, from batches of at least 50 ms.
double lookup_microseconds(const scene::IndirectLight& light, std::span<const scene::SurfacePoint> points,
                           const Control& control) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  double seconds = 0;
  std::size_t lookups = 0;
  do {
    gi::look_up(light, points, control);
    lookups += points.size();
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
  } while (seconds < 0.05);
  return 1e6 * seconds * thread_count() / static_cast<double>(lookups);
}

/// Median milliseconds of an update for which every lamp went a centimetre aside (or, without lamps, all
/// light changed its strength), of seven or as many as two seconds hold. Leaves the method in another state.
double frame_milliseconds(LiveMethod& live, float time, const Control& control) {
  constexpr int most_frames = 7;
  constexpr double most_ms = 2000;
  std::vector<double> ms;
  double total = 0;
  for (int f = 0; f < most_frames && total < most_ms; ++f) {
    scene::LightingState state = scene::lighting_at(live.source(), time);
    const float step = f % 2 == 0 ? 0.01f : 0;
    for (scene::LightState& light : state.lights) light.world[3].x += step;
    if (state.lights.empty()) {
      for (vec3& scale : state.group_scales) scale = vec3(1 + step);
    }
    live.update(state, control);
    ms.push_back(1e3 * live.update_seconds());
    total += ms.back();
  }
  return percentile(std::move(ms), 0.5);
}

void measure(Context& context, MeasureOptions& o) {
  const GeometryBuilds builds;
  if (o.probes.empty() && o.methods.empty())
    throw Error("measure", "there is nothing to compare", "give --probes FILE or --method NAME");
  const scene::Scene scene = load_scene(o.scene);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::PathTracer tracer(geometry, scene, o.scene.time);
  std::vector<gi::ProbeSet> sets;
  for (const std::string& file : o.probes) {
    sets.push_back(gi::read_probe_file(file));
    require_same_scene(file, sets.back(), scene, tracer.light_groups(), o.scene.time, o.force);
  }
  std::vector<Candidate> candidates = probe_candidates(o, sets, tracer);  // fails before the work
  const trace::TransportScene surfaces(geometry, scene);
  const std::vector<scene::SurfacePoint> points =
      find_points(o, surfaces, viewpoints(scene, sets, o.scene.time), context);
  o.params.path.seed = context.seed;
  const gi::TruthAtPoints truth = gi::trace_truth(tracer, points, o.params, context.control);

  json::Value results = json::Value::array();
  std::string text = fmt::format(
      "{} points of {} paths, {} of them dark; mean {:.5g} "
      "W/m2\n{:<24}{:<11}{:>8}{:>11}{:>9}{:>10}{:>9}{:>9}",
      points.size(), o.params.path.spp, truth.dark, truth.mean, "light", "weights", "ratio", "mean error",
      "95 %", "relMSE", "leak", "lookup");
  double noise = 0;
  const auto compare = [&](Candidate candidate) {
    const std::vector<vec3> looked_up = gi::look_up(*candidate.light, points, context.control);
    const double lookup_us = lookup_microseconds(*candidate.light, points, context.control);
    const gi::LookupError e = gi::lookup_error(looked_up, truth.estimates);
    const double leak = gi::leak_ratio(looked_up, truth);
    noise = e.noise;
    const auto number = [](double value) {
      return std::isfinite(value) ? json::Value(value) : json::Value(nullptr);
    };
    candidate.json.update({{"ratio", number(e.ratio)},
                           {"mean_error", e.mean_error},
                           {"mean_relative", e.mean_relative},
                           {"median_relative", e.median_relative},
                           {"p95_relative", e.p95_relative},
                           {"relmse", e.relmse},
                           {"leak_ratio", leak},
                           {"lookup_us", lookup_us}});
    if (candidate.live)
      candidate.json["frame_ms"] = frame_milliseconds(*candidate.live, o.scene.time, context.control);
    text += fmt::format("\n{:<24}{:<11}{:>8.3f}{:>9.1f} %{:>7.1f} %{:>10.4f}{:>7.2f} %{:>6.3g} us",
                        candidate.name, candidate.detail, e.ratio, 100 * e.mean_error, 100 * e.p95_relative,
                        e.relmse, 100 * leak, lookup_us);
    results.push_back(std::move(candidate.json));
  };
  for (Candidate& candidate : candidates) compare(std::move(candidate));
  for (const std::string& spec : o.methods)
    compare(method_candidate(spec, geometry, scene, o.scene.time, context.control));
  context.result({{"points", points.size()},
                  {"dark_points", truth.dark},
                  {"mean_truth", truth.mean},
                  {"truth_spp", o.params.path.spp},
                  {"noise", noise},
                  {"geometry_builds", builds.count()},
                  {"results", std::move(results)}},
                 text + fmt::format("\nnoise of the truth: {:.2g} % of a point, taken off the mean error and "
                                    "relMSE",
                                    100 * noise));
}

}  // namespace

void add_measure_command(Command app, Context& context) {
  auto options = std::make_shared<MeasureOptions>();
  MeasureOptions& o = *options;
  Command command =
      add_command(app, context, "measure",
                  "Compare light looked up from probes, or found by any method, with path tracing",
                  [&context, options] { measure(context, *options); });
  add_scene_options(command, o.scene);
  add_probe_files(command, "--probes", o.probes, "Probe files; all are compared with the same truth");
  command
      .option("--method", o.methods,
              "Method with its parameters, NAME[,PARAMETER=VALUE ...], made here; may be repeated; "
              "`ssphh methods` lists them")
      .repeatable();
  command
      .option("--weights", o.weights,
              "How probes are blended, one or several: distance, trilinear, mls, fitted; by default what "
              "`render` would take")
      .separated_by(',')
      .one_of(names_of<gi::WeightMethod>());
  command.option("--points", o.points, "Points to compare at, uniform by area over what can be reached")
      .range(1, 1 << 24);
  command
      .option("--clearance", o.clearance,
              "Only points with so much free space before them [m]: slits are nobody's view")
      .non_negative();
  command.option("--box", o.box, "x0,y0,z0,x1,y1,z1: only points within [m]; so many fewer")
      .separated_by(',')
      .values(6);
  command.flag("--open", o.open,
               "In the open instead of on surfaces, facing anywhere: where things that move would be");
  add_force_option(command, o.force);

  const std::string truth = "Truth";
  command.option("--truth-spp", o.params.path.spp, "Paths per point").range(2, 1 << 22).group(truth);
  command.option("--max-depth", o.params.path.max_depth, "Scattering events of a path")
      .range(2, 1000)
      .group(truth);
  command.footer(
      "Indirect irradiance as Rec.709 luminance. Mean error: mean of |looked up - true| / true, the truth's\n"
      "own noise taken off; docs/methods/relight.md says how, and what dark and leak mean.");
}

}  // namespace ssphh::app
