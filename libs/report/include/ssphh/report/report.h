#pragma once
/// What a plan gave, and the files that show it.

#include <map>
#include <string>
#include <vector>

#include <ssphh/report/packed_image.h>
#include <ssphh/report/plan.h>

namespace ssphh::report {

/// A value over the repetitions of a cell.
struct Value {
  double mean = 0;
  double median = 0;
  double deviation = 0;  ///< standard deviation, 0 for a single run
  int count = 0;
};
Value value_of(std::vector<double> numbers);

struct StepRun {
  std::string name, key, command, started, machine;
  int repetition = 0;
  double seconds = 0;
  std::uint64_t peak_bytes = 0;
};

struct CellPicture {
  std::string layer;  ///< "" is the picture itself
  std::string map;    ///< "" or "flip"
  PackedImage packed;
};

struct ReportCell {
  std::size_t scene = 0;
  int method = -1;  ///< −1: the reference
  std::string label;
  Parameters parameters;
  std::string failure;  ///< message and log of the step that failed; empty: none did
  std::map<std::string, Value> values;
  std::vector<StepRun> steps;
  std::vector<CellPicture> pictures;
  double exposure = 0;  ///< EV that suits its picture
};

struct Provenance {
  std::string identity;  ///< hash of plan, runs and tool: equal for a report that would be the same
  std::string version, build, commit, machine, created, command;
  std::map<std::string, std::string> scene_hashes;
};

struct Report {
  Plan plan;
  std::vector<std::string> notes;  ///< scenes left out and why, values that no cell has
  Provenance provenance;
  std::vector<ReportCell> cells;
};

/// The number that a table shows: a parameter, or of a value its median for times and its mean otherwise.
/// NaN: none.
double shown(const ReportCell& cell, const std::string& name);

/// EV at which a scene's pictures are shown: the plan's, else what suits the reference, or the first cell
/// that has a picture. 0 without pictures. Throws Error for a scene that the plan does not have.
double exposure_of(const Report& report, std::size_t scene);

/// Columns of the plan, or when it names none: the usual errors if there is a reference, and the run time.
std::vector<Column> columns_of(const Report& report);

/// Adds every number in a step's JSON result as "STEP.key.key" to `values` (true is 1, false 0).
void add_numbers(const std::string& step, const std::string& json,
                 std::map<std::string, std::vector<double>>& values);

/// These throw Error for a cell of a scene or method that the plan does not have.
std::string report_json(const Report& report);  ///< everything but the pictures
std::string report_csv(const Report& report);   ///< one line per cell; every value, RFC 4180
std::string report_markdown(const Report& report);
/// HTML with everything in it, as UTF-16 with a byte order mark: what its pictures need least bytes in.
std::string report_page(const Report& report);

/// The identity in a report.json, "" when it is none.
std::string identity_of(const std::string& report_json);

}  // namespace ssphh::report
