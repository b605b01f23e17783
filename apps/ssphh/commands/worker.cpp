#include "commands/worker.h"

#include <atomic>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/farm/disk_cache.h>
#include <ssphh/farm/local_farm.h>

#include "commands/command.h"
#include "commands/cycles.h"

namespace ssphh::app {
namespace {

/// Cycles in a folder of its own, which goes with it.
class CyclesInItsFolder : public CyclesSource {
 public:
  CyclesInItsFolder(const farm::PreparedScene& scene, float time, const CyclesOptions& options)
      : CyclesSource(scene.scene, time, *scene.tracer, options), folder_(options.work) {}
  ~CyclesInItsFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 private:
  std::filesystem::path folder_;
};

/// Several jobs at a time have a folder each within the cache's.
farm::MakeSource cycles_in(const std::filesystem::path& cache) {
  require_blender();
  return
      [cache, number = std::make_shared<std::atomic<int>>(0)](const farm::PreparedScene& scene, float time) {
        const std::filesystem::path work = cache / fmt::format("cycles-{}-{}", ::getpid(), ++*number);
        return std::make_unique<CyclesInItsFolder>(scene, time, CyclesOptions{work, thread_count()});
      };
}

void work(Context& context, WorkerSettings& settings) {
  try {
    run_and_print(context, settings, run_worker);
  } catch (const Error& e) {
    log(LogLevel::error, e.what());
    if (context.json) context.result({{"error", e.what()}}, "");
    context.exit_code = farm::never_retry;
  }
}

}  // namespace

farm::WorkerPoolReport run_worker(const WorkerSettings& settings, const Control& control) {
  farm::WorkerPoolOptions options = pool_options(settings);
  if (options.other.renderer == Renderer::cycles) options.other.make = cycles_in(options.cache);
  set_thread_count(settings.threads);
  set_thread_count(shared_threads(thread_count(), options.slots));
  return farm::run_workers(options, control);
}

json::Value to_json(const farm::WorkerPoolReport& report, const WorkerSettings&) {
  return {{"jobs", report.jobs}, {"busy_seconds", report.busy_seconds}, {"seconds", report.seconds}};
}

std::string to_text(const farm::WorkerPoolReport& report, const WorkerSettings&) {
  return fmt::format("{}, busy {:.1f} s of {:.1f} s", counted(report.jobs, "job"), report.busy_seconds,
                     report.seconds);
}

void add_worker_command(Command app, Context& context) {
  auto [command, o] =
      add_command<WorkerSettings>(app, context, "worker", "Do jobs of a farm: GEN, VIZ and tiles of pictures",
                                  [&context](WorkerSettings& settings) { work(context, settings); });
  const Command worker = command.under("Worker");
  add_required_broker(worker, o.broker, "worker");
  worker.option("--slots", o.pool.slots, "Jobs at a time; they share the scene and --threads").range(1, 1024);
  worker.choice(
      "--renderer", o.pool.other.renderer,
      "Whose paths it has: path, this program's; cycles, those of Blender, which must be installed, "
      "for `bake --renderer cycles` alone");
  worker.option("--name", o.pool.name, "In logs and `farm status`; default: HOST:PID");
  worker.option("--cache", o.cache,
                "Folder of scenes, shared by workers of one machine; default: " +
                    farm::default_cache_dir("scenes").string());
  worker.option("--cache-size", o.cache_mb, "Of --cache, MB").range(1, 1 << 30);
  worker.option("--idle-exit", o.pool.idle_exit, "Leave after so many seconds without a job; 0: never")
      .non_negative();
  command.footer(
      "SIGTERM or Ctrl-C: finishes the jobs in hand, answers them and leaves with 0; a second one ends it at "
      "once.\nExit code 42: the same command would fail again (options, keys, cache). docs/farm.md");
}

}  // namespace ssphh::app
