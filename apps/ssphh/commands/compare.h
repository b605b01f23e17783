#pragma once
/// `ssphh compare`: the error of an image against a reference.

#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/core/json.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/false_edges.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/perceptual.h>

namespace ssphh::app {

struct CompareOptions {
  std::string reference, test;  ///< image files of one size: .exr .hdr .png .jpg
  std::string mask;             ///< picture that is white where to measure; empty: everywhere
  int block = 16;               ///< side of the blocks of the pixelated map, in pixels
  float exposure = 0;           ///< both images are multiplied by 2^EV first
  double pixels_per_degree = metrics::FlipParams{}.pixels_per_degree;  ///< of the viewer's sight, for FLIP
  /// Also look for false edges, in `REF.indirect.exr` and so on that stand beside the pictures; a map of them
  /// asks for it as well.
  bool edges = false;
  std::string tev;               ///< "HOST:PORT" of a tev that shows both and the map's numbers; empty: none
  bool allow_nonfinite = false;  ///< infinite pixels and NaN are no failure

  std::string output;  ///< error map to write: .png (colours) or .exr (numbers); empty: none
  metrics::ErrorMap map = metrics::ErrorMap::absolute;
  float scale = 0;  ///< error shown in the last colour of a .png; 0: the 99th percentile, for flip 1
};

/// Pixels that are infinite or NaN, or outside the mask, are left out; the former are counted.
struct CompareResult {
  metrics::ImageError linear;
  metrics::BlockError blocks;
  metrics::DisplayError display;
  metrics::FlipError flip;
  std::optional<metrics::FalseEdges> edges;
  bool hdr = false;                ///< which FLIP: HDR-FLIP, or that of two display images
  std::optional<float> map_scale;  ///< of the map written: error shown in its last colour, 0 for numbers
};

/// Measures, and writes the map if there is to be one. Throws Error for a map's name that is of another kind
/// (before anything else), for files that cannot be read or written and for images of different sizes. Too
/// short to be cancelled or to tell of its progress.
CompareResult run_compare(const CompareOptions& options, const Control& control = {});

/// Whether pixels that are infinite or NaN make the comparison a failure.
bool has_failed(const CompareResult& result, const CompareOptions& options);

json::Value to_json(const CompareResult& result, const CompareOptions& options);
std::string to_text(const CompareResult& result, const CompareOptions& options);

}  // namespace ssphh::app
