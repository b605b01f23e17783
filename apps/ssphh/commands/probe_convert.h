#pragma once
/// `ssphh probe convert`: probe files in other formats, and in fewer bytes.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/compact.h>
#include <ssphh/sh/packing.h>

namespace ssphh::app {

struct ProbeConvertOptions {
  std::string input;   ///< probe file to read
  std::string output;  ///< probe file to write: .sphl or .sphl.json
  sh::Packing pack = sh::Packing::none;
  std::optional<int> degree = {};  ///< highest band to keep; none: the file's, of zh3 2
};

/// What fewer bytes took from the set.
struct ProbePackingLoss {
  int degree = 0;         ///< of the file that was read
  std::size_t edges = 0;  ///< left out
  bool baseline = false;  ///< left out
  probes::IrradianceLoss irradiance;
};

struct ProbeConvertResult {
  std::size_t probes = 0;
  std::uint64_t bytes = 0;                    ///< of the file that was written
  int degree = 0;                             ///< of the file that was written
  std::uint64_t light_bytes = 0;              ///< of all probes' functions, in a binary file
  std::optional<ProbePackingLoss> loss = {};  ///< none: the set is whole
};

/// Throws Error for files that cannot be read or written, for a degree that the file or the packing does not
/// have, and for light that the packing does not hold.
ProbeConvertResult run_probe_convert(const ProbeConvertOptions& options, const Control& control = {});
json::Value to_json(const ProbeConvertResult& result, const ProbeConvertOptions& options);
std::string to_text(const ProbeConvertResult& result, const ProbeConvertOptions& options);

}  // namespace ssphh::app
