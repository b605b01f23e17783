#pragma once
/// What `ssphh relight` has to say: stage times, rays, and the error over time as numbers and as a curve.

#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/core/json.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::app {

struct FrameError {
  int frame = 0;
  study::LookupError error;
};

/// Light blended between keys, against that of exact posing.
struct KeyedRun {
  int keys = 0;                    ///< 0: there were none
  double find_ms = 0;              ///< of all keys, the network apart
  std::vector<double> blend_ms;    ///< of the frames
  std::vector<FrameError> errors;  ///< of the frames
};

struct RelightRun {
  int frames_asked = 0;
  double fps = 30;
  double build_ms = 0;  ///< of the network
  std::vector<transport::RelightReport>
      updates;  ///< of the frames that were done; the first lights everything
  std::vector<FrameError> errors;
  KeyedRun keyed;
  bool cancelled = false;
};

json::Value relight_json(const RelightRun& run);
std::string relight_text(const RelightRun& run);

/// Ratio and relative errors over seconds, as SVG.
void write_error_curve(const std::filesystem::path& path, const RelightRun& run);

}  // namespace ssphh::app
