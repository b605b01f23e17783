#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/farm/farm_bake.h>
#include <ssphh/gi/bake.h>
#include <ssphh/gi/init.h>
#include <ssphh/gi/transport_bake.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/farm_options.h"
#include "options/place_options.h"
#include "options/probe_options.h"
#include "options/scene_options.h"
#include "results/geometry_builds.h"

namespace ssphh::app {
namespace {

/// VIZ takes a pass over all probes for each probe; nobody waits long for that unasked.
constexpr std::size_t most_probes_for_paths = 64, most_probes_for_links = 512;
/// Edges of a probe that are kept when they are many: 1.2 kB each at degree 9.
constexpr int default_neighbors = 16;

struct BakeOptions {
  SceneOptions scene;
  PlaceOptions place;
  FarmChoice farm;
  std::string output;
  gi::LightOperator op = gi::LightOperator::path;
  std::string viz;  ///< path, links or off; empty: by the number of probes
  int degree = 9;
  gi::BakeParams params;
  gi::TransportBakeParams transport;
  std::optional<int> neighbors;
  float threshold = 0;
  bool resume = true;
  /// Names of the options given that stand only with path tracing, transport or VIZ.
  std::vector<std::string> of_paths, of_transport, of_viz;
};

void refuse(const std::vector<std::string>& given, const char* needs) {
  if (!given.empty()) throw Error(given.front(), needs);
}

/// Decides on VIZ and refuses options that would have no effect.
void resolve(BakeOptions& o, std::size_t probes) {
  const bool path = o.op == gi::LightOperator::path, transfer = o.params.viz_params.matrix;
  gi::BakeParams& params = o.params;
  if (o.viz.empty()) {
    o.viz = transfer || (path && probes <= most_probes_for_paths) ? "path"
            : probes <= most_probes_for_links                     ? "links"
                                                                  : "off";
    if (o.viz == "off")
      log_info("VIZ is left out for more than {} probes: --viz links if HIER is to run",
               most_probes_for_links);
  }
  if (transfer && o.viz != "path")
    throw Error("--viz-transfer", "needs VIZ by path tracing", "use --viz path");
  if (!path && params.gen != gi::GenMode::full)
    throw Error(fmt::format("--gen {}", name_of(params.gen)),
                "is of --operator path; the light of surfels has every bounce");
  params.keep_light = !path;
  if (!path) o.transport.op = o.op;
  params.viz = o.viz == "path";
  params.viz_params.neighbors = o.neighbors.value_or(-1);
  params.viz_params.threshold = o.threshold;
  o.transport.viz = o.viz == "links";
  o.transport.viz_params.neighbors = o.neighbors.value_or(default_neighbors);
  o.transport.viz_params.threshold = o.threshold;
  if (!path && !params.viz) refuse(o.of_paths, "is of path tracing: use --operator path or --viz path");
  if (path && !o.transport.fit && !o.transport.viz)
    refuse(o.of_transport, "is of transport: use --operator surfel, bounce, --viz links or --fit");
  if (o.viz == "off") refuse(o.of_viz, "is of VIZ: use --viz links or path");
  if (o.farm.any() && !path && !params.viz)
    throw Error(fmt::format("--operator {}", name_of(o.op)),
                "is done here, in seconds; a farm does GEN and VIZ by path tracing",
                "leave out --broker and --local");
}

struct BakeResult {
  gi::ProbeSet set;
  gi::BakeReport paths;
  gi::TransportBakeReport transport;
  std::optional<farm::FarmReport> farm;
};

BakeResult run(const BakeOptions& o, const trace::SharedGeometry& geometry, const scene::Scene& scene,
               gi::ProbeSet set, const std::filesystem::path& checkpoint, const FarmSession* session,
               const Control& control) {
  BakeResult result{std::move(set), {}, {}, {}};
  const bool path = o.op == gi::LightOperator::path;
  if (!path || o.transport.fit || o.transport.viz) {
    const trace::TransportScene source(geometry, scene);
    if (path) {
      gi::add_transport(source, result.set, o.transport, result.transport, control);
    } else {
      result.set = gi::bake_transport(source, std::move(result.set), o.transport, result.transport, control);
    }
  }
  if (path || o.params.viz) {
    const trace::PathTracer tracer(geometry, scene, o.scene.time);
    std::optional<farm::FarmCrew> crew;
    if (session) crew.emplace(session->options(), scene, o.scene.time);
    result.set = gi::bake(tracer, std::move(result.set), o.params, checkpoint, result.paths, control,
                          crew ? &*crew : nullptr);
    if (crew) result.farm = crew->report();
  }
  return result;
}

double viz_seconds(const BakeResult& r) {
  return r.paths.viz_seconds + r.transport.viz_seconds;
}

std::string result_text(const BakeOptions& o, const BakeResult& r) {
  std::string text =
      fmt::format("{}: {} probes of degree {}, {} light groups, {} edges", o.output, r.set.probes.size(),
                  r.set.degree, r.set.light_groups.size(), gi::edge_count(r.set));
  const gi::TransportBakeReport& t = r.transport;
  if (t.surfels > 0) {
    text +=
        fmt::format("\n{} surfels of {:.3g} m, {} links", t.surfels, r.set.generator.surfel_size, t.links);
    if (o.op != gi::LightOperator::path) {
      text += fmt::format("; {} iterations, a bounce keeps at most {:.3g} of the light; {:.2f} s",
                          t.iterations, t.contraction, t.seconds);
    }
  }
  if (r.set.fitted)
    text +=
        fmt::format("\nweights fitted at {} points in {:.2f} s", r.set.fitted->points.size(), t.fit_seconds);
  if (o.op == gi::LightOperator::path) text += fmt::format("\nGEN {:.2f} s", r.paths.gen_seconds);
  if (o.viz != "off")
    text += fmt::format("\nVIZ from {} {:.2f} s", o.viz == "path" ? "paths" : "links", viz_seconds(r));
  text += fmt::format("\n{} rays", r.paths.rays + t.rays);
  if (r.farm) text += "\n" + farm_text(*r.farm);
  if (r.paths.resumed > 0) {
    text += fmt::format("\n{} of {} steps were taken from the checkpoint", r.paths.resumed,
                        r.set.probes.size() * (std::size_t{o.op == gi::LightOperator::path} + o.params.viz));
  }
  return text;
}

/// Numbers of transport are null where there was none; `iterations` also where only weights were fitted.
json::Value result_json(const BakeOptions& o, const BakeResult& r) {
  const gi::TransportBakeReport& t = r.transport;
  const auto if_any = [](bool any, const auto& value) { return any ? json::Value(value) : json::Value(); };
  const bool solved = o.op != gi::LightOperator::path, network = t.surfels > 0;
  std::vector<std::string> warnings = t.warnings;
  for (const std::string& warning : r.paths.warnings) {
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
  }
  return {{"output", o.output},
          {"operator", name_of(o.op)},
          {"probes", r.set.probes.size()},
          {"degree", r.set.degree},
          {"light_groups", r.set.light_groups.size()},
          {"edges", gi::edge_count(r.set)},
          {"gen", name_of(o.params.gen)},
          {"gen_seconds", r.paths.gen_seconds},
          {"viz_seconds", viz_seconds(r)},
          {"transport_seconds", if_any(solved, t.seconds)},
          {"surfels", if_any(network, t.surfels)},
          {"links", if_any(network, t.links)},
          {"iterations", if_any(solved, t.iterations)},
          {"contraction", if_any(network, t.contraction)},
          {"fitted", r.set.fitted ? r.set.fitted->points.size() : 0},
          {"fit_seconds", if_any(r.set.fitted.has_value(), t.fit_seconds)},
          {"rays", r.paths.rays + t.rays},
          {"resumed", r.paths.resumed},
          {"viz", o.viz},
          {"warnings", warnings}};
}

void bake(Context& context, BakeOptions& options) {
  const GeometryBuilds builds;
  std::optional<FarmSession> session;  // first: its processes start while this one reads the scene
  if (options.farm.any()) session.emplace(options.farm);
  const scene::Scene scene = load_scene(options.scene);
  options.params.path.seed = context.seed;
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const std::optional<PlaceResult> place =
      place_for(geometry, scene, options.scene.time, options.place, "", context.control);
  gi::ProbeSet set =
      place ? gi::init_from_placement(scene, place->placement, options.degree, options.scene.time)
            : gi::init_from_scene(scene, options.degree, options.scene.time);
  resolve(options, set.probes.size());

  const std::filesystem::path checkpoint = options.output + ".checkpoint";
  if (!options.resume) std::filesystem::remove(checkpoint);
  const BakeResult result = run(options, geometry, scene, std::move(set), checkpoint,
                                session ? &*session : nullptr, context.control);
  gi::write_probe_file(result.set, options.output);
  std::filesystem::remove(checkpoint);

  json::Value object = result_json(options, result);
  object["geometry_builds"] = builds.count();
  if (result.farm) object["farm"] = farm_json(*result.farm);
  if (place) object["placement"] = place_json(*place);
  context.result(object, result_text(options, result) + (place ? "\n" + place_text(*place) : ""));
}

/// The options that stand only with path tracing, transport or VIZ.
struct BakeUses {
  std::vector<Option> of_paths, of_transport, of_viz;
};

std::vector<std::string> names_of_given(const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options) {
    if (option.given()) names.push_back(option.name());
  }
  return names;
}

void add_path_options(Command command, BakeOptions& options, BakeUses& uses) {
  const std::string group = "GEN and VIZ: path tracing";
  gi::BakeParams& params = options.params;
  const auto paths = [&](const Option& option) { uses.of_paths.push_back(option.group(group)); };
  paths(command.option("--face", params.face_size, "Texels along a face of each probe's cube map")
            .range(1, 4096));
  paths(command
            .option("--max-depth", params.path.max_depth,
                    "Surface scatterings of a path: 0 emitters only, 1 direct light, ...")
            .range(0, 65535));
  paths(command.option("--passes", params.path.passes, "Passes of --spp samples each").range(1, 1 << 24));
  paths(command.option("--spp", params.path.spp, "Samples per texel and pass").range(1, 1 << 24));
  command
      .choice("--gen", options.params.gen,
              "full: all bounces; local: direct light only (--max-depth 1), for HIER to add the rest")
      .group(group);
  command
      .flag("--resume,!--no-resume", options.resume,
            "Continue an interrupted bake of the same scene and options from OUTPUT.checkpoint (the default)")
      .group(group);
}

void add_viz_options(Command command, BakeOptions& options, BakeUses& uses) {
  const std::string group = "VIZ: light between the SPHLs, which HIER needs";
  command
      .option("--viz", options.viz,
              fmt::format("path: trace it; links: find it with the surfels of transport, every bounce and "
                          "no noise, surfaces reflect diffusely; off. Default: path for operator path and "
                          "up to {} probes, else links for up to {}",
                          most_probes_for_paths, most_probes_for_links))
      .one_of({"path", "links", "off"})
      .group(group);
  uses.of_viz.push_back(
      command
          .option("--neighbors", options.neighbors,
                  fmt::format("Keep at most so many edges per SPHL, strongest P first; -1: all. Default: {} "
                              "with links, all with path",
                              default_neighbors))
          .range(-1, 65536)
          .group(group));
  uses.of_viz.push_back(command.option("--threshold", options.threshold, "Keep only edges with P above this")
                            .range(0.0, 1.0)
                            .group(group));
  command
      .flag("--viz-transfer", options.params.viz_params.matrix,
            "Also trace the transfer matrices of `hier --operator matrix` (120 kB an edge at degree 9)")
      .group(group);
}

void add_transport_options(Command command, BakeOptions& options, BakeUses& uses) {
  const std::string group = "Transport: --operator surfel|bounce, --viz links, --fit";
  gi::TransportParams& params = options.transport.transport;
  params.directions = 1536;  // Nobody waits for a frame: few probes are right to 3 % with these.
  const auto transport = [&](const Option& option) { uses.of_transport.push_back(option.group(group)); };
  transport(command.option("--directions", params.directions, "Rays by which each probe sees surfels")
                .range(8, 1 << 16));
  transport(command
                .option("--surfel-size", params.surfel_size,
                        "Edge of a surfel [m]; 0: a thirty-second of the scene's radius, within 0.04..0.5")
                .non_negative());
  transport(command
                .option("--link-rays", params.link_rays,
                        "Rays by which each surfel finds what lights it: fewer are faster and noisier")
                .range(4, 1 << 16));
  command
      .flag("--fit", options.transport.fit,
            "Also fit lookup weights at the surfels and store them with the probes")
      .group(group);
}

}  // namespace

void add_bake_command(Command app, Context& context) {
  auto options = std::make_shared<BakeOptions>();
  auto uses = std::make_shared<BakeUses>();
  Command command =
      add_command(app, context, "bake",
                  "Find the light at every SPHL of a scene (GEN or transport) and between them (VIZ)",
                  [&context, options, uses] {
                    options->of_paths = names_of_given(uses->of_paths);
                    options->of_transport = names_of_given(uses->of_transport);
                    options->of_viz = names_of_given(uses->of_viz);
                    bake(context, *options);
                  });
  add_scene_options(command, options->scene);
  add_place_options(command, options->place);
  add_probe_file(command, "-o,--output", options->output,
                 "Probe file to write: .sphl (binary) or .sphl.json (JSON, five digits)")
      .required();
  command.option("--degree", options->degree, "Highest spherical harmonics band, 0..10")
      .range(0, sh::max_degree);
  command.choice("--operator", options->op,
                 "What finds the probes' light: path (GEN: path tracing, up to --max-depth bounces), surfel "
                 "(transport between patches of surface: every bounce, no noise, seconds; surfaces reflect "
                 "diffusely), bounce (the same with the probes as the only unknowns)");
  add_path_options(command, *options, *uses);
  add_viz_options(command, *options, *uses);
  add_transport_options(command, *options, *uses);
  add_farm_options(command, options->farm);
  command.footer(
      "An interrupted bake leaves OUTPUT.checkpoint; the same command continues there and gives the same "
      "bits.");
}

}  // namespace ssphh::app
