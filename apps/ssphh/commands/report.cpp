#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <set>
#include <span>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/log.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/parallel.h>
#include <ssphh/scene/query.h>

#include "commands/child_process.h"
#include "commands/command.h"
#include "commands/report_run.h"
#include "options/farm_options.h"
#include "options/scene_options.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string plan, output, cache;
  std::vector<std::string> assignments;
  int time_limit = 0;  // 0: the plan's
  bool any_build = false;
  FarmChoice farm;
};

// All commands that can stand in a step: this one would call itself.
std::vector<std::string> step_commands(const Command& app) {
  std::vector<std::string> names = app.commands();
  std::erase(names, "report");
  return names;
}

// A scene's words are parsed as any command would.
scene::Scene load_plan_scene(const report::PlanScene& scene, const fs::path& folder) {
  const CommandLine line("");
  SceneOptions options;
  add_scene_options(line.root(), options);
  try {
    line.parse(report::scene_words(scene, folder));
  } catch (const ParsingEnded& e) {
    throw Error("scene " + scene.name, e.what(),
                "a scene is a file or builtin:NAME with --overlay, --time and the like; cameras, sizes and "
                "samples belong "
                "to steps");
  }
  return load_scene(options);
}

// Loads every scene for its hash. One that is optional and not there is left out and noted.
std::map<std::string, std::string> hash_scenes(const report::Plan& plan, const fs::path& folder,
                                               std::vector<std::string>& notes) {
  std::map<std::string, std::string> hashes;
  for (const report::PlanScene& scene : plan.scenes) {
    try {
      hashes[scene.name] = scene::scene_hash(load_plan_scene(scene, folder)).hex();
    } catch (const Error& e) {
      if (!scene.optional) throw;
      notes.push_back(fmt::format("{} is left out: {}", scene.title, e.what()));
      log_warning("{}", notes.back());
    }
  }
  return hashes;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string file_hash(const fs::path& path) {
  Hasher hasher;
  hasher.bytes(read_file(path));
  return hasher.finish().hex();
}

// Of the work tree in which the tool was built, if it lies in one.
std::string work_tree_commit(const fs::path& tool, const fs::path& scratch, const Control& control) {
  if (find_program("git").empty()) return {};
  const fs::path out = scratch / "git-describe", log = scratch / "git-log";
  fs::remove(out);
  std::string commit;
  try {
    run_program({"git", "-C", tool.parent_path().string(), "describe", "--always", "--dirty=+changes"}, log,
                std::chrono::seconds(10), control, out);
    commit = read_text_file(out);
    while (!commit.empty() && commit.back() == '\n') commit.pop_back();
  } catch (const Error&) {
    // not in a work tree
  }
  fs::remove(out), fs::remove(log);
  return commit;
}

std::string report_identity(const std::string& plan_text, const report::Plan& plan,
                            const report::Expansion& expansion, const std::string& build) {
  Hasher hasher;
  hasher.text(plan_text).text(build);
  for (const auto& [name, value] : plan.variables) hasher.text(name).text(value);
  for (const report::Job& job : expansion.jobs) hasher.text(job.key);
  for (const report::PlanScene& scene : plan.scenes)
    for (const report::Inset& inset : scene.insets) hasher.bytes(std::as_bytes(std::span(inset.mask.pixels)));
  return hasher.finish().hex();
}

bool already_written(const fs::path& output, const std::string& identity) {
  std::error_code ignored;
  for (const char* name : {"report.json", "report.csv", "report.md", "report.html"}) {
    if (!fs::is_regular_file(output / name, ignored)) return false;
  }
  return report::identity_of(read_text_file(output / "report.json")) == identity;
}

void note_unknown_values(report::Report& result) {
  std::set<std::string> known;
  for (const report::ReportCell& cell : result.cells) {
    for (const auto& [name, value] : cell.values) known.insert(name);
    for (const auto& [name, value] : cell.parameters) known.insert(name);
  }
  const std::vector<std::string> names(known.begin(), known.end());
  const auto check = [&](const std::string& name, const char* where) {
    if (known.count(name)) return;
    const std::string best = nearest_word(name, names);
    result.notes.push_back(fmt::format("no cell has the value \"{}\" of {}{}", name, where,
                                       best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best)));
    log_warning("{}", result.notes.back());
  };
  for (const report::Column& column : result.plan.columns) check(column.value, "a column");
  for (const report::Chart& chart : result.plan.charts) check(chart.x, "a chart"), check(chart.y, "a chart");
}

void write_report(const report::Report& result, const fs::path& output) {
  fs::create_directories(output);
  write_file(output / "report.html", report::report_page(result));
  write_file(output / "report.csv", report::report_csv(result));
  write_file(output / "report.md", report::report_markdown(result));
  write_file(output / "report.json",
             report::report_json(result));  // last: its identity vouches for the others
}

void run_report(const ReportOptions& o, Context& context, const std::vector<std::string>& commands) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path plan_file = o.plan, folder = fs::absolute(plan_file).parent_path(), output = o.output;
  const std::string plan_text = read_text_file(plan_file, std::uint64_t{16} << 20);
  report::Report result;
  result.plan = report::parse_plan(plan_text, plan_file.string(), commands);
  for (const std::string& assignment : o.assignments) report::set_variable(result.plan, assignment);
  report::load_masks(result.plan, folder);

  RunPlace place;
  place.tool = fs::read_symlink("/proc/self/exe");
  place.cache = fs::absolute(o.cache.empty() ? fs::absolute(output).lexically_normal().parent_path() / "cache"
                                             : fs::path(o.cache));
  fs::create_directories(place.cache);
  place.build = file_hash(place.tool);
  place.machine = fmt::format(
      "{}, {} threads", processor(),
      context.threads > 0 ? context.threads : static_cast<int>(std::thread::hardware_concurrency()));
  place.any_build = o.any_build;

  report::Provenance& p = result.provenance;
  p.scene_hashes = hash_scenes(result.plan, folder, result.notes);
  const report::Expansion expansion =
      report::expand(result.plan, {folder, SSPHH_VERSION, p.scene_hashes, context.threads});
  p.identity = report_identity(plan_text, result.plan, expansion, place.build);
  if (already_written(output, p.identity)) {
    context.result({{"output", o.output}, {"changed", false}, {"commands", expansion.jobs.size()}},
                   fmt::format("{}: nothing changed", (output / "report.html").string()));
    return;
  }

  std::optional<FarmSession> farm;
  if (o.farm.any()) {
    FarmChoice choice = o.farm;
    choice.cache = "none";
    farm.emplace(choice);
    // Not the farm's own results: seconds would tell of work that was done another day.
    place.farm = {"--broker", farm->options().broker.endpoint, "--cache", "none"};
    if (!o.farm.broker.keys.empty())
      place.farm.insert(place.farm.end(), {"--keys", o.farm.broker.keys, "--key", o.farm.broker.key});
  }
  const RunResult runs =
      run_jobs(expansion, place, o.time_limit > 0 ? o.time_limit : result.plan.time_limit, context.control);
  result.cells = measure_cells(result.plan, expansion, runs, place.cache, context.control);
  p.version = SSPHH_VERSION, p.build = place.build, p.machine = place.machine;
  p.commit = work_tree_commit(place.tool, place.cache, context.control);
  p.created = fmt::format("{:%Y-%m-%d %H:%M UTC}", fmt::gmtime(std::time(nullptr)));
  p.command = fmt::format("ssphh report {}", o.plan);
  for (const std::string& assignment : o.assignments) p.command += " --set " + assignment;
  if (o.farm.local > 0) p.command += fmt::format(" --local {}", o.farm.local);
  if (!o.farm.broker.endpoint.empty()) p.command += " --broker " + o.farm.broker.endpoint;
  note_unknown_values(result);
  const auto failed = std::count_if(result.cells.begin(), result.cells.end(),
                                    [](const report::ReportCell& cell) { return !cell.failure.empty(); });
  if (failed > 0) p.identity.clear();  // what failed is tried again
  write_report(result, output);

  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto page_bytes = fs::file_size(output / "report.html");
  context.result(
      {{"output", o.output},
       {"changed", true},
       {"commands", expansion.jobs.size()},
       {"run", runs.done},
       {"cached", runs.cached},
       {"cells", result.cells.size()},
       {"failed", failed},
       {"notes", result.notes},
       {"page_bytes", page_bytes},
       {"seconds", seconds}},
      fmt::format("{}: {} cells, {} failed; {} commands run, {} taken from {}; {:.1f} MB, {:.1f} s",
                  (output / "report.html").string(), result.cells.size(), failed, runs.done, runs.cached,
                  place.cache.string(), 1e-6 * static_cast<double>(page_bytes), seconds));
  if (failed > 0) context.exit_code = 1;
}

}  // namespace

void add_report_command(Command app, Context& context) {
  auto options = std::make_shared<ReportOptions>();
  ReportOptions& o = *options;
  Command command =
      add_command(app, context, "report", "Run a plan of scenes and methods and show what it gave",
                  [options, &context, app] { run_report(*options, context, step_commands(app)); });
  command.option("PLAN", o.plan, "Plan (JSON or YAML; docs/report.md)").required().existing_file();
  command.option("-o,--output", o.output, "Folder for report.html, report.json, report.csv and report.md")
      .required();
  command.option("--set", o.assignments, "Another value for a variable of the plan: NAME=VALUE; repeatable")
      .repeatable();
  command.option("--cache", o.cache, "Folder of finished runs; default: cache beside the output folder");
  command.option("--time-limit", o.time_limit, "Seconds that a command may take; default: what the plan says")
      .range(1, 1000000);
  add_broker_options(command, o.farm.broker, "client", "Farm")
      .excludes(
          command
              .option("--local", o.farm.local,
                      "Start a broker and so many workers on this machine for the plan's bakes and renders")
              .range(1, 1024)
              .group("Farm"));
  command.flag("--any-build", o.any_build,
               "Also take finished runs of other builds of this version of the tool");
  command.footer(
      "Every command line of the plan runs once and is kept by a hash of all that decides its result, so a "
      "report that\n"
      "was interrupted continues, and one with a method more runs that method alone. A command that fails is "
      "a "
      "failed cell\n"
      "of the page, with its log, and is tried again next time; exit code 1.\n"
      "With --broker or --local a farm does path-traced bakes, renders and truths, to the same bits; other "
      "commands "
      "run "
      "here.");
}

}  // namespace ssphh::app
