#pragma once
/// `ssphh sphl`: SPHLs that are lamps.

#include <cstdint>
#include <string>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/scene_io/emission_file.h>
#include <ssphh/trace/thing_emission.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct SphlSampleOptions {
  SceneOptions scene;
  std::string node;                   ///< the thing, by its name
  std::string output;                 ///< emission file to write
  trace::ThingEmissionParams params;  ///< the seed of its paths is not read
  std::uint64_t seed = 0;
  int frames = 1;       ///< the first at the scene's time
  float rate = 24;      ///< of them, per second
  bool repeat = false;  ///< the first frame follows the last
};
struct SphlSampleResult {
  scene_io::EmissionFile file;  ///< as it was written
  vec3 center{0};               ///< of the light in the node's space, mean of the frames
  double flux = 0;              ///< luminance of all the light of the first frame [W]
  float least =
      0;  ///< of the intensity over directions, in shares of its mean, first frame: below 0 it rings
  std::uint64_t paths = 0;
  double seconds = 0;
};
/// Samples the thing and writes the file. Throws Error as trace::thing_emission and scene::find_node do.
SphlSampleResult run_sphl_sample(const SphlSampleOptions& options, const Control& control = {});
json::Value to_json(const SphlSampleResult& result, const SphlSampleOptions& options);
std::string to_text(const SphlSampleResult& result, const SphlSampleOptions& options);

}  // namespace ssphh::app
