#pragma once
/// `ssphh relight`: lamps and doors move, and the probes are kept lit frame by frame.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/transport/relight_session.h>

#include "options/farm_options.h"
#include "options/place_options.h"
#include "options/scene_options.h"
#include "results/relight_report.h"

namespace ssphh::app {

/// Pictures that are tone mapped, or linear.
enum class FrameFormat { png, exr };
constexpr auto enum_table(FrameFormat) {
  using enum FrameFormat;
  return std::to_array<EnumName<FrameFormat>>({{png, "png"}, {exr, "exr"}});
}

struct RelightOptions {
  SceneOptions scene;
  PlaceOptions place;                ///< its probes may name a probe file, whose places are taken
  bool force = false;                ///< go on, with a warning, where that file is of another scene
  std::vector<std::string> animate;  ///< as --animate says (relight_animation.h)
  int frames = 60;                   ///< over 0; the keys go from the first to the last
  double fps = 30;                  ///< frames a second: the curve's time axis, and the time a frame may take
  std::uint64_t seed = 0;           ///< of truth and pictures
  transport::RelightParams params;  ///< operator surfel or bounce

  int key_frames = 0;  ///< light is blended between so many of the run, 2 or more; 0: every frame has its own
  int truth = 0;       ///< every so-many-th frame is path traced, and the lookup's error found; 0: none
  int points = 256;    ///< surface points of the truth, over 0
  int truth_spp = 1024;                                          ///< paths per point
  int max_depth = rays::usual_max_depth;                         ///< scattering events of a path
  probes::WeightMethod weights = probes::WeightMethod::surface;  ///< of lookups for truth and pictures
  int fit_frames = 3;  ///< frames that `fitted` weights are fitted to, evenly spaced over the run, over 0

  std::string output;                     ///< folder for pictures and error.svg; empty: neither is written
  int pictures = 1;                       ///< every so-many-th frame is drawn; 0: none
  FrameFormat format = FrameFormat::png;  ///< of the pictures
  std::string camera;                     ///< by name; empty: the scene's first
  int width = 640, height = 360;          ///< pixels
  int spp = 8;                            ///< samples per pixel
  std::optional<float> exposure;  ///< of png, in stops; none: what suits the first frame that is not black
  FarmChoice farm;                ///< that draws the pictures, if there is any
  std::string save;  ///< probe file to write of the last frame, or, numbered, of every key; empty: none
};

struct RelightResult {
  RelightRun run;
  std::vector<scene::ProbePlace> places;  ///< of the probes
  std::size_t surfels = 0, links = 0;     ///< of the network
  float surfel_size = 0;                  ///< edge of a surfel [m]
  std::optional<float> exposure;          ///< EV of all frames; none: they are not tone mapped
  bool saved = false;                     ///< whether the probe file was written
  std::uint64_t geometry_builds = 0;      ///< acceleration structures that were built
  std::optional<farm::FarmReport> farm;   ///< of a farm that was asked for
};

/// Times all frames one after the other, then saves the probes, path traces and draws. When asked to stop
/// after the first frame it says so in the log and returns what there is, with run.cancelled; before that it
/// throws Cancelled. Warns in the log about places and networks that cannot light what they should. Throws
/// Error for poses with operator bounce, a farm without pictures, for one key, where there are no frames or
/// no probes, for files that cannot be read or written, for unknown names of cameras, lights and groups, and
/// as transport::RelightSession does.
RelightResult run_relight(const RelightOptions& options, const Control& control = {});

/// Whether it was stopped before its end.
bool has_failed(const RelightResult& result, const RelightOptions& options);

json::Value to_json(const RelightResult& result, const RelightOptions& options);
std::string to_text(const RelightResult& result, const RelightOptions& options);

}  // namespace ssphh::app
