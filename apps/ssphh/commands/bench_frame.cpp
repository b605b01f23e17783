#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/log.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/query.h>

#include "commands/command.h"
#include "commands/live_method.h"
#include "options/gl_options.h"
#include "options/method_options.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "options/scene_options.h"
#include "results/moving_camera.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

struct BenchOptions {
  SceneOptions scene;
  GlLookup lookup;
  std::string camera, method = "ssphh";
  std::vector<std::string> parameters;
  int width = 1280, height = 720, frames = 60, warm_up = 5, supersample = 1,
      indirect_scale = 3;  // as in the viewer
  bool turn = false, ratio = false, move = false;
};

/// Bytes of this process that stand in memory.
std::int64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::int64_t>(sysconf(_SC_PAGESIZE));
}

/// Animations forth and back, the first lamp up and down, once in 100 frames.
void move_scene(realtime::Renderer& renderer, const scene::Scene& scene, const scene::LightingState& start,
                int frame) {
  const float wave = forth_and_back(frame);
  scene::LightingState state =
      scene::lighting_at(scene, start.time + wave * scene::animation_duration(scene));
  if (!state.lights.empty()) {
    state.lights[0] = start.lights[0];
    state.lights[0].world[3].y += 0.25f * (wave - 0.5f);
  }
  renderer.set(state);
}

/// Lights the scene by the method: from here on nothing of it is asked for.
void set_method(realtime::Renderer& renderer, const BenchOptions& o, const scene::Scene& scene,
                const Context& context) {
  LiveMethod live(o.method, o.parameters, std::make_shared<const trace::SceneGeometry>(scene), scene,
                  context.control);
  live.update(rays::lighting_at(live.source(), o.scene.time), context.control);
  renderer.set_method_light(live.method().light_data());
}

/// Times of one kind over all frames; room is taken before they start, so that memory shows what frames take.
using Times = std::vector<double>;

void bench_frame(const BenchOptions& o, const Context& context) {
  const bool probes = o.method == "ssphh";
  if (o.ratio && probes && o.lookup.probes.empty())
    throw Error("--ratio", "needs a probe file", "give one with --probes");
  if (!probes && !o.lookup.probes.empty()) throw Error("--probes", "is of method ssphh, not of " + o.method);
  if (!probes && o.move)
    throw Error("--move", "is for SPHLs: the light of method " + o.method + " would stay behind");
  if (probes && !o.parameters.empty()) throw Error("--param", "is of methods that have no probe file");
  const scene::Scene scene = load_scene(o.scene);
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  if (probes)
    set_probes(renderer, o.lookup, scene, o.scene.time);
  else
    set_method(renderer, o, scene, context);
  realtime::FrameSettings settings = still_settings(o.lookup, o.supersample);
  settings.indirect_scale = o.indirect_scale;
  realtime::FrameSettings direct_only = settings;
  direct_only.indirect = false;
  const realtime::Target target{.width = o.width, .height = o.height};
  const scene::CameraPose camera = scene::camera_pose(scene, o.camera, o.scene.time);
  const scene::LightingState start = renderer.lighting();

  const auto count = static_cast<std::size_t>(o.frames);
  Times frames(count, 0), direct_frames(o.ratio ? count : 0, 0);
  std::map<std::string, Times> passes;
  std::uint64_t uploaded = 0, draw_calls = 0, shaded = 0;
  std::int64_t resident_before = 0;
  ProgressStage stage(context.control, "frames", static_cast<std::uint64_t>(o.warm_up + o.frames), "frames");
  for (int i = -o.warm_up; i < o.frames; ++i) {
    context.control.check();
    const float share = static_cast<float>(i) / static_cast<float>(o.frames);
    const scene::CameraPose pose = o.turn ? turned(camera, share) : camera;
    if (o.move) move_scene(renderer, scene, start, i + o.warm_up);
    if (i == 0) resident_before = resident_bytes();
    if (o.ratio) {
      const double ms = renderer.draw(pose, direct_only, target).cpu_ms;
      if (i >= 0) direct_frames[static_cast<std::size_t>(i)] = ms;
    }
    const realtime::FrameStats& stats = renderer.draw(pose, settings, target);
    stage.advance(1);
    for (const realtime::PassTime& pass : stats.passes) {
      Times& times = passes.try_emplace(pass.name, count, 0).first->second;
      if (i >= 0) times[static_cast<std::size_t>(i)] = pass.gpu_ms;
    }
    if (i < 0) continue;
    frames[static_cast<std::size_t>(i)] = stats.cpu_ms;
    uploaded = std::max(uploaded, stats.bytes_uploaded);
    draw_calls = stats.draw_calls;
    shaded = stats.samples_shaded;
  }
  const std::int64_t resident_after = resident_bytes();
  const double samples = static_cast<double>(o.supersample) * o.supersample * o.width * o.height;

  const double median = percentile(frames, 0.5), p99 = percentile(frames, 0.99);
  json::Value medians;
  std::string text = fmt::format("{}: {} frames of {}×{} on {}\n", o.scene.source, o.frames, o.width,
                                 o.height, gl.info().renderer);
  text += fmt::format("{:<10} {:>10} {:>10}\n{:<10} {:>10.2f} {:>10.2f}", "", "median ms", "p99 ms", "frame",
                      median, p99);
  for (const auto& [name, times] : passes) {
    medians[name] = percentile(times, 0.5);
    text +=
        fmt::format("\n{:<10} {:>10.2f} {:>10.2f}", name, percentile(times, 0.5), percentile(times, 0.99));
  }
  json::Value result{{"scene", o.scene.source},
                     {"renderer", gl.info().renderer},
                     {"width", o.width},
                     {"height", o.height},
                     {"frames", o.frames},
                     {"probes", renderer.probe_count()},
                     {"indirect_scale", o.indirect_scale},
                     {"median_ms", median},
                     {"p99_ms", p99},
                     {"passes", medians},
                     {"draw_calls", draw_calls},
                     {"overdraw", static_cast<double>(shaded) / samples},
                     {"largest_upload_bytes", uploaded},
                     {"memory_bytes", renderer.memory_bytes()},
                     {"resident_bytes", resident_after},
                     {"memory_growth_bytes", resident_after - resident_before}};
  for (const auto& [name, value] : renderer.method_numbers()) {
    result[name] = value;
    text += fmt::format("\n{:<12} {:>15.6g}", name, value);
  }
  if (o.ratio) {
    const double direct = percentile(direct_frames, 0.5);
    result["direct_only_median_ms"] = direct;
    result[probes ? "sphl_ratio" : "method_ratio"] = median / direct;
    text += fmt::format("\nwithout {0} {1:.2f} ms: {0} make a frame {2:.3f} times as long",
                        probes ? "probes" : o.method + "'s lookups", direct, median / direct);
  }
  context.result(result, text);
}

}  // namespace

void add_bench_frame_command(Command app, Context& context) {
  auto options = std::make_shared<BenchOptions>();
  BenchOptions& o = *options;
  Command command = add_command(app, context, "bench-frame", "Time frames of the OpenGL renderer",
                                [options, &context] { bench_frame(*options, context); });
  add_scene_options(command, o.scene);
  command.option("--probes", o.lookup.probes, "Probe file; without one: direct light alone");
  std::vector<std::string> methods = {"ssphh"};
  for (const methods::MethodEntry& entry : methods::method_table()) {
    if (entry.has_light_data) methods.emplace_back(entry.name);
  }
  command.option("--method", o.method, "What lights the scene: probes, or another method, made first")
      .one_of(methods);
  add_method_parameters(command, o.parameters);
  add_lookup_option(command, o.lookup.spec.method);
  add_weights_option(command, o.lookup.spec.weights);
  add_force_option(command, o.lookup.force);
  command.option("--frames", o.frames, "Frames to time").range(1, 10000000);
  command.option("--warm-up", o.warm_up, "Frames before them: shaders are compiled, shadow maps drawn")
      .range(0, 1000000);
  add_size_options(command, o.width, o.height);
  add_camera_option(command, o.camera);
  command.flag("--turn", o.turn, "The camera turns once about itself on the way");
  command.flag("--ratio", o.ratio, "Draw each frame without probes' light, too, and compare the times");
  command.flag("--move", o.move,
               "Animations run forth and back and the first lamp moves up and down, once in 100 frames");
  command.option("--samples", o.supersample, "Samples per pixel along each side").range(1, 4);
  command
      .option("--indirect-scale", o.indirect_scale,
              "Look indirect light up at every n-th pixel each way, and between them where they differ; "
              "1: at all")
      .range(1, 8);
}

}  // namespace ssphh::app
