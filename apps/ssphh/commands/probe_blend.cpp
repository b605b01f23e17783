#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>

#include "commands/command.h"
#include "commands/probe.h"
#include "options/probe_options.h"

namespace ssphh::app {

ProbeBlendResult run_probe_blend(const ProbeBlendOptions& o, const Control&) {
  ProbeBlendResult result;
  const probes::ProbeSet from = probes::read_probe_file(o.from), to = probes::read_probe_file(o.to);
  try {
    result.blended = probes::blend(from, to, o.t);
  } catch (const Error& e) {
    throw Error(fmt::format("{}, {}", o.from, o.to), e.problem(), e.hint());
  }
  const std::vector<std::string>& left_out = result.blended.left_out;
  if (!left_out.empty()) log_warning("{}: not blended: {}", o.output, fmt::join(left_out, ", "));
  if (from.generator.scene_hash != to.generator.scene_hash)
    log_warning(
        "{}: the sets are of other lights or surfaces, so that no scene is that of their blend: look it up "
        "with --force",
        o.output);
  probes::write_probe_file(result.blended.set, o.output);
  return result;
}

json::Value to_json(const ProbeBlendResult& result, const ProbeBlendOptions& o) {
  const probes::ProbeSet& set = result.blended.set;
  return {{"output", o.output},
          {"t", o.t},
          {"time", set.generator.time},
          {"probes", set.probes.size()},
          {"records", set.surface ? set.surface->points.size() : 0},
          {"left_out", result.blended.left_out}};
}

std::string to_text(const ProbeBlendResult& result, const ProbeBlendOptions& o) {
  const probes::ProbeSet& set = result.blended.set;
  return fmt::format("{}: {}, {}, {:g} of the way from {} to {}", o.output,
                     counted(set.probes.size(), "probe"),
                     counted(set.surface ? set.surface->points.size() : 0, "record"), o.t, o.from, o.to);
}

void add_probe_blend_command(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "blend",
                  "Blend two baked sets of the same places, as a moment between two bakes", run_probe_blend);
  add_probe_file(command, "FROM", o.from, "Probe file at t = 0").required();
  add_probe_file(command, "TO", o.to, "Probe file at t = 1").required();
  command.option("--t", o.t, "Share of TO").range(0.0, 1.0);
  add_probe_output(command, "-o,--output", o.output, "Probe file to write").required();
}

}  // namespace ssphh::app
