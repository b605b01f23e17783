#pragma once
/// Running a plan's command lines and measuring what they left.

#include <filesystem>
#include <map>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/report.h>

namespace ssphh::app {

/// Where and by what commands are run.
struct RunPlace {
  std::filesystem::path tool, cache;
  std::string build, machine;
  bool any_build = false;  ///< runs of other builds of the tool's version count as well
  /// Options that send a bake or render to a farm (--broker …); empty: all is done here. What comes out has
  /// the same bits, so they are no part of a run's key.
  std::vector<std::string> farm = {};
};

/// Whether a farm can do this command: a bake or truth by path tracing, or a render by path tracing or
/// from a probe file that is not by OpenGL.
bool runs_on_farm(const std::vector<std::string>& words);

/// By key; a run that failed has no record but a message.
struct RunResult {
  std::map<std::string, report::JobRecord> records;
  std::map<std::string, std::string> failures;
  std::size_t done = 0;    ///< commands run now
  std::size_t cached = 0;  ///< found finished
};

/// Runs what the cache does not hold, one command after the other, each in a folder that becomes its cache
/// entry when it is done. A command that fails, crashes or exceeds `time_limit` is a failure in the result;
/// those that need its outputs are not run. Throws Cancelled on Ctrl-C: finished runs stay.
RunResult run_jobs(const report::Expansion& expansion, const RunPlace& place, int time_limit,
                   const Control& control);

/// The cells with their values, steps and packed pictures. A picture that cannot be compared is a failed
/// cell.
std::vector<report::ReportCell> measure_cells(const report::Plan& plan, const report::Expansion& expansion,
                                              const RunResult& runs, const std::filesystem::path& cache,
                                              const Control& control);

}  // namespace ssphh::app
