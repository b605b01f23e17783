#include "commands/command.h"

#include <cstdio>

#include <fmt/format.h>

namespace ssphh::app {

void Context::result(const json::Value& object, const std::string& text) const {
  const std::string out = json ? json::print(object, 2) : text;
  if (std::fputs(out.c_str(), stdout) < 0 || std::fputc('\n', stdout) == EOF || std::fflush(stdout) != 0) {
    throw Error("stdout", "cannot write the result");
  }
}

Command add_command(Command parent, Context& context, const std::string& name, const std::string& description,
                    std::function<void()> action) {
  Command command = parent.command(name, description);
  const std::string group = "Common";
  command.flag("--json", context.json, "Print one JSON object on stdout and nothing else there").group(group);
  command.option("--seed", context.seed, "Seed of all random numbers; the same seed gives the same bits")
      .group(group);
  command.option("--threads", context.threads, "Worker threads; 0: all. Does not change results")
      .range(0, 4096)
      .group(group);
  command.option("--progress", context.progress, "Progress on stderr: auto, bar, plain, json or none")
      .one_of({"auto", "bar", "plain", "json", "none"})
      .group(group);
  command.when_chosen([&context, action = std::move(action)] { context.run = action; });
  return command;
}

Command add_group(Command parent, const std::string& name, const std::string& description) {
  const Command group = parent.command(name, description);
  group.needs_command();
  return group;
}

void add_commands(Command app, Context& context) {
  add_respond_command(app, context);
  add_scene_commands(app, context);
  add_render_command(app, context);
  add_bake_command(app, context);
  add_place_command(app, context);
  add_hier_command(app, context);
  add_probe_commands(app, context);
  add_sh_commands(app, context);
  add_cubemap_commands(app, context);
  add_compare_command(app, context);
  add_truth_command(app, context);
  add_export_command(app, context);
  add_leak_command(app, context);
  add_measure_command(app, context);
  add_methods_command(app, context);
  add_relight_command(app, context);
  add_broker_command(app, context);
  add_bench_frame_command(app, context);
  add_turntable_command(app, context);
  add_view_command(app, context);
  add_worker_command(app, context);
  add_farm_commands(app, context);
  add_report_command(app, context);
}

}  // namespace ssphh::app
