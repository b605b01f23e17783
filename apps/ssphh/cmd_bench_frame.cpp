#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/query.h>

#include "command.h"
#include "gl_options.h"
#include "probe_options.h"
#include "scene_options.h"

namespace ssphh::app {
namespace {

struct BenchOptions {
  SceneOptions scene;
  GlLookup lookup;
  std::string camera;
  int width = 1280, height = 720, frames = 60, warm_up = 5, supersample = 1, indirect_scale = 1;
  bool turn = false;
};

double rank(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(share * last + 0.5)];
}

/// The camera turned about the vertical by a share of a full turn.
scene::CameraPose turned(scene::CameraPose pose, float share) {
  const mat4 turn(glm::mat3_cast(glm::angleAxis(2 * pi * share, vec3(0, 1, 0))));
  const vec4 position = pose.world[3];
  pose.world[3] = vec4(0, 0, 0, 1);
  pose.world = turn * pose.world;
  pose.world[3] = position;
  return pose;
}

void bench_frame(const BenchOptions& o, const Context& context) {
  const scene::Scene scene = load_scene(o.scene);
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  set_probes(renderer, o.lookup, scene, o.scene.time);
  realtime::FrameSettings settings = still_settings(o.lookup, o.supersample);
  settings.indirect_scale = o.indirect_scale;
  const realtime::Target target{.width = o.width, .height = o.height};
  const scene::CameraPose camera = scene::camera_pose(scene, o.camera, o.scene.time);

  std::vector<double> frames;
  std::map<std::string, std::vector<double>> passes;
  std::uint64_t uploaded = 0, draw_calls = 0;
  ProgressStage stage(context.control, "frames", static_cast<std::uint64_t>(o.warm_up + o.frames), "frames");
  for (int i = -o.warm_up; i < o.frames; ++i) {
    context.control.check();
    const float share = static_cast<float>(i) / static_cast<float>(std::max(o.frames, 1));
    const realtime::FrameStats& stats =
        renderer.draw(o.turn ? turned(camera, share) : camera, settings, target);
    stage.advance(1);
    if (i < 0) continue;
    frames.push_back(stats.cpu_ms);
    for (const realtime::PassTime& pass : stats.passes) passes[pass.name].push_back(pass.gpu_ms);
    uploaded = std::max(uploaded, stats.bytes_uploaded);
    draw_calls = stats.draw_calls;
  }

  const double median = rank(frames, 0.5), p99 = rank(frames, 0.99);
  nlohmann::ordered_json medians;
  std::string text = fmt::format("{}: {} frames of {}×{} on {}\n", o.scene.source, o.frames, o.width,
                                 o.height, gl.info().renderer);
  text += fmt::format("{:<10} {:>10} {:>10}\n{:<10} {:>10.2f} {:>10.2f}", "", "median ms", "p99 ms", "frame",
                      median, p99);
  for (const auto& [name, times] : passes) {
    medians[name] = rank(times, 0.5);
    text += fmt::format("\n{:<10} {:>10.2f} {:>10.2f}", name, rank(times, 0.5), rank(times, 0.99));
  }
  context.result({{"scene", o.scene.source},
                  {"renderer", gl.info().renderer},
                  {"width", o.width},
                  {"height", o.height},
                  {"frames", o.frames},
                  {"probes", renderer.probe_count()},
                  {"median_ms", median},
                  {"p99_ms", p99},
                  {"passes", medians},
                  {"draw_calls", draw_calls},
                  {"largest_upload_bytes", uploaded},
                  {"memory_bytes", renderer.memory_bytes()}},
                 text);
}

}  // namespace

void add_bench_frame_command(CLI::App& app, Context& context) {
  auto options = std::make_shared<BenchOptions>();
  BenchOptions& o = *options;
  CLI::App* command = add_command(app, context, "bench-frame", "Time frames of the OpenGL renderer",
                                  [options, &context] { bench_frame(*options, context); });
  add_scene_options(*command, o.scene);
  command->add_option("--probes", o.lookup.probes, "Probe file; without one: direct light alone");
  command->add_option("--lookup", o.lookup.lookup, "irradiance, or light as the paper")
      ->check(CLI::IsMember({"light", "irradiance"}))
      ->capture_default_str();
  add_force_option(*command, o.lookup.force);
  command->add_option("--frames", o.frames, "Frames to time")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  command->add_option("--warm-up", o.warm_up, "Frames before them: shaders are compiled, shadow maps drawn")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command->add_option("--width", o.width, "Pixels")->check(CLI::Range(1, 16384))->capture_default_str();
  command->add_option("--height", o.height, "Pixels")->check(CLI::Range(1, 16384))->capture_default_str();
  command->add_option("--camera", o.camera, "Camera by name; default: the scene's first");
  command->add_flag("--turn", o.turn, "The camera turns once about itself on the way");
  command->add_option("--samples", o.supersample, "Samples per pixel along each side")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command
      ->add_option("--indirect-scale", o.indirect_scale, "Look probes up at every n-th pixel along each side")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
}

}  // namespace ssphh::app
