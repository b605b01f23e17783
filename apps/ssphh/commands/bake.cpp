#include "commands/bake.h"

#include <memory>

#include <fmt/format.h>

#include "commands/command.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

/// --viz as it is typed, and the options that stand only with path tracing, transport or VIZ.
struct BakeUses {
  std::string viz;
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
  bake::BakeParams& params = options.params;
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
      .option("--viz", uses.viz,
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
                              default_link_neighbors))
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
  transport::TransportParams& params = options.transport.transport;
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
                  options, [uses](BakeOptions& o, const Control& control) {
                    if (!uses->viz.empty())
                      o.viz = parse_enum<probes::VizMethod>(uses->viz).value_or(probes::VizMethod::none);
                    o.of_paths = names_of_given(uses->of_paths);
                    o.of_transport = names_of_given(uses->of_transport);
                    o.of_viz = names_of_given(uses->of_viz);
                    return run_bake(o, control);
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
