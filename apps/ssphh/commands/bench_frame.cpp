#include "commands/bench_frame.h"

#include <algorithm>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/counted.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/scene/query.h>

#include "commands/command.h"
#include "options/method_options.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "results/moving_camera.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

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
void make_light(realtime::Renderer& renderer, const BenchFrameOptions& o, const scene::Scene& scene,
                const Control& control) {
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  pipeline::LiveMethod live(o.method, o.parameters, geometry, scene, control);
  live.update(rays::lighting_at(live.source(), o.scene.time), control);
  set_method(renderer, live.method().light_data(), o.lookup.spec, geometry, scene, o.scene.time);
}

}  // namespace

BenchFrameResult run_bench_frame(const BenchFrameOptions& o, const Control& control) {
  const bool probes = o.method == "ssphh";
  if (o.ratio && probes && o.lookup.probes.empty())
    throw Error("--ratio", "needs a probe file", "give one with --probes");
  if (!probes && !o.lookup.probes.empty()) throw Error("--probes", "is of method ssphh, not of " + o.method);
  if (!probes && o.move)
    throw Error("--move", "is for SPHLs: the light of method " + o.method + " would stay behind");
  if (probes && !o.parameters.empty()) throw Error("--param", "is of methods that have no probe file");
  if (o.frames < 1) throw Error("bench-frame", "needs a frame");
  const scene::Scene scene = load_lit_scene(o.scene);
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  if (probes)
    set_probes(renderer, o.lookup, scene, o.scene.time);
  else
    make_light(renderer, o, scene, control);
  realtime::FrameSettings settings = still_settings(o.lookup, o.supersample);
  settings.indirect_scale = o.indirect_scale;
  realtime::FrameSettings direct_only = settings;
  direct_only.indirect = false;
  const realtime::Target target{.width = o.width, .height = o.height};
  const scene::CameraPose camera = camera_of(scene, o.camera, o.scene.time);
  const scene::LightingState start = renderer.lighting();

  // Room for all times is taken before they start, so that memory shows what frames take.
  const auto count = static_cast<std::size_t>(o.frames);
  BenchFrameResult result;
  result.renderer = gl.info().renderer;
  result.frame_ms.resize(count);
  result.direct_ms.resize(o.ratio ? count : 0);
  std::int64_t resident_before = 0;
  ProgressStage stage(control, "frames", static_cast<std::uint64_t>(o.warm_up + o.frames), "frames");
  for (int i = -o.warm_up; i < o.frames; ++i) {
    control.check();
    const float share = static_cast<float>(i) / static_cast<float>(o.frames);
    const scene::CameraPose pose = o.turn ? turned(camera, share) : camera;
    if (o.move) move_scene(renderer, scene, start, i + o.warm_up);
    if (i == 0) resident_before = resident_bytes();
    if (o.ratio) {
      const double ms = renderer.draw(pose, direct_only, target).cpu_ms;
      if (i >= 0) result.direct_ms[i] = ms;
    }
    const realtime::FrameStats& stats = renderer.draw(pose, settings, target);
    stage.advance(1);
    for (const realtime::PassTime& pass : stats.passes) {
      std::vector<double>& times = result.pass_ms.try_emplace(pass.name, count, 0).first->second;
      if (i >= 0) times[i] = pass.gpu_ms;
    }
    if (i < 0) continue;
    result.frame_ms[i] = stats.cpu_ms;
    result.largest_upload = std::max(result.largest_upload, stats.bytes_uploaded);
    result.draw_calls = stats.draw_calls;
    result.samples_shaded = stats.samples_shaded;
  }
  result.resident = resident_bytes();
  result.resident_growth = result.resident - resident_before;
  result.probes = renderer.probe_count();
  result.memory = renderer.memory_bytes();
  result.method_numbers = renderer.method_numbers();
  return result;
}

json::Value to_json(const BenchFrameResult& r, const BenchFrameOptions& o) {
  const double samples = static_cast<double>(o.supersample) * o.supersample * o.width * o.height;
  const double median = percentile(r.frame_ms, 0.5);
  json::Value passes;
  for (const auto& [name, times] : r.pass_ms) passes[name] = percentile(times, 0.5);
  json::Value object = {{"scene", o.scene.source},
                        {"renderer", r.renderer},
                        {"width", o.width},
                        {"height", o.height},
                        {"frames", o.frames},
                        {"probes", r.probes},
                        {"indirect_scale", o.indirect_scale},
                        {"median_ms", median},
                        {"p99_ms", percentile(r.frame_ms, 0.99)},
                        {"passes", std::move(passes)},
                        {"draw_calls", r.draw_calls},
                        {"overdraw", static_cast<double>(r.samples_shaded) / samples},
                        {"largest_upload_bytes", r.largest_upload},
                        {"memory_bytes", r.memory},
                        {"resident_bytes", r.resident},
                        {"memory_growth_bytes", r.resident_growth}};
  for (const auto& [name, value] : r.method_numbers) object[name] = value;
  if (o.ratio) {
    const double direct = percentile(r.direct_ms, 0.5);
    object["direct_only_median_ms"] = direct;
    object[o.method == "ssphh" ? "sphl_ratio" : "method_ratio"] = median / direct;
  }
  return object;
}

std::string to_text(const BenchFrameResult& r, const BenchFrameOptions& o) {
  std::string text =
      fmt::format("{}: {} of {}×{} on {}\n{:<10} {:>10} {:>10}", o.scene.source, counted(o.frames, "frame"),
                  o.width, o.height, r.renderer, "", "median ms", "p99 ms");
  const auto line = [&](const std::string& name, const std::vector<double>& times) {
    text +=
        fmt::format("\n{:<10} {:>10.2f} {:>10.2f}", name, percentile(times, 0.5), percentile(times, 0.99));
  };
  line("frame", r.frame_ms);
  for (const auto& [name, times] : r.pass_ms) line(name, times);
  for (const auto& [name, value] : r.method_numbers) text += fmt::format("\n{:<12} {:>15.6g}", name, value);
  if (o.ratio) {
    const double direct = percentile(r.direct_ms, 0.5);
    text += fmt::format("\nwithout {0} {1:.2f} ms: {0} make a frame {2:.3f} times as long",
                        o.method == "ssphh" ? "probes" : o.method + "'s lookups", direct,
                        percentile(r.frame_ms, 0.5) / direct);
  }
  return text;
}

void add_bench_frame_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "bench-frame", "Time frames of the OpenGL renderer", run_bench_frame);
  add_scene_options(command, o.scene);
  command.option("--probes", o.lookup.probes, "Probe file; without one: direct light alone");
  std::vector<std::string> methods;
  for (const methods::MethodEntry& entry : methods::all_methods()) {
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
