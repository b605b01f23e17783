#include "commands/turntable.h"

#include <filesystem>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/query.h>

#include "commands/command.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "results/moving_camera.h"
#include "results/pictures.h"

namespace ssphh::app {

TurntableResult run_turntable(const TurntableOptions& o, const Control& control) {
  const scene::Scene scene = load_lit_scene(o.scene);
  std::error_code problem;
  std::filesystem::create_directories(o.directory, problem);
  if (!std::filesystem::is_directory(o.directory))
    throw Error(o.directory, "cannot be made a directory", problem.message());
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  set_probes(renderer, o.lookup, scene, o.scene.time);
  const scene::Bounds box = scene::world_bounds(scene, scene::world_matrices(scene, o.scene.time));
  const float aspect = static_cast<float>(o.width) / static_cast<float>(o.height);
  const realtime::FrameSettings settings = still_settings(o.lookup, o.samples);
  SharedExposure exposure(o.exposure);
  ProgressStage stage(control, "turntable", static_cast<std::uint64_t>(o.frames), "frames");
  for (int i = 0; i < o.frames; ++i) {
    control.check();
    const float turn = 2 * pi * static_cast<float>(i) / static_cast<float>(o.frames);
    const scene::CameraPose camera =
        orbit(box, glm::radians(o.yfov), aspect, glm::radians(o.elevation), turn);
    renderer.draw(camera, settings, {.width = o.width, .height = o.height});
    const std::filesystem::path file = std::filesystem::path(o.directory) / fmt::format("{:04}.png", i);
    const image::Image picture = renderer.read_back();
    write_display(file, picture, {.exposure = exposure.of(picture)});
    stage.advance(1);
  }
  return {exposure.chosen().value_or(0), gl.info().renderer};
}

json::Value to_json(const TurntableResult& result, const TurntableOptions& o) {
  return {{"output", o.directory}, {"frames", o.frames},          {"width", o.width},
          {"height", o.height},    {"exposure", result.exposure}, {"renderer", result.renderer}};
}

std::string to_text(const TurntableResult& result, const TurntableOptions& o) {
  return fmt::format("{}: {} of {}×{} on {}, {}", o.directory, counted(o.frames, "frame"), o.width, o.height,
                     result.renderer, exposure_text(result.exposure));
}

void add_turntable_command(Command app, Context& context) {
  auto [command, o] = add_command(app, context, "turntable",
                                  "Pictures of a model from all around, drawn with OpenGL", run_turntable);
  add_scene_options(command, o.scene, true, "MODEL");
  command.option("-o,--output", o.directory, "Directory for 0000.png, 0001.png, …").required();
  command.option("--frames", o.frames, "Pictures of one turn").range(1, 100000);
  add_size_options(command, o.width, o.height);
  command.option("--elevation", o.elevation, "Degrees of the camera above the middle").range(-89.0f, 89.0f);
  command.option("--samples", o.samples, "Samples per pixel along each side").range(1, 4);
  add_exposure_option(command, o.exposure, "Stops; auto: what suits the first picture that is not black");
  command.option("--probes", o.lookup.probes, "Probe file; without one: direct light alone");
  add_force_option(command, o.lookup.force);
}

}  // namespace ssphh::app
