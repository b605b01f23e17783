#include "commands/hier.h"

#include <cstdlib>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/probes/probe_file.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

/// "GROUP=R,G,B" or "GROUP=X"; the last '=' separates, so that names may hold some.
void apply_scale(probes::ProbeSet& set, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const auto fail = [&]() -> Error {
    return {"--scale " + text, "must be GROUP=R,G,B or GROUP=X", "e.g. --scale lamp=0.5"};
  };
  if (equals == std::string::npos) throw fail();
  vec3 scale(0);
  const std::string numbers = text.substr(equals + 1);
  const char* at = numbers.c_str();
  for (int c = 0; c < 3; ++c) {
    char* end = nullptr;
    scale[c] = std::strtof(at, &end);
    if (end == at) throw fail();
    if (c == 0 && *end == '\0') {
      scale = vec3(scale.x);
      at = end;
      break;
    }
    if (c < 2 && *end != ',') throw fail();
    at = c < 2 ? end + 1 : end;
  }
  if (*at != '\0') throw fail();
  probes::relight(set, text.substr(0, equals), scale);
}

std::string light_of(const probes::GeneratorInfo& g) {
  return g.op == probes::LightOperator::path ? fmt::format("GEN {}", name_of(g.gen))
                                             : fmt::format("light by {}", name_of(g.op));
}

}  // namespace

HierResult run_hier(const HierOptions& options, const Control&) {
  HierResult result;
  probes::ProbeSet& set = result.set = probes::read_probe_file(options.input);
  for (const std::string& scale : options.scales) apply_scale(set, scale);
  if (probes::edge_count(set) == 0 && set.probes.size() > 1) {
    log_warning("{} has no edges between its probes, so HIER adds nothing; bake with --viz links or path",
                options.input);
  }

  // Once to take the memory, then timed as a frame would do it: the median of some.
  result.edges = probes::hier(set, options.params);
  std::vector<double> times;
  for (int run = 0; run < 7; ++run) {
    const Stopwatch watch;
    probes::hier(set, options.params);
    times.push_back(watch.seconds());
  }
  result.seconds = percentile(std::move(times), 0.5);
  probes::write_probe_file(set, options.output);
  result.contraction = probes::hier_contraction(set, options.params);
  return result;
}

json::Value to_json(const HierResult& result, const HierOptions& options) {
  const probes::GeneratorInfo& generator = result.set.generator;
  return {{"output", options.output},
          {"seconds", result.seconds},
          {"edges", result.edges},
          {"operator", name_of(options.params.op)},
          {"neighbors", options.params.neighbors},
          {"threshold", options.params.threshold},
          {"probes", result.set.probes.size()},
          {"contraction", result.contraction ? json::Value(result.contraction->upper) : json::Value()},
          {"gen", name_of(generator.gen)},
          {"light", name_of(generator.op)},
          {"viz", name_of(generator.viz)}};
}

std::string to_text(const HierResult& result, const HierOptions& options) {
  const std::string shrinks =
      result.contraction
          ? fmt::format("; another application would change light by up to {:.3g}", result.contraction->upper)
          : "";
  return fmt::format("{}: {} between {}, operator {}, {}: {:.1f} us{}", options.output,
                     counted(result.edges, "edge"), counted(result.set.probes.size(), "probe"),
                     name_of(options.params.op), light_of(result.set.generator), 1e6 * result.seconds,
                     shrinks);
}

void add_hier_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "hier", "Add each probe's neighbours to its light (HIER)", run_hier);
  add_probe_file(command, "FILE", o.input, "Probe file of `ssphh bake`").required();
  add_probe_output(command, "-o,--output", o.output, "Probe file to write: .sphl or .sphl.json").required();
  command.choice(
      "--operator", o.params.op,
      "What H (x) S means: coefficient (the paper's, coefficient by coefficient, and a factor that "
      "makes two constants multiply right), raw (the same without the factor), mean (H times "
      "the mean of S), matrix (exact for SPHLs that are lights; bake with --viz-transfer)");
  command
      .option("--neighbors", o.params.neighbors,
              "At most so many neighbours per probe, strongest P first; -1: all")
      .range(-1, 65536);
  command.option("--threshold", o.params.threshold, "Only neighbours with P above this").non_negative();
  command
      .option("--scale", o.scales,
              "Switch, dim or recolour a light group first: GROUP=R,G,B or GROUP=X, relative to the "
              "bake; repeatable")
      .repeatable();
  command.footer(
      "Probes of GEN full or of operator surfel or bounce hold the neighbours' light already, so HIER counts "
      "it\n"
      "twice: bake with --gen local to see what the hierarchy alone transports. The time is the median of "
      "seven runs.");
}

}  // namespace ssphh::app
