#pragma once
/// `ssphh bench-frame`: what frames of the OpenGL renderer take.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/methods/method.h>

#include "options/gl_options.h"
#include "options/scene_options.h"

namespace ssphh::app {

struct BenchFrameOptions {
  SceneOptions scene;
  GlLookup lookup;               ///< of the probes, for method ssphh
  std::string camera;            ///< by name; empty: the scene's first
  std::string method = "ssphh";  ///< what lights the scene: ssphh, by probes, or one that has light data
  std::vector<std::string> parameters;  ///< of another method than ssphh, each as "NAME=VALUE"
  int width = 1280, height = 720;       ///< pixels, over 0
  int frames = 60;                      ///< to time, over 0
  int warm_up = 5;                      ///< frames before them
  int supersample = 1;                  ///< samples per pixel along each side, 1..4
  int indirect_scale = 3;  ///< indirect light is looked up at every so-many-th pixel each way, 1..8
  bool turn = false;       ///< the camera turns once about itself in the timed frames
  bool ratio = false;      ///< each frame is drawn without indirect light, too
  /// Once in 100 frames, animations run forth and back and the first lamp moves up and down; of ssphh alone.
  bool move = false;
};

struct BenchFrameResult {
  std::string renderer;           ///< OpenGL's name of it
  int probes = 0;                 ///< that light the scene
  std::vector<double> frame_ms;   ///< of each timed frame, by the CPU's clock
  std::vector<double> direct_ms;  ///< of the same without indirect light; empty: no ratio
  /// Of each pass, by its name, in each timed frame, by the GPU's clock.
  std::map<std::string, std::vector<double>> pass_ms;
  std::uint64_t draw_calls = 0;           ///< of the last frame
  std::uint64_t samples_shaded = 0;       ///< in a frame shortly before the last: counts come late
  std::uint64_t largest_upload = 0;       ///< bytes of a timed frame at most
  std::size_t memory = 0;                 ///< bytes of OpenGL's memory
  std::int64_t resident = 0;              ///< bytes of the process in memory, after the last frame
  std::int64_t resident_growth = 0;       ///< of them, since the first timed frame
  methods::MethodNumbers method_numbers;  ///< of the method's light in OpenGL; none for probes
};

/// Makes the method's light where there is a method, and draws without a window. Throws Error for options
/// that do not go together and without frames, for scenes and probe files that cannot be read or do not
/// belong to each other, for unknown methods, parameters and cameras, and where there is no OpenGL 4.5;
/// Cancelled when asked to stop.
BenchFrameResult run_bench_frame(const BenchFrameOptions& options, const Control& control = {});

json::Value to_json(const BenchFrameResult& result, const BenchFrameOptions& options);
std::string to_text(const BenchFrameResult& result, const BenchFrameOptions& options);

}  // namespace ssphh::app
