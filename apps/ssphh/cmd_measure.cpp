#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <ssphh/gi/leak.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "command.h"
#include "probe_options.h"
#include "scene_options.h"

namespace ssphh::app {
namespace {

struct MeasureOptions {
  SceneOptions scene;
  std::vector<std::string> probes, weights;
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

void measure(Context& context, MeasureOptions& o) {
  const scene::Scene scene = load_scene(o.scene);
  const trace::PathTracer tracer(scene, o.scene.time);
  std::vector<gi::ProbeSet> sets;
  for (const std::string& file : o.probes) {
    sets.push_back(gi::read_probe_file(file));
    require_same_scene(file, sets.back(), scene, tracer.light_groups(), o.scene.time, o.force);
  }
  const trace::TransportScene surfaces(scene);
  const std::vector<scene::SurfacePoint> points =
      find_points(o, surfaces, viewpoints(scene, sets, o.scene.time), context);
  o.params.path.seed = context.seed;
  const gi::TruthAtPoints truth = gi::trace_truth(tracer, points, o.params, context.control);

  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  std::string text = fmt::format(
      "{} points of {} paths, {} of them dark; mean {:.5g} W/m2\n{:<24}{:<11}{:>8}{:>11}{:>9}{:>10}{:>9}",
      points.size(), o.params.path.spp, truth.dark, truth.mean, "probes", "weights", "ratio", "mean error",
      "95 %", "relMSE", "leak");
  double noise = 0;
  if (o.weights.empty()) o.weights.emplace_back();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const std::string& weights : o.weights) {
      gi::LookupParams lookup_params;
      lookup_params.weights = weight_params(o.probes[i], sets[i], weights);
      const gi::IrradianceLookup lookup(sets[i], tracer, lookup_params);
      const std::string used = gi::to_string(lookup_params.weights.chosen(sets[i].fitted.has_value()));
      const std::vector<vec3> looked_up = gi::look_up(lookup, points, context.control);
      const gi::LookupError e = gi::lookup_error(looked_up, truth.estimates);
      const double leak = gi::leak_ratio(looked_up, truth);
      noise = e.noise;
      const auto number = [](double value) {
        return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
      };
      results.push_back({{"probes", o.probes[i]},
                         {"weights", used},
                         {"ratio", number(e.ratio)},
                         {"mean_error", e.mean_error},
                         {"mean_relative", e.mean_relative},
                         {"median_relative", e.median_relative},
                         {"p95_relative", e.p95_relative},
                         {"relmse", e.relmse},
                         {"leak_ratio", leak}});
      text += fmt::format("\n{:<24}{:<11}{:>8.3f}{:>9.1f} %{:>7.1f} %{:>10.4f}{:>7.2f} %", o.probes[i], used,
                          e.ratio, 100 * e.mean_error, 100 * e.p95_relative, e.relmse, 100 * leak);
    }
  }
  context.result({{"points", points.size()},
                  {"dark_points", truth.dark},
                  {"mean_truth", truth.mean},
                  {"truth_spp", o.params.path.spp},
                  {"noise", noise},
                  {"results", std::move(results)}},
                 text + fmt::format("\nnoise of the truth: {:.2g} % of a point, taken off the mean error and "
                                    "relMSE",
                                    100 * noise));
}

}  // namespace

void add_measure_command(CLI::App& app, Context& context) {
  auto options = std::make_shared<MeasureOptions>();
  MeasureOptions& o = *options;
  CLI::App* command =
      add_command(app, context, "measure", "Compare the light looked up from probes with path tracing",
                  [&context, options] { measure(context, *options); });
  add_scene_options(*command, o.scene);
  command->add_option("--probes", o.probes, "Probe files; all are compared with the same truth")
      ->check(probe_file_name())
      ->required();
  command
      ->add_option(
          "--weights", o.weights,
          "How probes are blended, one or several: distance, trilinear, mls, fitted; by default what "
          "`render` would take")
      ->delimiter(',')
      ->check(CLI::IsMember({"distance", "trilinear", "mls", "fitted"}));
  command->add_option("--points", o.points, "Points to compare at, uniform by area over what can be reached")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command
      ->add_option("--clearance", o.clearance,
                   "Only points with so much free space before them [m]: slits are nobody's view")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--box", o.box, "x0,y0,z0,x1,y1,z1: only points within [m]; so many fewer")
      ->delimiter(',')
      ->expected(6);
  command->add_flag("--open", o.open,
                    "In the open instead of on surfaces, facing anywhere: where things that move would be");
  add_force_option(*command, o.force);

  const std::string truth = "Truth";
  command->add_option("--truth-spp", o.params.path.spp, "Paths per point")
      ->check(CLI::Range(2, 1 << 22))
      ->capture_default_str()
      ->group(truth);
  command->add_option("--max-depth", o.params.path.max_depth, "Scattering events of a path")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str()
      ->group(truth);
  command->footer(
      "Indirect irradiance as Rec.709 luminance. Mean error: mean of |looked up - true| / true, the truth's\n"
      "own noise taken off; docs/methods/relight.md says how, and what dark and leak mean.");
}

}  // namespace ssphh::app
