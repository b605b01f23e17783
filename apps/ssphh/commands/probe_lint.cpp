
#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "commands/probe.h"
#include "options/probe_options.h"
#include "results/json_values.h"

namespace ssphh::app {
namespace {

const std::string& probe_name(const ProbeLintResult& result, const study::LintProblem& problem) {
  return result.set.probes[problem.probe].name;
}

}  // namespace

ProbeLintResult run_probe_lint(const ProbeLintOptions& options, const Control& control) {
  ProbeLintResult result{probes::read_probe_file(options.input), {}};
  const probes::ProbeSet& set = result.set;
  const scene::Scene scene = load_lit_scene(options.scene);
  study::LintParams params = options.params;
  params.interest = place::place_params(scene, set.generator.time).interest;
  const trace::TransportScene source(scene);
  require_same_scene(options.input, set, scene, source.light_groups(), {}, options.force);
  result.problems = study::lint_probes(set, source, params, control);
  return result;
}

bool has_failed(const ProbeLintResult& result, const ProbeLintOptions&) {
  return !result.problems.empty();
}

json::Value to_json(const ProbeLintResult& result, const ProbeLintOptions&) {
  json::Value list = json::Value::array();
  for (const study::LintProblem& problem : result.problems) {
    list.push_back({{"kind", name_of(problem.kind)},
                    {"probe", problem.probe < 0 ? json::Value() : json::Value(probe_name(result, problem))},
                    {"position", to_json(problem.position)},
                    {"message", problem.message}});
  }
  return {{"probes", result.set.probes.size()}, {"problems", std::move(list)}};
}

std::string to_text(const ProbeLintResult& result, const ProbeLintOptions& options) {
  std::string text;
  for (const study::LintProblem& problem : result.problems) {
    const vec3& p = problem.position;
    text += fmt::format("{}: {}at ({:.6g}, {:.6g}, {:.6g}) m: {}\n", name_of(problem.kind),
                        problem.probe < 0 ? "" : fmt::format("probe \"{}\" ", probe_name(result, problem)),
                        p.x, p.y, p.z, problem.message);
  }
  const std::size_t count = result.problems.size();
  return text + fmt::format("{}: {}, {}", options.input, counted(result.set.probes.size(), "probe"),
                            count == 0 ? "no problems" : counted(count, "problem"));
}

void add_probe_lint_command(Command group, Context& context) {
  auto [command, o] = add_command(group, context, "lint",
                                  "Look for probes that light nothing or light it wrongly", run_probe_lint);
  add_probe_file(command, "FILE", o.input, "Probe file").required();
  add_scene_options(command, o.scene, false, "--scene");
  command
      .option("--clearance", o.params.clearance,
              "Least distance from a surface [m]; default: 0.04, or a twentieth of the median distance "
              "of neighbours where that is less")
      .positive();
  command
      .option("--negative", o.params.negative_tolerance,
              "How far the irradiance may fall under 0, in shares of its mean")
      .non_negative();
  command
      .option("--spacing", o.params.spacing,
              "Distance of the places that must see a probe [m]; default: some 100 to 200 places")
      .positive();
  add_force_option(command, o.force);
  command.footer(
      "Reports probes that hold no number, lie inside a body, are too close to a surface, stand in the way "
      "of a\n"
      "moving part, are unlit, see no other probe or give negative irradiance; rooms that are unlit or in "
      "which\n"
      "no probe is to be seen. Exit code 1 when there are problems.");
}

}  // namespace ssphh::app
