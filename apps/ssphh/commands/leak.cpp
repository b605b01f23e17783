#include "commands/leak.h"

#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "results/geometry_builds.h"
#include "results/leak_map.h"

namespace ssphh::app {

LeakResult run_leak(const LeakOptions& o, const Control& control) {
  const GeometryBuilds builds;
  if (!o.output.empty()) {
    const image::FileFormat format = image::format_of_extension(o.output);
    if (format != image::FileFormat::png && format != image::FileFormat::exr)
      throw Error(o.output, "a leak map is written as .png (colours) or .exr (numbers)");
  }
  const probes::ProbeSet set = probes::read_probe_file(o.probes);
  const scene::Scene scene = load_lit_scene(o.scene);
  LeakResult result;
  const float time = result.time = o.time.value_or(set.generator.time);
  if (time != set.generator.time) {
    log_warning("{}: was baked at {} s, not at {} s: what moved since counts as leaking", o.probes,
                set.generator.time, time);
  }
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  scene::CameraPose camera;
  if (!o.output.empty()) camera = camera_of(scene, o.camera, time, geometry);
  trace::PathTracer tracer(geometry, scene, time);
  require_same_scene(o.probes, set, scene, tracer.light_groups(), {}, o.force);
  const trace::TransportScene surfaces(geometry, scene);
  const probes::LookupParams params_of_lookup = lookup_params(o.probes, set, o.lookup);
  const probes::IrradianceLookup lookup(set, tracer, params_of_lookup);
  tracer.count_as_indirect(lookup.direct_groups());
  result.weights = probes::chosen_weights(set, params_of_lookup);

  study::LeakParams params = o.params;
  params.path.seed = o.seed;
  result.points = study::reachable_points(surfaces, viewpoints(scene, surfaces, {&set, 1}, time), time,
                                          {o.points, o.seed}, control);
  result.report = study::measure_leak(tracer, lookup, result.points, params, control);
  const double mean = result.report.mean_truth;
  if (!(mean > 0)) log_warning("{}: path tracing finds no indirect light at all", o.scene.source);
  if (!o.output.empty()) {
    params.path.spp = o.map_spp;
    params.mean = static_cast<float>(mean > 0 ? mean : 1);
    const LeakMap map = leak_map(surfaces, time, camera, o.width, o.height, tracer, lookup, params, control);
    result.map = {map.dark, write_leak_map(o.output, map)};
  }
  result.geometry_builds = builds.count();
  return result;
}

json::Value to_json(const LeakResult& result, const LeakOptions& o) {
  const study::LeakReport& report = result.report;
  json::Value object = {{"leak_ratio", report.ratio},
                        {"points", result.points.size()},
                        {"dark_points", report.dark},
                        {"dark_share", o.params.dark_share},
                        {"truth_noise", report.truth_noise},
                        {"truth_spp", o.params.path.spp},
                        {"mean_truth", report.mean_truth},
                        {"mean_looked_up", report.mean_looked_up},
                        {"weights", name_of(result.weights)},
                        {"time", result.time},
                        {"geometry_builds", result.geometry_builds}};
  if (result.map) {
    object["map"] = {{"output", o.output}, {"dark_pixels", result.map->dark}, {"scale", result.map->scale}};
  }
  return object;
}

std::string to_text(const LeakResult& result, const LeakOptions& o) {
  const study::LeakReport& report = result.report;
  std::string text = fmt::format(
      "leaked      {:.4g} % of the looked-up light stands on dark points\n"
      "dark        {} of {} points: path traced indirect irradiance under {:g} of the mean, at {:g} sigma\n"
      "mean        {:.5g} W/m2 looked up, {:.5g} path traced (noise of a point {:.2g} %)",
      100 * report.ratio, report.dark, result.points.size(), o.params.dark_share, o.params.sigmas,
      report.mean_looked_up, report.mean_truth, 100 * report.truth_noise);
  if (result.map) {
    text += fmt::format("\nmap         {}, {} dark pixels", o.output, result.map->dark);
    if (result.map->scale > 0) text += fmt::format(", last colour at {:.3g} of the mean", result.map->scale);
  }
  return text;
}

void add_leak_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "leak", "Measure the light that probes put where there is none", run_leak);
  add_scene_options(command, o.scene, false);
  command.under("Scene")
      .option("--time", o.time, "Pose the scene's animations at this time [s]")
      .shown_default("that of the probe file");
  add_probe_file(command, "--probes", o.probes, "Probe file").required();
  command.option("--points", o.points, "Surface points to measure at").range(1, 1 << 24);
  add_weights_option(command, o.lookup.weights);
  add_force_option(command, o.force);
  add_layer_option(command, o.lookup.layer);

  const Command truth = command.under("Truth");
  add_truth_path_options(truth, o.params.path.spp, o.params.path.max_depth);
  truth
      .option("--dark", o.params.dark_share,
              "A point is dark below this share of the mean indirect irradiance")
      .range(1e-12f, 0.5f);

  const Command map = command.under("Map");
  map.option("-o,--output", o.output,
             "Picture of the dark places that probes light: .png (colours over the grey scene) or .exr "
             "(shares of the mean irradiance)");
  add_camera_option(map, o.camera);
  add_size_options(map, o.width, o.height, 16384);
  map.option("--map-spp", o.map_spp, "Paths per pixel").range(2, 1 << 22);
  command.footer(
      "Points are uniform by area over what cameras and probes can reach. Leaked: the sum of looked-up "
      "indirect\n"
      "irradiance at points that are dark by path tracing, over the sum at all points.");
}

}  // namespace ssphh::app
