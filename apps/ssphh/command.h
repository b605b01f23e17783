#pragma once
/// How a command of the tool is made: one file cmd_<name>.cpp per command, one line in add_commands().

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

namespace ssphh::app {

/// What every command shares.
struct Context {
  bool json = false;
  std::uint64_t seed = 0;
  int threads = 0;
  std::string progress = "auto";
  Control control;            ///< progress on stderr, cancelled by Ctrl-C
  std::function<void()> run;  ///< set by the chosen command while options are parsed
  int exit_code = 0;          ///< of a command that gave a result and still has to report a failure

  /// The command's result: with --json the object alone on stdout, else `text`.
  void result(const json::Value& object, const std::string& text) const;
};

/// A leaf command with the common options (--json, --seed, --threads, --progress). `action` runs after
/// parsing; it throws Error for bad input.
CLI::App* add_command(CLI::App& parent, Context& context, const std::string& name,
                      const std::string& description, std::function<void()> action);

/// A command that only groups subcommands ("sh project", "probe info").
CLI::App* add_group(CLI::App& parent, const std::string& name, const std::string& description);

/// All of them.
void add_commands(CLI::App& app, Context& context);

void add_respond_command(CLI::App& app, Context& context);
void add_scene_commands(CLI::App& app, Context& context);
void add_render_command(CLI::App& app, Context& context);
void add_bake_command(CLI::App& app, Context& context);
void add_place_command(CLI::App& app, Context& context);
void add_hier_command(CLI::App& app, Context& context);
void add_probe_commands(CLI::App& app, Context& context);
void add_probe_lint_command(CLI::App& group, Context& context);
void add_sh_commands(CLI::App& app, Context& context);
void add_cubemap_commands(CLI::App& app, Context& context);
void add_broker_command(CLI::App& app, Context& context);
void add_compare_command(CLI::App& app, Context& context);
void add_export_command(CLI::App& app, Context& context);
void add_truth_command(CLI::App& app, Context& context);
void add_report_command(CLI::App& app, Context& context);
void add_leak_command(CLI::App& app, Context& context);
void add_measure_command(CLI::App& app, Context& context);
void add_methods_command(CLI::App& app, Context& context);
void add_relight_command(CLI::App& app, Context& context);
void add_bench_frame_command(CLI::App& app, Context& context);
void add_turntable_command(CLI::App& app, Context& context);
void add_view_command(CLI::App& app, Context& context);
void add_worker_command(CLI::App& app, Context& context);
void add_farm_commands(CLI::App& app, Context& context);

}  // namespace ssphh::app
