#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/version.h>

#include "commands/command.h"
#include "results/stderr_log.h"
#include "results/stderr_progress.h"

namespace ssphh::app {
namespace {

CancelToken cancel_token;

// The first Ctrl-C asks the work to stop cleanly; a second one ends the process at once.
extern "C" void on_signal(int signal) {
  if (cancel_token.requested()) std::_Exit(128 + signal);
  cancel_token.request();
}

enum ExitCode { success = 0, failure = 1, usage = 2 };

int fail(const Context& context, const std::string& message) {
  log(LogLevel::error, message);
  if (context.json) context.result({{"error", message}}, "");
  return failure;
}

int run(int argc, char** argv) {
  if (wants_colour(::isatty(STDERR_FILENO) != 0)) log_in_colour();
  Context context;
  const CommandLine line("ssphh: global illumination from hierarchies of spherical-harmonics light probes");
  const Command app = line.root();
  line.version(std::string("ssphh ") + SSPHH_VERSION);
  app.needs_command();
  app.footer(
      "SCENE is a file (.glb .gltf .obj) or builtin:NAME (see `ssphh scene list`).\n"
      "Exit codes: 0 success, 1 failure (bad input, cancelled), 2 wrong usage.");

  add_commands(app, context);

  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) words.emplace_back("--help");
  if (std::ranges::count(words, "--log-json") > 0) log_as_json();  // what is wrong with the line, too
  try {
    if (!words[0].starts_with('-')) {
      context.settings = read_settings(words, line.settable());
      apply_settings(line, context.settings);
    }
    line.parse(words);
  } catch (const ParsingEnded& ended) {
    if (!ended.help.empty()) {
      log(LogLevel::error, fmt::format("{} (see {})", ended.what(), ended.help));
      return usage;
    }
    std::fputs(ended.what(), stdout);
    return success;
  } catch (const Error& e) {
    log(LogLevel::error, e.what());
    return usage;
  }

  if (context.log_json) {
    log_as_json();
    if (context.progress == ProgressStyle::automatic) context.progress = ProgressStyle::json;
  }
  StderrProgress progress(context.progress);
  context.control = {&progress, &cancel_token};
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is an error that is told, as a full disk
  set_thread_count(context.threads);
  try {
    context.run();
    return context.exit_code;
  } catch (const ReaderGone&) {
    // As any tool ends in a pipe
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
    return failure;
  } catch (const Cancelled&) {
    return fail(context, "cancelled");
  } catch (const std::bad_alloc&) {
    return fail(context, "out of memory");
  } catch (const std::exception& e) {
    return fail(context, e.what());
  }
}

}  // namespace
}  // namespace ssphh::app

int main(int argc, char** argv) {
  return ssphh::app::run(argc, argv);
}
