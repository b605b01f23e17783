#include <csignal>
#include <cstdlib>
#include <new>

#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>

#include "command.h"
#include "stderr_progress.h"

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
  Context context;
  CLI::App app{"ssphh: global illumination from hierarchies of spherical-harmonics light probes"};
  app.set_version_flag("--version", std::string("ssphh ") + SSPHH_VERSION);
  app.require_subcommand(1);
  app.footer(
      "SCENE is a file (.glb .gltf .obj) or builtin:NAME (see `ssphh scene list`).\n"
      "Exit codes: 0 success, 1 failure (bad input, cancelled), 2 wrong usage.");

  add_commands(app, context);

  const auto called = [&](const CLI::App* command) { return command->check_name(argv[1]); };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(called).empty()) {
    log(LogLevel::error, fmt::format("no command '{}'; see ssphh --help", argv[1]));
    return usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? success : usage;
  }

  StderrProgress progress(progress_style(context.progress));
  context.control = {&progress, &cancel_token};
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is an error that is told, as a full disk
  set_thread_count(context.threads);
  try {
    context.run();
    return context.exit_code;
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
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    ssphh::log(ssphh::LogLevel::error,
               "this build needs a CPU with AVX2 and FMA (configure with -DSSPHH_ARCH=x86-64)");
    return 1;
  }
  return ssphh::app::run(argc, argv);
}
