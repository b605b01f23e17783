#include "commands/report.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>
#include <span>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/log.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/core/version.h>
#include <ssphh/scene/query.h>

#include "commands/child_process.h"
#include "commands/command.h"
#include "commands/report_run.h"
#include "options/scene_options.h"
#include "results/processor.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

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
                "samples belong to steps");
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

RunPlace run_place(const ReportOptions& o) {
  RunPlace place;
  place.tool = o.tool.empty() ? fs::read_symlink("/proc/self/exe") : fs::absolute(o.tool);
  place.cache =
      fs::absolute(o.cache.empty() ? fs::absolute(o.output).lexically_normal().parent_path() / "cache"
                                   : fs::path(o.cache));
  fs::create_directories(place.cache);
  place.build = Hasher().bytes(read_file(place.tool)).finish().hex();
  place.machine =
      fmt::format("{}, {} threads", processor_name(),
                  o.threads > 0 ? o.threads : static_cast<int>(std::thread::hardware_concurrency()));
  place.any_build = o.any_build;
  return place;
}

/// A farm for what it can do, if one was asked for; `place` learns its options.
std::optional<FarmSession> start_farm(const ReportOptions& o, RunPlace& place) {
  FarmChoice choice = o.farm;
  choice.cache = "none";
  choice.tool = place.tool.string();
  std::optional<FarmSession> farm = farm_session(choice);
  if (!farm) return farm;
  // Not the farm's own results: seconds would tell of work that was done another day.
  place.farm = {"--broker", farm->options().broker.endpoint, "--cache", "none"};
  if (o.farm.local == 0 && !o.farm.broker.keys.empty())
    place.farm.insert(place.farm.end(), {"--keys", o.farm.broker.keys, "--key", o.farm.broker.key});
  return farm;
}

std::string command_line(const ReportOptions& o) {
  std::string text = fmt::format("ssphh report {}", o.plan);
  for (const std::string& assignment : o.assignments) text += " --set " + assignment;
  if (o.farm.local > 0) text += fmt::format(" --local {}", o.farm.local);
  if (!o.farm.broker.endpoint.empty()) text += " --broker " + o.farm.broker.endpoint;
  return text;
}

}  // namespace

ReportResult run_report(const ReportOptions& o, const Control& control) {
  const Stopwatch watch;
  const fs::path plan_file = o.plan, folder = fs::absolute(plan_file).parent_path(), output = o.output;
  const std::string plan_text = read_text_file(plan_file, std::uint64_t{16} << 20);
  report::Report page;
  page.plan = report::parse_plan(plan_text, plan_file.string(), o.commands);
  for (const std::string& assignment : o.assignments) report::set_variable(page.plan, assignment);
  report::load_masks(page.plan, folder);

  RunPlace place = run_place(o);
  report::Provenance& p = page.provenance;
  p.scene_hashes = hash_scenes(page.plan, folder, page.notes);
  const report::Expansion expansion =
      report::expand(page.plan, {folder, SSPHH_VERSION, p.scene_hashes, o.threads});
  p.identity = report_identity(plan_text, page.plan, expansion, place.build);
  ReportResult result;
  result.commands = expansion.jobs.size();
  result.cache = place.cache;
  if (already_written(output, p.identity)) return result;

  const std::optional<FarmSession> farm = start_farm(o, place);
  const RunResult runs =
      run_jobs(expansion, place, o.time_limit > 0 ? o.time_limit : page.plan.time_limit, control);
  page.cells = measure_cells(page.plan, expansion, runs, place.cache, control);
  p.version = SSPHH_VERSION, p.build = place.build, p.machine = place.machine;
  p.commit = work_tree_commit(place.tool, place.cache, control);
  p.created = fmt::format("{:%Y-%m-%d %H:%M UTC}", fmt::gmtime(std::time(nullptr)));
  p.command = command_line(o);
  note_unknown_values(page);
  result.failed = static_cast<std::size_t>(std::ranges::count_if(
      page.cells, [](const report::ReportCell& cell) { return !cell.failure.empty(); }));
  if (result.failed > 0) p.identity.clear();  // what failed is tried again
  write_report(page, output);

  result.changed = true;
  result.run = runs.done, result.cached = runs.cached;
  result.cells = page.cells.size();
  result.notes = std::move(page.notes);
  result.seconds = watch.seconds();
  result.page_bytes = fs::file_size(output / "report.html");
  return result;
}

bool has_failed(const ReportResult& result, const ReportOptions&) {
  return result.failed > 0;
}

json::Value to_json(const ReportResult& r, const ReportOptions& o) {
  json::Value object = {{"output", o.output}, {"changed", r.changed}, {"commands", r.commands}};
  if (!r.changed) return object;
  object.update({{"run", r.run},
                 {"cached", r.cached},
                 {"cells", r.cells},
                 {"failed", r.failed},
                 {"notes", r.notes},
                 {"page_bytes", r.page_bytes},
                 {"seconds", r.seconds}});
  return object;
}

std::string to_text(const ReportResult& r, const ReportOptions& o) {
  const std::string page = (fs::path(o.output) / "report.html").string();
  if (!r.changed) return page + ": nothing changed";
  return fmt::format("{}: {} cells, {} failed; {} commands run, {} taken from {}; {:.1f} MB, {:.1f} s", page,
                     r.cells, r.failed, r.run, r.cached, r.cache.string(),
                     1e-6 * static_cast<double>(r.page_bytes), r.seconds);
}

void add_report_command(Command app, Context& context) {
  auto [command, o] = add_command<ReportOptions>(app, context, "report",
                                                 "Run a plan of scenes and methods and show what it gave",
                                                 [&context, app](ReportOptions& given) {
                                                   // One of the user's own would stand in the plan's lines.
                                                   if (!app.at("report")["--threads"].given())
                                                     context.threads = 0;
                                                   given.commands = step_commands(app);
                                                   run_and_print(context, given, run_report);
                                                 });
  command.option("PLAN", o.plan, "Plan (JSON or YAML; docs/report.md)").required().existing_file();
  command.option("-o,--output", o.output, "Folder for report.html, report.json, report.csv and report.md")
      .required();
  command.option("--set", o.assignments, "Another value for a variable of the plan: NAME=VALUE; repeatable")
      .repeatable();
  command.option("--cache", o.cache, "Folder of finished runs; default: cache beside the output folder");
  command.option("--time-limit", o.time_limit, "Seconds that a command may take; default: what the plan says")
      .range(1, 1000000);
  const Command shared = command.under("Farm");
  const Option broker = add_broker_options(shared, o.farm.broker, "client");
  shared
      .option("--local", o.farm.local,
              "Start a broker and so many workers on this machine for the plan's bakes and renders")
      .range(1, 1024)
      .excludes(broker);
  command.flag("--any-build", o.any_build,
               "Also take finished runs of other builds of this version of the tool");
  command.footer(
      "Every command line of the plan runs once and is kept by a hash of all that decides its result, so a "
      "report that\n"
      "was interrupted continues, and one with a method more runs that method alone. A command that fails is "
      "a failed cell\n"
      "of the page, with its log, and is tried again next time; exit code 1.\n"
      "With --broker or --local a farm does path-traced bakes, renders and truths, to the same bits; other "
      "commands run here.");
}

}  // namespace ssphh::app
