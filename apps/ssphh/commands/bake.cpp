#include "commands/bake.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands/bake_watch.h"
#include "commands/command.h"
#include "options/picture_options.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

/// --viz as it is typed, and the options that stand only with path tracing, transport or VIZ, or only without
/// an update.
struct BakeUses {
  std::string viz;
  std::optional<bake::Quality> quality;
  std::vector<Option> of_paths, of_transport, of_viz, of_viz_paths, not_of_update;
};

std::vector<std::string> names_of_given(const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options) {
    if (option.given()) names.push_back(option.name());
  }
  return names;
}

void add_path_options(const Command& paths, BakeOptions& options, BakeUses& uses) {
  bake::BakeParams& params = options.params;
  uses.of_paths = {
      paths.option("--face", params.face_size, "Texels along a face of each probe's cube map").range(1, 4096),
      paths
          .option("--max-depth", params.path.max_depth,
                  "Surface scatterings of a path: 0 emitters only, 1 direct light, ...")
          .range(0, 65535),
      paths.option("--passes", params.path.passes, "Passes of --spp samples each").range(1, 1 << 24),
      paths.option("--spp", params.path.spp, "Samples per texel and pass").range(1, 1 << 24)};
  uses.of_paths.push_back(paths.choice(
      "--renderer", options.renderer,
      "Whose paths: path, ours; cycles, those of Blender, which must be installed, with files and "
      "log in OUTPUT.cycles"));
  paths.option("--time-limit", options.time_limit, "Seconds that each run of Blender may take")
      .range(1, 1000000);
  paths.choice("--gen", params.gen,
               "full: all bounces; local: direct light only (--max-depth 1), for HIER to add the rest");
  paths.flag(
      "--resume,!--no-resume", options.resume,
      "Continue an interrupted bake of the same scene and options from OUTPUT.checkpoint (the default)");
}

void add_viz_options(const Command& viz, BakeOptions& options, BakeUses& uses) {
  viz.option("--viz", uses.viz,
             fmt::format("path: trace it; links: find it with the surfels of transport, every bounce and "
                         "no noise, surfaces reflect diffusely; off. Default: path for operator path and "
                         "up to {} probes, else links for up to {}",
                         pipeline::most_probes_for_paths, pipeline::most_probes_for_links))
      .one_of({"path", "links", "off"});
  uses.of_viz = {
      viz.option("--neighbors", options.neighbors,
                 fmt::format("Keep at most so many edges per SPHL, strongest P first; -1: all. Default: {} "
                             "with links, all with path",
                             pipeline::default_link_neighbors))
          .range(-1, 65536),
      viz.option("--threshold", options.threshold, "Keep only edges with P above this").non_negative(),
      viz.choice(
          "--viz-source", options.viz_source,
          "What is 1 of the sphere by which an SPHL lights the others: intensity (the paper's; P hardly "
          "depends on the sphere's radius) or radiance (P grows with its square)")};
  uses.of_viz_paths = {
      viz.choice(
          "--viz-paths", options.params.viz_params.paths,
          "Scattering between two SPHLs: all, or diffuse (the paper's {D}*: mirrors and glass are black)"),
      viz.option(
             "--viz-max-depth", options.viz_max_depth,
             "Surface scatterings of a path between two SPHLs; 0: direct sight alone. Default: --max-depth")
          .range(0, 65535),
      viz.option("--viz-passes", options.viz_passes, "Passes of --viz-spp samples. Default: --passes")
          .range(1, 1 << 24),
      viz.option("--viz-spp", options.viz_spp, "Samples per texel and pass. Default: --spp")
          .range(1, 1 << 24)};
  viz.flag("--viz-transfer", options.params.viz_params.matrix,
           "Also trace the transfer matrices of `hier --operator matrix` (120 kB an edge at degree 9)");
}

void add_transport_options(const Command& surfels, BakeOptions& options, BakeUses& uses) {
  transport::TransportParams& params = options.transport.transport;
  uses.of_transport = {
      surfels.option("--directions", params.directions, "Rays by which each probe sees surfels")
          .range(8, 1 << 16),
      surfels
          .option("--surfel-size", params.surfel_size,
                  "Edge of a surfel [m]; 0: a thirty-second of the scene's radius, at most 0.5 and a quarter "
                  "of the probes' distance, and more far from "
                  "probes where that would make too many")
          .non_negative(),
      surfels
          .option("--link-rays", params.link_rays,
                  "Rays by which each surfel finds what lights it: fewer are faster and noisier")
          .range(4, 1 << 16)};
  surfels
      .option("--records", options.records,
              fmt::format("Also keep the light of so many surface points at most, dense where it asks for "
                          "it, and of as many again where those are not seen, for --weights surface; 0: "
                          "none. Default: {} for as many as 150 probes, more for more, {} at most, but none "
                          "with --operator bounce, --gen local or --max-depth below {}",
                          transport::usual_records, pipeline::most_flats * transport::usual_records,
                          rays::usual_max_depth))
      .range(0, 1 << 16);
  surfels.flag("--fit", options.transport.fit,
               "Also fit lookup weights at the surfels and store them with the probes");
}

/// One word for many numbers; those that are given by themselves stand.
void add_effort_options(const Command& effort, BakeOptions& options, std::optional<bake::Quality>& quality) {
  effort.choice(
      "--quality", quality,
      "draft, good (the default) or best: how many paths, rays, surfels and records, where they are not "
      "given by themselves; each takes two to four times as long as the one before");
  effort
      .option(
          "--max-memory", options.max_memory,
          "Memory that surfels and their links may take [GB]; surfels far from probes grow where it is not "
          "enough. Default: half of the machine's")
      .range(0.01, 1e6);
}

/// Puts what the quality says where nothing was given.
void apply_quality(BakeOptions& options, bake::Quality quality) {
  const auto given = [](const std::vector<std::string>& names, const char* name) {
    return std::ranges::find(names, name) != names.end();
  };
  const int spp = options.params.path.spp;
  transport::TransportParams& params = options.transport.transport;
  const transport::TransportParams before = params;
  set_effort(options, quality);
  if (given(options.of_paths, "--spp")) options.params.path.spp = spp;
  if (given(options.of_transport, "--directions")) params.directions = before.directions;
  if (given(options.of_transport, "--link-rays")) params.link_rays = before.link_rays;
}

void add_update_options(const Command& update, BakeOptions& options) {
  add_probe_file(update, "--update", options.update,
                 "Probe file of an earlier bake of this scene, which has changed since: only probes whose "
                 "light has changed are baked, as that file was baked; the others are kept, and with "
                 "--viz off all edges. Surface records, and light by transport, are found anew as a whole");
  update
      .option("--tolerance", options.tolerance,
              "Share of its light by which a kept probe may have changed; 0: whatever few paths see counts. "
              "Default: 0.01, or the noise of the bake where that is more")
      .non_negative();
  add_only_options(update, options.only);
  const Option watch =
      update.flag("--watch", options.watch,
                  "Go on: update OUTPUT whenever SCENE or a file that it names is saved, until Ctrl-C");
  update
      .option(
          "--preview", options.preview,
          "Picture (.png, .jpg, .exr, .hdr) to draw with the probes after each bake, from the scene's first "
          "camera")
      .needs(watch);
  add_tev_option(update, options.tev, "Show that picture in the viewer tev that listens there").needs(watch);
}

}  // namespace

void add_bake_command(Command app, Context& context) {
  const auto uses = std::make_shared<BakeUses>();
  auto [command, o] = add_command<BakeOptions>(
      app, context, "bake",
      "Find the light at every SPHL of a scene (GEN or transport) and between them (VIZ)",
      [&context, uses](BakeOptions& given) {
        if (!uses->viz.empty())
          given.viz = parse_enum<probes::VizMethod>(uses->viz).value_or(probes::VizMethod::none);
        given.of_paths = names_of_given(uses->of_paths);
        given.of_transport = names_of_given(uses->of_transport);
        given.of_viz = names_of_given(uses->of_viz);
        given.of_viz_paths = names_of_given(uses->of_viz_paths);
        given.not_of_update = names_of_given(uses->not_of_update);
        if (uses->quality) apply_quality(given, *uses->quality);
        if (given.watch) {
          run_and_print(context, given, run_bake_watch);
        } else {
          run_and_print(context, given, run_bake);
        }
      });
  add_scene_options(command, o.scene);
  add_place_options(command, o.place);
  add_probe_file(
      command, "-o,--output", o.output,
      "Probe file to write: .sphl (binary), .sphl.json (JSON, five digits), or .tiles: a folder with a "
      "probe file for each part of a large scene")
      .required();
  command.option("--degree", o.degree, "Highest spherical harmonics band, 0..10").range(0, sh::max_degree);
  command.choice(
      "--operator", o.op,
      fmt::format(
          "What finds the probes' light: path (GEN: path tracing, up to --max-depth bounces), surfel "
          "(transport between patches of surface: every bounce, no noise, seconds; surfaces reflect "
          "diffusely), bounce (the same with the probes as the only unknowns). Default: path for up to {} "
          "probes, with a farm or options of path tracing, else surfel",
          pipeline::most_probes_for_paths));
  add_effort_options(command, o, uses->quality);
  add_path_options(command.under("GEN and VIZ: path tracing"), o, *uses);
  add_viz_options(command.under("VIZ: light between the SPHLs, which HIER needs"), o, *uses);
  add_transport_options(command.under("Transport: --operator surfel|bounce, --viz links, --records, --fit"),
                        o, *uses);
  add_update_options(command.under("Update of an earlier bake"), o);
  for (const char* name :
       {"--time",      "--probes",       "--clearance",  "--refine",      "--max-probes",    "--degree",
        "--operator",  "--face",         "--max-depth",  "--passes",      "--spp",           "--gen",
        "--neighbors", "--threshold",    "--viz-source", "--viz-paths",   "--viz-max-depth", "--viz-passes",
        "--viz-spp",   "--viz-transfer", "--directions", "--surfel-size", "--link-rays",     "--records",
        "--fit",       "--quality",      "--max-memory", "--renderer"})
    uses->not_of_update.push_back(command[name]);
  add_farm_options(command, o.farm);
  command.footer(
      "An interrupted bake leaves OUTPUT.checkpoint; the same command continues there and gives the same "
      "bits.");
}

}  // namespace ssphh::app
