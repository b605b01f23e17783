#pragma once
/// `ssphh probe`: probe files looked at, checked and converted. All throw Error for files that cannot be read
/// or written; only the check is long enough to be cancelled and to tell of its progress.

#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/blend.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/sh/packing.h>
#include <ssphh/study/lint.h>

#include "options/scene_options.h"
#include "results/probe_sheet.h"

namespace ssphh::app {

struct ProbeInfoOptions {
  std::string input;  ///< probe file to read
};
struct ProbeInfo {
  probes::ProbeSet set;                     ///< what the file holds
  sh::Packing packing = sh::Packing::none;  ///< of its light
  std::vector<float> lowest_irradiance;  ///< of each probe: least E(n) of its own light over n and channels
};
ProbeInfo run_probe_info(const ProbeInfoOptions& options, const Control& control = {});
json::Value to_json(const ProbeInfo& info, const ProbeInfoOptions& options);
std::string to_text(const ProbeInfo& info, const ProbeInfoOptions& options);

struct ProbePreviewOptions {
  std::string input;   ///< probe file to read
  std::string output;  ///< picture to write: .png .jpg .exr .hdr
  int width = 256;     ///< pixels of one equirectangular picture, twice its height
  float exposure = 0;  ///< added to the automatic one [EV]
  std::string edges =
      {};  ///< probe whose sum is drawn, a row for each neighbour; empty: a row for each probe
};
struct ProbePreviewResult {
  probes::ProbeSet set;  ///< what the file holds
  ProbeSheet sheet;      ///< as it was written, before the file's format rounds it
};
/// Throws Error as probe_sheet() and edge_sheet() do.
ProbePreviewResult run_probe_preview(const ProbePreviewOptions& options, const Control& control = {});
json::Value to_json(const ProbePreviewResult& result, const ProbePreviewOptions& options);
std::string to_text(const ProbePreviewResult& result, const ProbePreviewOptions& options);

struct ProbeBlendOptions {
  std::string from, to;  ///< probe files to read
  std::string output;    ///< probe file to write
  float t = 0.5f;        ///< 0: `from`; 1: `to`
};
struct ProbeBlendResult {
  probes::BlendedSet blended;
};
/// Throws Error as probes::blend() does.
ProbeBlendResult run_probe_blend(const ProbeBlendOptions& options, const Control& control = {});
json::Value to_json(const ProbeBlendResult& result, const ProbeBlendOptions& options);
std::string to_text(const ProbeBlendResult& result, const ProbeBlendOptions& options);

struct ProbeLintOptions {
  SceneOptions scene;        ///< in which the probes were baked; its time is not read
  std::string input;         ///< probe file to read
  study::LintParams params;  ///< `interest` is not read: it is the scene's, in the pose of the bake
  bool force = false;        ///< go on, with a warning, where the probes are of another scene
};
struct ProbeLintResult {
  probes::ProbeSet set;                      ///< what the file holds
  std::vector<study::LintProblem> problems;  ///< as study::lint_probes() found them
};
/// Throws Error for a scene that cannot be read or is another than that of the bake, and as
/// study::lint_probes() does; Cancelled when asked to stop.
ProbeLintResult run_probe_lint(const ProbeLintOptions& options, const Control& control = {});
/// There are problems.
bool has_failed(const ProbeLintResult& result, const ProbeLintOptions& options);
json::Value to_json(const ProbeLintResult& result, const ProbeLintOptions& options);
std::string to_text(const ProbeLintResult& result, const ProbeLintOptions& options);

}  // namespace ssphh::app
