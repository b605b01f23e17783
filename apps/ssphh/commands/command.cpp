#include "commands/command.h"

#include <cerrno>
#include <cstdio>

#include <fmt/format.h>

namespace ssphh::app {

void Context::result(const json::Value& object, const std::string& text) const {
  const std::string out = json ? json::print(object, 2) : text;
  if (std::fputs(out.c_str(), stdout) < 0 || std::fputc('\n', stdout) == EOF || std::fflush(stdout) != 0) {
    if (errno == EPIPE) throw ReaderGone();
    throw Error("stdout", "cannot write the result");
  }
}

Command add_command(Command parent, Context& context, const std::string& name, const std::string& description,
                    std::function<void()> action) {
  Command command = parent.command(name, description);
  const Command common = command.under("Common");
  common.flag("--json", context.json, "Print one JSON object on stdout and nothing else there");
  common.option("--seed", context.seed, "Seed of all random numbers; the same seed gives the same bits");
  common.option("--threads", context.threads, "Worker threads; 0: all. Does not change results")
      .range(0, 4096)
      .settable();
  common.choice("--progress", context.progress, "Progress on stderr: auto, bar, plain, json or none")
      .settable();
  common
      .flag("--log-json", context.log_json,
            "Messages on stderr as JSON, one object a line; --progress auto, too")
      .settable();
  common.option("--config", context.config,
                "File of defaults in place of the user's own; none: no defaults, nor variables SSPHH_… "
                "(docs/commands.md)");
  command.when_chosen([&context, action = std::move(action)] { context.run = action; });
  return command;
}

Command add_group(Command parent, const std::string& name, const std::string& description) {
  const Command group = parent.command(name, description);
  group.needs_command();
  return group;
}

void add_commands(Command app, Context& context) {
  for (AddCommand* add :
       {add_respond_command,  add_scene_commands,      add_render_command,    add_bake_command,
        add_place_command,    add_hier_command,        add_probe_commands,    add_sh_commands,
        add_cubemap_commands, add_compare_command,     add_truth_command,     add_export_command,
        add_leak_command,     add_measure_command,     add_methods_command,   add_relight_command,
        add_broker_command,   add_bench_frame_command, add_turntable_command, add_view_command,
        add_worker_command,   add_farm_commands,       add_report_command,    add_cook_command,
        add_sphl_commands,    add_lightmap_command,    add_web_command,       add_doctor_command})
    add(app, context);
}

}  // namespace ssphh::app
