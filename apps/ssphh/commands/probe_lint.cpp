#include <memory>

#include <fmt/format.h>

#include <ssphh/place/place.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/study/lint.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "options/scene_options.h"

namespace ssphh::app {
namespace {

struct LintOptions {
  SceneOptions scene;
  std::string input;
  study::LintParams params;
  bool force = false;
};

void lint(Context& context, LintOptions& options) {
  const probes::ProbeSet set = probes::read_probe_file(options.input);
  const scene::Scene scene = load_scene(options.scene);
  options.params.interest = place::place_params(scene, set.generator.time).interest;
  const trace::TransportScene source(scene);
  require_same_scene(options.input, set, scene, source.light_groups(), {}, options.force);
  const std::vector<study::LintProblem> problems =
      study::lint_probes(set, source, options.params, context.control);

  json::Value list = json::Value::array();
  std::string text;
  for (const study::LintProblem& problem : problems) {
    const std::string name =
        problem.probe < 0 ? "" : set.probes[static_cast<std::size_t>(problem.probe)].name;
    const vec3& p = problem.position;
    json::Value entry = {{"kind", name_of(problem.kind)},
                         {"probe", nullptr},
                         {"position", {p.x, p.y, p.z}},
                         {"message", problem.message}};
    if (problem.probe >= 0) entry["probe"] = name;
    list.push_back(std::move(entry));
    text += fmt::format("{}: {}at ({:.6g}, {:.6g}, {:.6g}) m: {}\n", name_of(problem.kind),
                        problem.probe < 0 ? "" : fmt::format("probe \"{}\" ", name), p.x, p.y, p.z,
                        problem.message);
  }
  text += fmt::format("{}: {} probes, {}", options.input, set.probes.size(),
                      problems.empty() ? "no problems" : fmt::format("{} problems", problems.size()));
  context.result({{"probes", set.probes.size()}, {"problems", std::move(list)}}, text);
  if (!problems.empty()) context.exit_code = 1;
}

}  // namespace

void add_probe_lint_command(Command group, Context& context) {
  auto options = std::make_shared<LintOptions>();
  Command command =
      add_command(group, context, "lint", "Look for probes that light nothing or light it wrongly",
                  [&context, options] { lint(context, *options); });
  add_probe_file(command, "FILE", options->input, "Probe file").required();
  add_scene_options(command, options->scene, false, "--scene");
  command
      .option("--clearance", options->params.clearance,
              "Least distance from a surface [m]; default: 0.04, or a twentieth of the median distance "
              "of neighbours where that is less")
      .positive();
  command
      .option("--negative", options->params.negative_tolerance,
              "How far the irradiance may fall under 0, in shares of its mean")
      .non_negative();
  command
      .option("--spacing", options->params.spacing,
              "Distance of the places that must see a probe [m]; default: some 100 to 200 places")
      .positive();
  add_force_option(command, options->force);
  command.footer(
      "Reports probes that hold no number, lie inside a body, are too close to a surface, stand in the way "
      "of a\n"
      "moving part, are unlit, see no other probe or give negative irradiance; rooms that are unlit or in "
      "which\n"
      "no probe is to be seen. Exit code 1 when there are problems.");
}

}  // namespace ssphh::app
