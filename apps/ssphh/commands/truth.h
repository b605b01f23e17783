#pragma once
/// `ssphh truth`: a reference picture, and what of it is noise.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/image.h>
#include <ssphh/metrics/compare.h>

#include "commands/cycles.h"
#include "options/farm_options.h"
#include "options/picture_options.h"

namespace ssphh::app {

struct TruthOptions {
  PictureOptions picture;  ///< its samples are halved, and an odd one is left out
  FarmChoice farm;         ///< that traces, if there is any: for renderer path
  Renderer renderer = Renderer::path;
  PictureProjection projection = PictureProjection::camera;  ///< cube: by renderer path alone
  std::uint64_t seed = 0;
  int threads = 0;                ///< of Cycles; 0: all
  std::string output;             ///< picture to write: .exr or .hdr (linear radiance), .png or .jpg
  std::optional<float> exposure;  ///< EV of a PNG or JPEG; none: what suits the picture
  bool halves = false;            ///< also write the two halves, OUT.a.exr and OUT.b.exr
  std::string work;               ///< folder for the files and the log of Cycles; empty: OUTPUT.cycles
  int time_limit = 3600;          ///< seconds that each half may take Cycles
};

/// Two pictures with independent random numbers, half of the samples each, and their mean.
struct TruthResult {
  image::Image picture, first, second;
  glm::dvec3 mean{0}, standard_error{0};  ///< radiance over the picture, per channel
  std::optional<float> exposure;          ///< EV of what was tone mapped; none: nothing was
  metrics::ImageError noise;              ///< of the picture, by the halves' difference
  std::vector<std::string> differences;   ///< what Cycles computes otherwise, one line each
  double seconds = 0;                     ///< of both halves
};

/// Renders and writes the pictures. Throws Error for a farm with Cycles (before anything else), for files
/// that cannot be read or written, for an unknown camera, for a farm that cannot be reached, and where
/// Blender is absent or fails; Cancelled when asked to stop.
TruthResult run_truth(const TruthOptions& options, const Control& control = {});

json::Value to_json(const TruthResult& result, const TruthOptions& options);
std::string to_text(const TruthResult& result, const TruthOptions& options);

}  // namespace ssphh::app
