#pragma once
/// `ssphh turntable`: pictures of a model from all around.

#include <optional>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>

#include "options/gl_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

struct TurntableOptions {
  SceneOptions scene;
  GlLookup lookup;
  std::string directory;          ///< to write 0000.png, 0001.png, … into; made where it is not there
  int width = 640, height = 640;  ///< pixels, over 0
  int frames = 24;                ///< of one turn, over 0
  int samples = 2;                ///< per pixel along each side, 1..4
  float elevation = 20;           ///< of the camera above the middle, in degrees
  float yfov = 40;                ///< of the camera, in degrees
  std::optional<float> exposure;  ///< stops; none: what suits the first picture that is not black
};

struct TurntableResult {
  float exposure = 0;    ///< EV of all pictures
  std::string renderer;  ///< as OpenGL calls itself
};

/// Draws and writes the pictures. Throws Error for files that cannot be read or written, for probes of
/// another scene or pose and where OpenGL fails; Cancelled when asked to stop, which leaves the pictures so
/// far.
TurntableResult run_turntable(const TurntableOptions& options, const Control& control = {});

json::Value to_json(const TurntableResult& result, const TurntableOptions& options);
std::string to_text(const TurntableResult& result, const TurntableOptions& options);

}  // namespace ssphh::app
