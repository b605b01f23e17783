#include "commands/doctor.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/for_this_cpu.h>
#include <ssphh/core/memory.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/core/user_folder.h>
#include <ssphh/core/version.h>
#include <ssphh/farm/disk_cache.h>
#include <ssphh/gl/context.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/scene_geometry.h>

#include "commands/child_process.h"
#include "commands/command.h"
#include "commands/web.h"
#include "results/processor.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

#if defined(__AVX512F__)
constexpr const char* built_for = "AVX-512";
#elif defined(__AVX2__)
constexpr const char* built_for = "AVX2";
#elif defined(__x86_64__)
constexpr const char* built_for = "any x86-64";
#else
constexpr const char* built_for = "this kind of processor";
#endif

std::string gigabytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} GB", 1e-9 * static_cast<double>(bytes));
}

DoctorRow build() {
#ifdef __clang__
  const std::string compiler =
      fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const std::string compiler = fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
#ifdef __OPTIMIZE__
  return {"build", compiler + ", optimised", Health::ok, ""};
#else
  return {"build", compiler + ", not optimised", Health::missing,
          "bakes take many times longer than they need: scripts/build release makes another"};
#endif
}

DoctorRow processor() {
  return {"processor",
          fmt::format("{}; built for {}, long loops by {}", processor_name(), built_for,
                      uses_avx2() ? "AVX2" : "what that has"),
          Health::ok, ""};
}

/// Processors that the control group grants; none: all.
std::optional<double> granted_processors() {
  double quota = 0, period = 0;
  if (std::ifstream("/sys/fs/cgroup/cpu.max") >> quota >> period && period > 0) return quota / period;
  return std::nullopt;
}

DoctorRow threads() {
  DoctorRow row{
      "threads",
      fmt::format("{} on {}", thread_count(), counted(std::thread::hardware_concurrency(), "processor")),
      Health::ok, ""};
  const std::optional<double> granted = granted_processors();
  if (granted && *granted < thread_count() - 0.5) {
    row.found += fmt::format(", of which the control group grants {:.2g}", *granted);
    row.health = Health::missing;
    row.advice =
        fmt::format("more threads than that wait for each other: --threads {:.0f}", std::max(1.0, *granted));
  }
  return row;
}

DoctorRow memory() {
  std::string found = gigabytes(memory_of_machine());
  std::ifstream info("/proc/meminfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("MemAvailable:"))
      found += fmt::format(", {} of the machine's free",
                           gigabytes(std::strtoull(line.c_str() + 13, nullptr, 10) << 10));
  }
  return {"memory", found, Health::ok, ""};
}

rlim_t allowed(decltype(RLIMIT_AS) resource) {
  rlimit value{};
  ::getrlimit(resource, &value);
  return value.rlim_cur;
}

DoctorRow limit(const char* part, rlim_t value, rlim_t enough, const char* unit, const char* advice) {
  if (value == RLIM_INFINITY) return {part, "no limit", Health::ok, ""};
  const std::string found = fmt::format("{} {}", value, unit);
  return value < enough ? DoctorRow{part, found, Health::missing, advice}
                        : DoctorRow{part, found, Health::ok, ""};
}

/// A probe of a small room, from the scene to its light.
DoctorRow bake(const Control& control) {
  const Stopwatch watch;
  try {
    const scene::Scene scene = scene::make_builtin("cornell");
    pipeline::BakeSettings settings;
    settings.op = probes::LightOperator::path;
    settings.viz = probes::VizMethod::none;
    settings.degree = 2, settings.records = 0;
    settings.params.face_size = 8, settings.params.path.spp = 1;
    const pipeline::SceneBake result =
        pipeline::bake_scene(std::make_shared<trace::SceneGeometry>(scene), scene, 0, {"scene"}, settings, {},
                             {nullptr, control.cancel});
    return {"bake",
            fmt::format("{} of builtin:cornell in {:.0f} ms", counted(result.set.probes.size(), "probe"),
                        1000 * watch.seconds()),
            Health::ok, ""};
  } catch (const Error& e) {
    return {"bake", e.what(), Health::broken,
            "see above for what the machine lacks; else report this as a mistake of ssphh's"};
  }
}

DoctorRow opengl() {
  if (allowed(RLIMIT_AS) < rlim_t{2} << 30)  // Mesa ends the program there
    return {"opengl", "not tried in so small an address space", Health::missing, "ulimit -v unlimited"};
  try {
    const gl::Context context = gl::Context::headless();
    const gl::ContextInfo& info = context.info();
    return {"opengl",
            fmt::format("{}, version {}{}", info.renderer, info.version, info.software ? " (no GPU)" : ""),
            Health::ok, ""};
  } catch (const Error& e) {
    return {"opengl", e.problem(), Health::missing, fmt::format("for `view` and --backend gl {}", e.hint())};
  }
}

DoctorRow window() {
  for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"}) {
    const char* display = std::getenv(name);
    if (display && *display) return {"window", fmt::format("{}={}", name, display), Health::ok, ""};
  }
  return {"window", "neither DISPLAY nor WAYLAND_DISPLAY is set", Health::missing,
          "for `view` log in to a desktop, or run it by xvfb-run -a"};
}

DoctorRow program(const std::string& name, const char* advice) {
  const fs::path found = find_program(name);
  if (found.empty()) return {name, "not in the folders of PATH", Health::missing, advice};
  return {name, found.string(), Health::ok, ""};
}

DoctorRow page() {
  const std::string folder = page_folder();
  if (fs::exists(fs::path(folder) / "index.html")) return {"web page", folder, Health::ok, ""};
  return {"web page", "none in " + folder, Health::missing,
          "for `web` build it, which takes npm: scripts/install-deps, scripts/build"};
}

/// A folder that is made when something is first put there.
DoctorRow folder(const char* part, const fs::path& path) {
  fs::path there = path;
  std::error_code ignored;
  while (!fs::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, ignored) || ::access(there.c_str(), W_OK | X_OK) != 0)
    return {part, fmt::format("{}: {} cannot be written", path.string(), there.string()), Health::missing,
            "give yourself that folder, or set HOME, TMPDIR or XDG_CACHE_HOME to another"};
  const fs::space_info space = fs::space(there, ignored);
  return {part,
          fmt::format("{}{}, {} free", path.string(), there == path ? "" : " (not there yet)",
                      gigabytes(space.available)),
          Health::ok, ""};
}

/// Defaults of the user's own.
void add_settings(const Settings& settings, std::vector<DoctorRow>& rows) {
  rows.push_back({"settings",
                  settings.file.empty() ? "none are read"
                                        : settings.file.string() + (settings.found ? "" : " (not there)"),
                  Health::ok, ""});
  for (const Setting& setting : settings.in_force)
    rows.push_back(
        {"setting", fmt::format("{} = {}, by {}", setting.key, setting.value, setting.from), Health::ok, ""});
}

const char* mark(Health health) {
  return health == Health::ok ? "ok" : health == Health::missing ? "--" : "!!";
}

}  // namespace

DoctorReport run_doctor(const DoctorOptions& options, const Control& control) {
  std::error_code ignored;
  DoctorReport report;
  report.rows = {
      {"ssphh", fmt::format("{}, {}", SSPHH_VERSION, fs::read_symlink("/proc/self/exe", ignored).string()),
       Health::ok, ""},
      build(),
      processor(),
      threads(),
      memory(),
      limit("address space", allowed(RLIMIT_AS), rlim_t{8} << 30, "bytes",
            "large scenes will not fit: ulimit -v unlimited"),
      limit("file size", allowed(RLIMIT_FSIZE), rlim_t{1} << 30, "bytes",
            "large bakes will not fit: ulimit -f unlimited"),
      limit("open files", allowed(RLIMIT_NOFILE), 1024, "files",
            "a broker of many workers needs more: ulimit -n 4096"),
      bake(control),
      opengl(),
      window(),
      program("blender",
              "for --renderer cycles: scripts/install-deps --with-blender, or apt install blender"),
      program("git", "`report` cannot tell the commit of the tool: apt install git"),
      page(),
      folder("result cache", farm::default_cache_dir("results")),
      folder("scene cache", farm::default_cache_dir("scenes")),
      folder("preferences", user_folder("XDG_CONFIG_HOME", ".config")),
      folder("autosave", user_folder("XDG_STATE_HOME", ".local/state") / "autosave"),
      folder("temporary", fs::temp_directory_path(ignored)),
  };
  add_settings(options.settings, report.rows);
  return report;
}

bool has_failed(const DoctorReport& report, const DoctorOptions&) {
  return std::ranges::count(report.rows, Health::broken, &DoctorRow::health) > 0;
}

json::Value to_json(const DoctorReport& report, const DoctorOptions& options) {
  json::Value rows = json::Value::array();
  for (const DoctorRow& row : report.rows) {
    json::Value item = {{"part", row.part}, {"found", row.found}, {"health", name_of(row.health)}};
    if (!row.advice.empty()) item["advice"] = row.advice;
    rows.push_back(std::move(item));
  }
  return {{"can_bake", !has_failed(report, options)}, {"parts", std::move(rows)}};
}

std::string to_text(const DoctorReport& report, const DoctorOptions& options) {
  std::string text;
  for (const DoctorRow& row : report.rows) {
    text += fmt::format("{} {:<13} {}\n", mark(row.health), row.part, row.found);
    if (!row.advice.empty()) text += fmt::format("{:17}{}\n", "", row.advice);
  }
  return text + (has_failed(report, options) ? "something that every bake needs does not work (!!)"
                                             : "all that a bake needs works");
}

void add_doctor_command(Command app, Context& context) {
  const Command command =
      add_command(app, context, "doctor", "Look whether this machine has what the tool needs", run_doctor)
          .command;
  command.footer("ok: works; --: some commands lack it; !!: no bake works. Exit code 1 where there is a !!.");
}

}  // namespace ssphh::app
