#pragma once
/// Engines and formats that a probe set can be exported to: a row of a table and a writer each.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/bytes.h>
#include <ssphh/probe_export/light_grid.h>

namespace ssphh::probe_export {

/// What a writer may read.
struct ExportSource {
  const probes::ProbeSet& set;
  const rays::TransportSource& scene;
  probes::ProbeLight light = probes::ProbeLight::reflected;
  GridParams grid = {};
  std::optional<GridShape> shape = {};  ///< the grid's cells; none: such as fit the set by `grid`
};

struct ExportFile {
  std::string ending;  ///< of the name that was asked for, in place of the target's own; "" is that
  std::vector<std::byte> data;
  bool shared = false;  ///< holds no light: one serves all light groups and keys
};

struct Exported {
  std::vector<ExportFile> files;   ///< the one with the empty ending first
  std::size_t points = 0;          ///< probes or grid points written
  std::size_t filled = 0;          ///< of these, such as got their light from neighbours
  std::vector<std::string> notes;  ///< what to know when it is loaded
};

struct Target {
  std::string_view name;
  std::string_view about;
  std::string_view carries, loses;
  std::string_view ending;  ///< of its files' names
  int degree;               ///< highest that it carries
  bool grid;                ///< resampled on a grid
  bool hides;               ///< what reads it may know what hides what: it names no lookup
  /// `name`: of the file, without folder and ending, for files that name each other.
  Exported (*write)(const ExportSource& source, const std::string& name, const Control& control);
};

std::span<const Target> targets();
/// Throws Error that lists the names there are.
const Target& find_target(std::string_view name);

/// The set with the light of one group alone, at its scale. Throws Error that lists the groups for one there
/// is not, and for a set with a hierarchy, which holds the groups' sum.
probes::ProbeSet only_group(probes::ProbeSet set, const std::string& group);

/// What of the set the target cannot carry or the user must know, one line each: degrees, groups, poses,
/// records, weights, edges, baked groups. `posed`: sets of other poses are exported beside it.
std::vector<std::string> lost(const probes::ProbeSet& set, const Target& target, bool posed = false);

/// Bytes of a half float for each value. Throws Error(what, ...) for a value that has none: beyond 65504.
void write_half(ByteWriter& out, float value, const char* what);

}  // namespace ssphh::probe_export
