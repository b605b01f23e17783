#include "commands/measure.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/study/converged_truth.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "results/geometry_builds.h"
#include "results/json_values.h"
#include "results/lookup_figures.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

constexpr double most_dark = 0.8;  ///< share of dark points from which figures of all points say little

/// Points on surfaces, or in the open near them; within the box, if one is given.
std::vector<rays::SurfacePoint> find_points(const MeasureOptions& o, const std::optional<scene::Bounds>& box,
                                            const rays::TransportSource& surfaces,
                                            std::span<const vec3> origins, const Control& control) {
  std::vector<rays::SurfacePoint> points =
      study::reachable_points(surfaces, origins, o.scene.time, {o.points, o.seed, o.clearance, box}, control);
  if (o.open) points = study::points_in_the_open(surfaces, points, o.scene.time, o.seed, box);
  return points;
}

/// What each camera sees, or who looks at a scene without one.
std::vector<MeasuredRegion> views_of(const MeasureOptions& o, const scene::Scene& scene,
                                     const trace::SharedGeometry& geometry,
                                     const rays::TransportSource& surfaces) {
  std::vector<std::string> names;
  for (const scene::Camera& camera : scene.cameras) names.push_back(camera.name);
  if (names.empty()) names.emplace_back();
  std::vector<MeasuredRegion> views;
  for (const std::string& name : names) {
    const scene::CameraPose camera = camera_of(scene, name, o.scene.time, geometry);
    const float aspect = camera.camera.aspect.value_or(16.0f / 9);
    std::vector<rays::SurfacePoint> points =
        study::points_in_view(surfaces, camera, aspect, o.scene.time, o.points, o.seed);
    if (!points.empty()) views.push_back({"view " + camera.camera.name, std::move(points), {}});
  }
  return views;
}

/// A way to look light up, and what is known of it before it is measured.
struct Candidate {
  MeasuredLight known;
  std::shared_ptr<const rays::IndirectLight> light;
  std::shared_ptr<pipeline::LiveMethod> live = nullptr;  ///< null for probe files
  const probes::ProbeSet* probes = nullptr;              ///< of a probe file
};

std::vector<Candidate> probe_candidates(const MeasureOptions& o, const std::vector<probes::ProbeSet>& sets,
                                        const trace::PathTracer& tracer) {
  std::vector<std::optional<probes::WeightMethod>> weights(o.weights.begin(), o.weights.end());
  if (weights.empty()) weights.emplace_back();
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const std::optional<probes::WeightMethod>& method : weights) {
      const probes::LookupParams params = lookup_params(o.probes[i], sets[i], {.weights = method});
      Candidate& candidate = candidates.emplace_back();
      candidate.known.name = o.probes[i];
      candidate.known.weights = probes::chosen_weights(sets[i], params);
      candidate.light = std::make_shared<probes::IrradianceLookup>(sets[i], tracer, params);
      candidate.probes = &sets[i];
    }
  }
  return candidates;
}

struct MethodSpec {
  std::string name;
  std::vector<std::string> settings;
};

/// "NAME,PARAMETER=VALUE,...", of a method and parameters that there are.
MethodSpec read_method(const std::string& spec) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= spec.size();) {
    const std::size_t comma = std::min(spec.find(',', at), spec.size());
    words.push_back(spec.substr(at, comma - at));
    at = comma + 1;
  }
  const MethodSpec method{words.front(), {words.begin() + 1, words.end()}};
  const methods::MethodEntry& entry = methods::find_method(method.name);
  methods::MethodParameters(method.name, entry.parameters, method.settings);
  return method;
}

/// The method stays alive as long as its light.
Candidate method_candidate(const std::string& spec, const trace::SharedGeometry& geometry,
                           const scene::Scene& scene, float time, const Control& control) {
  const auto [name, settings] = read_method(spec);
  auto live = std::make_shared<pipeline::LiveMethod>(name, settings, geometry, scene, control);
  live->update(rays::lighting_at(live->source(), time), control);
  Candidate candidate;
  candidate.known.name = spec;
  candidate.known.method = live->figures();
  candidate.light = {live, &live->method().light()};
  candidate.live = std::move(live);
  return candidate;
}

/// Microseconds of all threads' time together for one lookup, from batches of at least 50 ms.
double lookup_microseconds(const rays::IndirectLight& light, std::span<const rays::SurfacePoint> points,
                           const Control& control) {
  const Stopwatch watch;
  double seconds = 0;
  std::size_t lookups = 0;
  do {
    study::look_up(light, points, control);
    lookups += points.size();
    seconds = watch.seconds();
  } while (seconds < 0.05);
  return 1e6 * seconds * thread_count() / static_cast<double>(lookups);
}

/// Median milliseconds of an update for which every lamp went a centimetre aside (or, without lamps, all
/// light changed its strength), of seven or as many as two seconds hold. Leaves the method in another state.
double frame_milliseconds(pipeline::LiveMethod& live, float time, const Control& control) {
  constexpr int most_frames = 7;
  constexpr double most_ms = 2000;
  std::vector<double> ms;
  double total = 0;
  for (int f = 0; f < most_frames && total < most_ms; ++f) {
    scene::LightingState state = rays::lighting_at(live.source(), time);
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

/// Share of the points that see none of the probes near them; none for what is no probe file.
std::optional<double> unseen_by(const Candidate& candidate, const rays::TransportSource& surfaces,
                                std::span<const rays::SurfacePoint> points, float time) {
  if (!candidate.probes) return {};
  std::vector<vec3> probes;
  for (const probes::Probe& probe : candidate.probes->probes) probes.push_back(probe.position);
  const std::vector<std::uint8_t> seen = study::sees_any(surfaces, points, probes, time);
  return static_cast<double>(std::ranges::count(seen, 0)) / static_cast<double>(seen.size());
}

MeasuredLight measured(const Candidate& candidate, const MeasureResult& at,
                       const rays::TransportSource& surfaces, float time, const Control& control) {
  MeasuredLight result = candidate.known;
  const std::vector<vec3> looked_up = study::look_up(*candidate.light, at.points, control);
  result.lookup_us = lookup_microseconds(*candidate.light, at.points, control);
  result.error = study::lookup_error(looked_up, at.truth.estimates);
  result.unseen = unseen_by(candidate, surfaces, at.points, time);
  result.leak_ratio = study::leak_ratio(looked_up, at.truth);
  for (const MeasuredRegion& region : at.regions) {
    const std::vector<vec3> there = study::look_up(*candidate.light, region.points, control);
    result.regions.push_back(
        {region.name, region.truth.spp, study::lookup_error(there, region.truth.estimates),
         study::leak_ratio(there, region.truth), unseen_by(candidate, surfaces, region.points, time)});
  }
  if (candidate.live) result.frame_ms = frame_milliseconds(*candidate.live, time, control);
  return result;
}

/// Whose direct light the lookups hold. Throws Error unless all, and methods, hold that of the same groups:
/// there is one truth.
std::vector<std::string> direct_groups_of(const std::vector<Candidate>& candidates, bool methods) {
  if (candidates.empty()) return {};
  std::vector<std::string> groups = candidates.front().light->direct_groups();
  const bool alike = std::ranges::all_of(
      candidates, [&](const Candidate& other) { return other.light->direct_groups() == groups; });
  if (!alike || (methods && !groups.empty()))
    throw Error(candidates.front().known.name,
                "holds direct light of other light groups than what it is "
                "compared with",
                "measure them one by one, or bake all with the same --light-mode");
  return groups;
}

/// The noise of the truth in its worst channel, which is the same whatever is compared with it.
double noise_of(const MeasureResult& result) {
  return result.lights.empty() ? 0 : study::worst_channel(result.lights.front().error).noise;
}

json::Value light_json(const MeasuredLight& light) {
  json::Value object = {{light.method ? "method" : "probes", light.name}};
  if (light.weights) object["weights"] = name_of(*light.weights);
  if (light.method) object.update(to_json(*light.method));
  object.update(to_json(light.error));
  object.update({{"leak_ratio", light.leak_ratio}, {"lookup_us", light.lookup_us}});
  if (light.frame_ms) object["frame_ms"] = *light.frame_ms;
  if (light.unseen) object["unseen"] = *light.unseen;
  json::Value& regions = object["regions"] = json::Value::object();
  for (const RegionError& region : light.regions) {
    json::Value& part = regions[region.name] = to_json(region.error);
    part["truth_spp"] = region.spp;
    part["leak_ratio"] = region.leak_ratio;
    if (region.unseen) part["unseen"] = *region.unseen;
  }
  return object;
}

/// The columns of an error: ratios, then what is worst of the channels.
std::string error_columns(const study::LookupError& error) {
  const study::RelativeError worst = study::worst_channel(error);
  return fmt::format("{} {:>6.1f} % {:>6.1f} % {:>9.4f} {:>6.2f} %", ratio_columns(error),
                     100 * worst.mean_error, 100 * worst.p95_relative, worst.relmse,
                     100 * error.chromaticity.mean_error);
}

std::string unseen_column(const std::optional<double>& share) {
  return share ? fmt::format("{:>7.1f} %", 100 * *share) : std::string(9, ' ');
}

}  // namespace

MeasureResult run_measure(const MeasureOptions& o, const Control& control) {
  const GeometryBuilds builds;
  if (o.probes.empty() && o.methods.empty())
    throw Error("measure", "there is nothing to compare", "give --probes FILE or --method NAME");
  for (const std::string& spec : o.methods) read_method(spec);  // fails before the work
  require_different_names(o.regions);
  const scene::Scene scene = load_lit_scene(o.scene);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  trace::PathTracer tracer(geometry, scene, o.scene.time);
  std::vector<probes::ProbeSet> sets;
  for (const std::string& file : o.probes) {
    probes::ProbeSet& set = sets.emplace_back(read_probes_of(scene, file, o.scene.time, o.force));
    // What is compared is reflected light, that of methods without records too
    for (probes::LightGroup& group : set.light_groups)
      if (group.mode == scene::LightMode::diffuse) group.mode = scene::LightMode::realtime;
    probes::merge_groups(set);
  }
  const std::vector<Candidate> candidates = probe_candidates(o, sets, tracer);  // fails before the work
  tracer.count_as_indirect(direct_groups_of(candidates, !o.methods.empty()));
  const trace::TransportScene surfaces(geometry, scene);
  MeasureResult result;
  const std::vector<vec3> origins = viewpoints(scene, surfaces, sets, o.scene.time);
  result.points = find_points(o, o.box, surfaces, origins, control);
  std::vector<MeasuredRegion> boxes;
  for (const NamedBox& named : o.regions)
    boxes.push_back({named.name, find_points(o, named.box, surfaces, origins, control), {}});
  if (o.views) {
    for (MeasuredRegion& view : views_of(o, scene, geometry, surfaces)) boxes.push_back(std::move(view));
  }
  study::LeakParams params = o.params;
  params.path.seed = o.seed;
  params.noise = params.path.spp > 0 ? 0 : usual_noise;
  if (params.path.spp == 0) params.path.spp = 512;
  result.truth = study::trace_truth(tracer, result.points, params, control);
  if (result.truth.dark > most_dark * static_cast<double>(result.points.size()))
    log_warning(
        "{} of {} points have hardly any indirect light, as on a wide plain: errors there are shares of next "
        "to nothing (--views measures what cameras see, --region and --box parts of the scene)",
        result.truth.dark, result.points.size());
  result.regions = inside_and_outside(surfaces, result.points, result.truth, o.scene.time);
  for (MeasuredRegion& region : boxes) {
    region.truth = study::trace_truth(tracer, region.points, params, control);
    result.regions.push_back(std::move(region));
  }

  const auto measure = [&](const Candidate& candidate) {
    result.lights.push_back(measured(candidate, result, surfaces, o.scene.time, control));
  };
  for (const Candidate& candidate : candidates) measure(candidate);
  for (const std::string& spec : o.methods)
    measure(method_candidate(spec, geometry, scene, o.scene.time, control));
  result.geometry_builds = builds.count();
  return result;
}

json::Value to_json(const MeasureResult& result, const MeasureOptions&) {
  json::Value lights = json::Value::array();
  for (const MeasuredLight& light : result.lights) lights.push_back(light_json(light));
  return {{"points", result.points.size()},  {"dark_points", result.truth.dark},
          {"mean_truth", result.truth.mean}, {"truth_spp", result.truth.spp},
          {"noise", noise_of(result)},       {"geometry_builds", result.geometry_builds},
          {"results", std::move(lights)}};
}

std::string to_text(const MeasureResult& result, const MeasureOptions&) {
  std::string text = fmt::format(
      "{} points of {} paths, {} of them dark; mean {:.5g} W/m2\n"
      "{:<24} {:<10}{:>7}{:>7}{:>7}{:>9}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}",
      result.points.size(), result.truth.spp, result.truth.dark, result.truth.mean, "light", "weights",
      "ratio R", "G", "B", "error", "95 %", "relMSE", "colour", "leak", "unseen", "lookup");
  for (const MeasuredLight& light : result.lights) {
    text += fmt::format("\n{:<24} {:<10}{} {:>6.2f} %{}{:>6.3g} us", light.name,
                        light.weights ? name_of(*light.weights) : "", error_columns(light.error),
                        100 * light.leak_ratio, unseen_column(light.unseen), light.lookup_us);
    if (light.regions.size() < 2) continue;
    for (const RegionError& region : light.regions) {
      const std::string name = fmt::format("{}, {} points", region.name, region.error.points);
      text += fmt::format("\n  {:<33}{} {:>6.2f} %{}", name, error_columns(region.error),
                          100 * region.leak_ratio, unseen_column(region.unseen));
    }
  }
  return text + fmt::format(
                    "\nerror, 95 % and relMSE of the worst channel; the truth's noise, {:.2g} % of a point, "
                    "is taken off error, relMSE and colour",
                    100 * noise_of(result));
}

void add_measure_command(Command app, Context& context) {
  struct Words {
    std::vector<std::string> weights;
    std::vector<float> box;
    std::vector<std::string> regions;
  };
  const auto words = std::make_shared<Words>();
  auto [command, o] = add_command<MeasureOptions>(
      app, context, "measure",
      "Compare light looked up from probes, or found by any method, with path tracing",
      [&context, words](MeasureOptions& given) {
        for (const std::string& name : words->weights)
          given.weights.push_back(*parse_enum<probes::WeightMethod>(name));
        if (const std::vector<float>& b = words->box; !b.empty())
          given.box = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
        for (const std::string& region : words->regions) given.regions.push_back(read_named_box(region));
        run_and_print(context, given, run_measure);
      });
  add_scene_options(command, o.scene);
  add_probe_files(command, "--probes", o.probes, "Probe files; all are compared with the same truth");
  command
      .option("--method", o.methods,
              "Method with its parameters, NAME[,PARAMETER=VALUE ...], made here; may be repeated; "
              "`ssphh methods` lists them")
      .repeatable();
  command
      .option(
          "--weights", words->weights,
          "How light is found, one or several: distance, trilinear, mls, fitted, surface; by default what "
          "`render` would take")
      .separated_by(',')
      .one_of(names_of<probes::WeightMethod>());
  command.option("--points", o.points, "Points to compare at, uniform by area over what can be reached")
      .range(1, 1 << 24);
  command
      .option("--clearance", o.clearance,
              "Only points with so much free space before them [m]: slits are nobody's view")
      .non_negative();
  command.option("--box", words->box, "x0,y0,z0,x1,y1,z1: all points within [m]").separated_by(',').values(6);
  command
      .option("--region", words->regions,
              "NAME=x0,y0,z0,x1,y1,z1: also tell the errors at as many points within [m]; may be repeated. "
              "Those inside and outside of rooms are told anyway")
      .repeatable();
  command.flag("--views", o.views, "Also tell the errors at as many points that each camera sees");
  command.flag("--open", o.open,
               "In the open instead of on surfaces, facing anywhere: where things that move would be");
  add_force_option(command, o.force);

  add_truth_path_options(command.under("Truth"), o.params.path.spp, o.params.path.max_depth)
      .shown_default(fmt::format("512, and twice as many until their mean noise is {:g} %, {} at most",
                                 100 * usual_noise, study::most_truth_spp));
  command.footer(
      "Indirect irradiance per channel. Error: mean of |looked up - true| / true, the truth's own noise "
      "taken off;\n"
      "colour: mean |difference| of r/(r+g+b), g/.., b/.., summed over the three. docs/methods/relight.md "
      "says how,\n"
      "what dark, leak, inside and outside mean. Unseen: points that see none of the probes near them.");
}

}  // namespace ssphh::app
