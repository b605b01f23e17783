#include "commands/report_run.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/report/measure.h>

#include "commands/child_process.h"
#include "results/pictures.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;
using report::Cell;
using report::Job;
using report::JobRecord;
using report::ReportCell;

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

// Removes the folder of a run that did not come to its end.
class WorkFolder {
 public:
  explicit WorkFolder(fs::path path) : path_(std::move(path)) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The message without the log's path, which is gone with the folder; and the log, where the message does not
// hold all of it.
std::string failure_text(const Error& error, const fs::path& log) {
  constexpr std::size_t most = 4000;
  std::string text = error.problem();
  const std::string where = log.string() + " says";
  if (const std::size_t at = text.find(where); at != std::string::npos)
    text.replace(at, where.size(), "it said");
  std::error_code ignored;
  const std::string all = fs::exists(log, ignored) ? read_text_file(log) : "";
  if (std::ranges::count(all, '\n') > 8)
    text += "\nAll of it:\n" + (all.size() > most ? "…" + all.substr(all.size() - most) : all);
  return text;
}

JobRecord run_job(const Job& job, const RunPlace& place, int time_limit, const Control& control) {
  const WorkFolder work(place.cache / fmt::format("{}.{}.part", job.key, ::getpid()));
  std::vector<std::string> command = {place.tool.string()};
  for (std::string& word : report::command_line(job, place.cache, work.path()))
    command.push_back(std::move(word));
  command.insert(command.end(), {"--json", "--progress", "none", "--config", "none"});
  const bool far = !place.farm.empty() && runs_on_farm(job.words);
  if (far) command.insert(command.end(), place.farm.begin(), place.farm.end());
  JobRecord record;
  record.build = place.build, record.started = utc_now();
  record.machine = place.machine + (far ? " and a farm" : "");
  const fs::path log = work.path() / "log";
  try {
    const ProgramUsage usage =
        run_program(command, log, std::chrono::seconds(time_limit), control, work.path() / "stdout");
    record.seconds = usage.seconds, record.cpu_seconds = usage.cpu_seconds,
    record.peak_bytes = usage.peak_bytes;
    report::keep_run(place.cache, job, work.path(), record);
  } catch (const Error& e) {
    throw Error("ssphh " + job.words.front(), failure_text(e, log), e.hint());
  }
  const auto kept = report::find_run(place.cache, job.key, place.build);
  if (!kept) throw Error((place.cache / job.key).string(), "cannot be read back", "is the disk full?");
  return *kept;
}

std::string failed_need(const report::Expansion& expansion, const Job& job, const RunResult& result) {
  for (const std::size_t need : job.needs) {
    if (result.failures.count(expansion.jobs[need].key)) return expansion.jobs[need].words.front();
  }
  return {};
}

// Pictures of all runs in one layer; none where the method has no such file.
std::vector<report::LayerPicture> load_runs(const Cell& cell, const fs::path& cache,
                                            const std::string& layer) {
  std::vector<report::LayerPicture> runs;
  for (const report::CellRun& run : cell.runs) {
    std::vector<fs::path> files;
    for (const std::string& picture : run.pictures) files.push_back(cache / picture);
    if (!files.empty()) runs.push_back(report::load_layer(files, layer));
  }
  return runs;
}

std::string failure_of(const Cell& cell, const report::Expansion& expansion, const RunResult& runs) {
  for (const report::CellRun& run : cell.runs) {
    for (const std::size_t job : run.jobs) {
      const auto failure = runs.failures.find(expansion.jobs[job].key);
      if (failure != runs.failures.end()) return failure->second;
    }
  }
  return {};
}

const report::PlanMethod& method_of(const report::Plan& plan, const Cell& cell) {
  return cell.method < 0 ? plan.reference : plan.methods[cell.method];
}

// Steps and their numbers, as far as they ran.
void add_steps(const report::Plan& plan, const report::Expansion& expansion, const Cell& cell,
               const RunResult& runs, ReportCell& out, std::map<std::string, std::vector<double>>& values) {
  const report::PlanMethod& method = method_of(plan, cell);
  for (std::size_t r = 0; r < cell.runs.size(); ++r) {
    double seconds = 0;
    for (std::size_t s = 0; s < cell.runs[r].jobs.size(); ++s) {
      const Job& job = expansion.jobs[cell.runs[r].jobs[s]];
      const auto found = runs.records.find(job.key);
      if (found == runs.records.end()) continue;
      const JobRecord& record = found->second;
      const std::string& name = method.steps[s].name;
      out.steps.push_back({name, job.key, record.command, record.started, record.machine, static_cast<int>(r),
                           record.seconds, record.peak_bytes});
      report::add_numbers(name, record.result, values);
      values[name + ".wall_seconds"].push_back(record.seconds);
      values[name + ".cpu_seconds"].push_back(record.cpu_seconds);
      values[name + ".peak_bytes"].push_back(static_cast<double>(record.peak_bytes));
      if (!job.outputs.empty() && record.files.count(job.outputs.front()))
        values[name + ".file_bytes"].push_back(static_cast<double>(record.files.at(job.outputs.front())));
      seconds += record.seconds;
    }
    values["seconds"].push_back(seconds);
  }
}

struct Reference {
  std::string layer;
  report::LayerPicture picture;
};

class CellMeasurer {
 public:
  CellMeasurer(const report::Plan& plan, const report::Expansion& expansion, const RunResult& runs,
               const fs::path& cache)
      : plan_(plan), expansion_(expansion), runs_(runs), cache_(cache) {}

  ReportCell measure(const Cell& cell) const {
    ReportCell out{cell.scene, cell.method, cell.label, cell.parameters, {}, {}, {}, {}, 0};
    std::map<std::string, std::vector<double>> values;
    add_steps(plan_, expansion_, cell, runs_, out, values);
    out.failure = failure_of(cell, expansion_, runs_);
    const report::PlanMethod& method = method_of(plan_, cell);
    if (out.failure.empty() && !(method.picture.empty() && method.halves.empty())) {
      try {
        add_layer(cell, "", out, values);
        for (const std::string& layer : plan_.layers) add_layer(cell, layer, out, values);
      } catch (const Error& e) {
        out.failure = e.what();
      }
    }
    for (auto& [name, numbers] : values) out.values[name] = report::value_of(std::move(numbers));
    return out;
  }

 private:
  const Cell* reference_of(const Cell& cell) const {
    for (const Cell& other : expansion_.cells) {
      if (other.scene == cell.scene && other.method < 0) return &other;
    }
    return nullptr;
  }

  void add_layer(const Cell& cell, const std::string& layer, ReportCell& out,
                 std::map<std::string, std::vector<double>>& values) const {
    const std::vector<report::LayerPicture> runs = load_runs(cell, cache_, layer);
    out.pictures.push_back({layer, "", report::pack_half(runs.front().picture)});
    if (layer.empty()) out.exposure = static_cast<double>(suitable_exposure(runs.front().picture));
    const Cell* reference = reference_of(cell);
    if (!reference || reference == &cell || !failure_of(*reference, expansion_, runs_).empty()) return;
    const std::string prefix = layer.empty() ? "" : layer + ":";
    const report::LayerMeasure measured = report::measure_layer(
        load_runs(*reference, cache_, layer).front(), runs, {plan_.block, plan_.scenes[cell.scene].insets});
    for (const auto& [name, numbers] : measured.values) values[prefix + name] = numbers;
    out.pictures.push_back({layer, "flip", report::pack_bytes(measured.flip)});
  }

  const report::Plan& plan_;
  const report::Expansion& expansion_;
  const RunResult& runs_;
  const fs::path& cache_;
};

}  // namespace

bool runs_on_farm(const std::vector<std::string>& words) {
  const auto value_of = [&](const char* option) -> std::string {
    const auto found = std::ranges::find(words, option);
    return found == words.end() || std::next(found) == words.end() ? "" : *std::next(found);
  };
  const auto has = [&](const char* option) { return std::ranges::find(words, option) != words.end(); };
  if (words.front() == "bake") return value_of("--operator").empty() || value_of("--operator") == "path";
  if (words.front() == "truth") return value_of("--renderer") != "cycles";
  const std::string method = value_of("--method");
  const bool known = method.empty() || method == "path" || (method == "ssphh" && has("--probes"));
  return words.front() == "render" && known && value_of("--backend") != "gl" && !has("--resume");
}

RunResult run_jobs(const report::Expansion& expansion, const RunPlace& place, int time_limit,
                   const Control& control) {
  RunResult result;
  fs::create_directories(place.cache);
  const std::string build = place.any_build ? "" : place.build;
  std::vector<const Job*> missing;
  for (const Job& job : expansion.jobs) {
    if (auto record = report::find_run(place.cache, job.key, build)) {
      result.records.emplace(job.key, std::move(*record));
      ++result.cached;
    } else {
      missing.push_back(&job);
    }
  }
  if (missing.empty()) return result;
  ProgressStage stage(control, "Commands", missing.size(), "runs");
  for (const Job* job : missing) {
    control.check();
    const std::string need = failed_need(expansion, *job, result);
    try {
      if (!need.empty())
        throw Error("ssphh " + job->words.front(), fmt::format("was not run: {} failed", need));
      result.records.emplace(job->key, run_job(*job, place, time_limit, control));
      ++result.done;
    } catch (const Error& e) {
      result.failures[job->key] = e.what();
      log_warning("{}: {}", job->scene, e.what());
    }
    stage.advance(1);
  }
  return result;
}

std::vector<ReportCell> measure_cells(const report::Plan& plan, const report::Expansion& expansion,
                                      const RunResult& runs, const fs::path& cache, const Control& control) {
  const CellMeasurer measurer(plan, expansion, runs, cache);
  std::vector<ReportCell> cells(expansion.cells.size());
  ProgressStage stage(control, "Measuring", cells.size(), "pictures");
  parallel_for(
      cells.size(), 1,
      [&](std::size_t i) {
        cells[i] = measurer.measure(expansion.cells[i]);
        stage.advance(1);
      },
      control);
  return cells;
}

}  // namespace ssphh::app
