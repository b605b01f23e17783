#pragma once
/// `ssphh hier`: the neighbours' light added to the probes of a file.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/hier.h>

namespace ssphh::app {

struct HierOptions {
  std::string input;   ///< probe file to read
  std::string output;  ///< probe file to write: .sphl or .sphl.json
  probes::HierParams params;
  /// What to switch, dim or recolour first, as "GROUP=R,G,B" or "GROUP=X": factors on light groups, relative
  /// to the bake.
  std::vector<std::string> scales;
};

struct HierResult {
  probes::ProbeSet set;                    ///< as it was written
  std::size_t edges = 0;                   ///< that HIER used
  double seconds = 0;                      ///< HIER alone takes so long: the median of seven runs
  std::optional<Contraction> contraction;  ///< of operator mean
};

/// Reads the input, scales its groups, runs HIER and writes the output. Warns in the log about a set without
/// edges. Throws Error for files that cannot be read or written, for scales that are written otherwise or
/// name no group of the set, and as probes::hier does. Too short to be cancelled or to tell of its progress.
HierResult run_hier(const HierOptions& options, const Control& control = {});

json::Value to_json(const HierResult& result, const HierOptions& options);
std::string to_text(const HierResult& result, const HierOptions& options);

}  // namespace ssphh::app
