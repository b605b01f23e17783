#pragma once
/// `ssphh probe export`: a probe file's light in the formats of engines.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probe_export/target.h>

#include "options/scene_options.h"

namespace ssphh::app {

/// One file of all light groups, or a file for each.
enum class GroupFiles { sum, separate };
constexpr auto enum_table(GroupFiles) {
  using enum GroupFiles;
  return std::to_array<EnumName<GroupFiles>>({{sum, "sum"}, {separate, "separate"}});
}

struct ProbeExportOptions {
  SceneOptions scene;              ///< in which the probes were baked; its time is not read
  std::string input;               ///< probe file to read, or keys as probes::read_probe_keys() has them
  std::string to;                  ///< one of probe_export::targets()
  std::string output;              ///< file to write; the target's ending is added where it is missing
  std::string grid = "auto";       ///< metres between the points of a grid, or auto
  std::vector<std::string> group;  ///< a file for each of these light groups; none: as `groups` says
  GroupFiles groups = GroupFiles::sum;
  bool emitted = false;  ///< light straight from emitters that probes see, too
  bool list = false;     ///< nothing is read or written: tell of the targets
  bool force = false;    ///< go on, with a warning, where the probes are of another scene
};

struct ProbeExportResult {
  std::vector<std::string> files;
  std::size_t points = 0, filled = 0;  ///< as probe_export::Exported, of one file
  std::uint64_t bytes = 0;             ///< of all files
  std::vector<float> key_times;        ///< of OUT-key0, OUT-key1 … [s]; empty: one file was read
  std::vector<std::string> lost, notes;
};

/// Throws Error for a scene that cannot be read or is another than that of the bake, for a target, a light
/// group or a grid that there is not, and as the target's writer does; Cancelled when asked to stop.
ProbeExportResult run_probe_export(const ProbeExportOptions& options, const Control& control = {});
json::Value to_json(const ProbeExportResult& result, const ProbeExportOptions& options);
std::string to_text(const ProbeExportResult& result, const ProbeExportOptions& options);

}  // namespace ssphh::app
