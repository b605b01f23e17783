#pragma once
/// `ssphh report`: a plan of scenes and methods, run and shown as a page.

#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

#include "options/farm_options.h"

namespace ssphh::app {

struct ReportOptions {
  std::string tool;                      ///< program `ssphh` that runs the commands; empty: this one
  std::string plan;                      ///< file, JSON or YAML
  std::string output;                    ///< folder for report.html, report.json, report.csv and report.md
  std::string cache;                     ///< folder of finished runs; empty: cache beside the output folder
  std::vector<std::string> assignments;  ///< other values of the plan's variables, as NAME=VALUE
  std::vector<std::string> commands;     ///< of the tool that may stand in a step
  int threads = 0;                       ///< of each command that is run; 0: all
  int time_limit = 0;                    ///< seconds that a command may take; 0: the plan's
  bool any_build = false;  ///< take finished runs of other builds of this version of the tool, too
  FarmChoice farm;         ///< for what a farm can do; its cache is not read
};

/// Numbers after `commands` are 0 where nothing changed.
struct ReportResult {
  bool changed = false;               ///< false: the files of an earlier call stand, and nothing was run
  std::size_t commands = 0;           ///< of the plan
  std::size_t run = 0, cached = 0;    ///< of these: run now, and found finished
  std::size_t cells = 0, failed = 0;  ///< of the page; failed: of these, with a message in place of a picture
  std::vector<std::string> notes;     ///< what was left out, and values that no cell has
  std::uintmax_t page_bytes = 0;      ///< of report.html
  double seconds = 0;
  std::filesystem::path cache;  ///< that was used
};

/// Runs what is not finished, and writes the page where anything changed. A
/// command that fails is a failed cell, and is run again by the next call. Warns in the log about failures
/// and notes. Throws Error for a plan that cannot be read, for unknown variables, for scenes and masks that
/// cannot be read, for files that cannot be written and for a farm that cannot be reached; Cancelled when
/// asked to stop: finished runs stay in the cache.
ReportResult run_report(const ReportOptions& options, const Control& control = {});

/// Whether a cell failed.
bool has_failed(const ReportResult& result, const ReportOptions& options);

json::Value to_json(const ReportResult& result, const ReportOptions& options);
std::string to_text(const ReportResult& result, const ReportOptions& options);

}  // namespace ssphh::app
