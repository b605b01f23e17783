#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/gi/bake.h>
#include <ssphh/gi/init.h>
#include <ssphh/trace/path_tracer.h>

#include "command.h"
#include "place_options.h"
#include "probe_options.h"
#include "scene_options.h"

namespace ssphh::app {
namespace {

/// VIZ takes a pass over all probes for each probe; nobody waits for that unasked.
constexpr std::size_t most_probes_for_viz = 64;

struct BakeOptions {
  SceneOptions scene;
  PlaceOptions place;
  std::string output, gen = "full", viz;
  int degree = 9;
  gi::BakeParams params;
  bool resume = true;
};

void bake(Context& context, BakeOptions& options) {
  const scene::Scene scene = load_scene(options.scene);
  gi::BakeParams& params = options.params;
  params.gen = *gi::parse_gen_mode(options.gen);
  params.path.seed = context.seed;
  if (params.viz_transfer && options.viz == "off") {
    throw Error("--viz-transfer", "needs VIZ", "leave out --viz off");
  }

  const std::optional<PlaceResult> place =
      place_for(scene, options.scene.time, options.place, "", context.control);
  gi::ProbeSet set =
      place ? gi::init_from_placement(scene, place->placement, options.degree, options.scene.time)
            : gi::init_from_scene(scene, options.degree, options.scene.time);
  params.viz = options.viz == "on" || params.viz_transfer ||
               (options.viz.empty() && set.probes.size() <= most_probes_for_viz);
  if (!params.viz && options.viz.empty()) {
    log_info("VIZ is left out for {} probes, which are more than {}: --viz on if HIER is to run",
             set.probes.size(), most_probes_for_viz);
  }
  const trace::PathTracer tracer(scene, options.scene.time);
  const std::filesystem::path checkpoint = options.output + ".checkpoint";
  if (!options.resume) std::filesystem::remove(checkpoint);
  gi::BakeReport report;
  set = gi::bake(tracer, std::move(set), params, checkpoint, report, context.control);
  gi::write_probe_file(set, options.output);
  std::filesystem::remove(checkpoint);

  const std::size_t edges = gi::edge_count(set);
  std::string text = fmt::format(
      "{}: {} probes of degree {}, {} light groups, {} edges\nGEN {:.2f} s, VIZ {:.2f} s, {} rays",
      options.output, set.probes.size(), set.degree, set.light_groups.size(), edges, report.gen_seconds,
      report.viz_seconds, report.rays);
  if (report.resumed > 0)
    text += fmt::format("\n{} of {} steps were taken from the checkpoint", report.resumed,
                        set.probes.size() * (params.viz ? 2 : 1));
  if (place) text += "\n" + place_text(*place);
  nlohmann::ordered_json object = {{"output", options.output},
                                   {"probes", set.probes.size()},
                                   {"degree", set.degree},
                                   {"light_groups", set.light_groups.size()},
                                   {"edges", edges},
                                   {"gen", options.gen},
                                   {"gen_seconds", report.gen_seconds},
                                   {"viz_seconds", report.viz_seconds},
                                   {"rays", report.rays},
                                   {"resumed", report.resumed},
                                   {"viz", params.viz},
                                   {"warnings", report.warnings}};
  if (place) object["placement"] = place_json(*place);
  context.result(object, text);
}

}  // namespace

void add_bake_command(CLI::App& app, Context& context) {
  auto options = std::make_shared<BakeOptions>();
  gi::BakeParams& params = options->params;
  CLI::App* command = add_command(
      app, context, "bake", "Path trace the light at every SPHL of a scene (GEN) and between them (VIZ)",
      [&context, options] { bake(context, *options); });
  add_scene_options(*command, options->scene);
  add_place_options(*command, options->place);
  command
      ->add_option("-o,--output", options->output,
                   "Probe file to write: .sphl (binary) or .sphl.json (JSON, five digits)")
      ->check(probe_file_name())
      ->required();
  command->add_option("--degree", options->degree, "Highest spherical harmonics band, 0..10")
      ->check(CLI::Range(0, sh::max_degree))
      ->capture_default_str();
  command->add_option("--face", params.face_size, "Texels along a face of each probe's cube map")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command
      ->add_option("--max-depth", params.path.max_depth,
                   "Surface scatterings of a path: 0 emitters only, 1 direct light, ...")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--passes", params.path.passes, "Passes of --spp samples each")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command->add_option("--spp", params.path.spp, "Samples per texel and pass")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command
      ->add_option("--gen", options->gen,
                   "full: all bounces; local: direct light only (--max-depth 1), for HIER to add the rest")
      ->check(CLI::IsMember({"full", "local"}))
      ->capture_default_str();
  command
      ->add_option("--viz", options->viz,
                   fmt::format("Whether to trace the light between the SPHLs, which HIER needs; default: on "
                               "for up to {} probes",
                               most_probes_for_viz))
      ->check(CLI::IsMember({"on", "off"}));
  command->add_flag(
      "--viz-transfer", params.viz_transfer,
      "Also keep the transfer matrices of `hier --operator matrix` (120 kB an edge at degree 9)");
  command->add_flag(
      "--resume,!--no-resume", options->resume,
      "Continue an interrupted bake of the same scene and options from OUTPUT.checkpoint (the default)");
  command->footer(
      "An interrupted bake leaves OUTPUT.checkpoint; the same command continues there and gives the same "
      "bits.");
}

}  // namespace ssphh::app
