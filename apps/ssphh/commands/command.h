#pragma once
/// How a command of the tool is made: one file <name>.cpp per command, one line in add_commands(). What a
/// command does is a function of its own, run_<name>() in <name>.h, from a struct of options to a struct of
/// results that to_json() and to_text() say.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

#include "options/command_line.h"
#include "options/settings.h"
#include "results/stderr_progress.h"

namespace ssphh::app {

/// Whoever read the result has gone, as `head` does: nothing is wrong, and nobody is told.
struct ReaderGone {};

/// What every command shares.
struct Context {
  bool json = false;
  std::uint64_t seed = 0;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::automatic;
  bool log_json = false;
  std::string config;         ///< as the command line has it; `settings` are what was read
  Settings settings;          ///< defaults of the user's own
  Control control;            ///< progress on stderr, cancelled by Ctrl-C
  std::function<void()> run;  ///< set by the chosen command while options are parsed
  int exit_code = 0;          ///< of a command that gave a result and still has to report a failure

  /// The command's result: with --json the object alone on stdout, else `text`. Throws Error where it cannot
  /// be written, ReaderGone where nobody reads it.
  void result(const json::Value& object, const std::string& text) const;
};

template <class Options, class Run>
void run_and_print(Context& context, Options& options, const Run& run) {
  if constexpr (requires { options.seed; }) options.seed = context.seed;
  if constexpr (requires { options.threads; }) options.threads = context.threads;
  if constexpr (requires { options.settings; }) options.settings = context.settings;
  const auto result = run(options, context.control);
  if constexpr (requires { has_failed(result, options); }) {
    if (has_failed(result, options)) context.exit_code = 1;
  }
  context.result(to_json(result, options), to_text(result, options));
}

/// A leaf command with the common options (--json, --seed, --threads, --progress, --log-json, --config).
/// `action` runs after parsing; it throws Error for bad input.
Command add_command(Command parent, Context& context, const std::string& name, const std::string& description,
                    std::function<void()> action);

/// A command and the options that it runs with, which live as long as it does.
template <class Options>
struct Added {
  Command command;
  Options& options;
};

template <class Options>
Added<Options> add_command(Command parent, Context& context, const std::string& name,
                           const std::string& description, std::function<void(Options&)> action) {
  const auto options = std::make_shared<Options>();
  return {add_command(parent, context, name, description, [options, action] { action(*options); }), *options};
}

/// One that runs a function of options, `run(options, control)`, and prints its result. --seed, --threads
/// and the user's settings go into the options' members of these names, where they have such; a result of
/// which has_failed() is true is printed and gives exit code 1.
template <class Options, class Result>
Added<Options> add_command(Command parent, Context& context, const std::string& name,
                           const std::string& description, Result (*run)(const Options&, const Control&)) {
  return add_command<Options>(parent, context, name, description,
                              [&context, run](Options& options) { run_and_print(context, options, run); });
}

/// A command that only groups subcommands ("sh project", "probe info").
Command add_group(Command parent, const std::string& name, const std::string& description);

/// All of them.
void add_commands(Command app, Context& context);

/// Adds a command, or a group with its commands.
using AddCommand = void(Command parent, Context& context);
AddCommand add_respond_command, add_scene_commands, add_render_command, add_bake_command, add_place_command,
    add_hier_command, add_probe_commands, add_probe_lint_command, add_probe_export_command,
    add_probe_blend_command, add_probe_convert_command, add_probe_import_command, add_sh_commands,
    add_cubemap_commands, add_broker_command, add_compare_command, add_export_command, add_truth_command,
    add_report_command, add_leak_command, add_measure_command, add_methods_command, add_relight_command,
    add_bench_frame_command, add_turntable_command, add_view_command, add_worker_command, add_farm_commands,
    add_cook_command, add_sphl_commands, add_lightmap_command, add_web_command, add_doctor_command;

}  // namespace ssphh::app
