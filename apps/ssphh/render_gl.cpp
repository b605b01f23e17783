#include "render_gl.h"

#include <chrono>

#include <fmt/format.h>

#include <ssphh/image/io.h>
#include <ssphh/realtime/renderer.h>

#include "gl_options.h"

namespace ssphh::app {
namespace {

void refuse_with_gl(const RenderOptions& o) {
  const auto refuse = [](const std::string& option, const std::string& problem) {
    throw Error(option, problem + " is not for --backend gl", "leave it out, or take --backend cpu");
  };
  if (o.method != "ssphh") refuse("--method", "path tracing");
  if (o.projection != "camera") refuse("--projection", "a picture of the whole sphere");
  if (o.resume) refuse("--resume", "resuming");
  if (o.farm.any()) refuse("--broker or --local", "a farm");
  if (o.probes.empty() && o.max_depth >= 2)
    throw Error(
        "--probes", "method ssphh needs a probe file",
        fmt::format("make one with `ssphh bake {} -o probes.sphl`, or take --max-depth 1", o.scene.source));
  for (const std::string& aov : o.aovs) {
    if (aov == "depth" || aov == "groups") refuse("--aov", aov);
  }
}

}  // namespace

void render_gl(const RenderOptions& o, const Context& context) {
  refuse_with_gl(o);
  const scene::Scene scene = load_scene(o.scene);
  const auto start = std::chrono::steady_clock::now();
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  const GlLookup lookup{o.max_depth >= 2 ? o.probes : "", o.lookup, o.weights, o.light, o.force};
  set_probes(renderer, lookup, scene, o.scene.time);
  int side = 1;
  while (side < 4 && side * side < o.spp * o.passes) ++side;
  realtime::FrameSettings settings = still_settings(lookup, side);
  settings.ambient_occlusion = o.occlusion > 0;
  if (o.occlusion > 0) settings.occlusion_radius = o.occlusion;
  const scene::CameraPose camera = scene::camera_pose(scene, o.camera, o.scene.time);
  const auto draw = [&](realtime::View view) {
    settings.view = view;
    renderer.draw(camera, settings, {.width = o.width, .height = o.height});
    return renderer.read_back();
  };
  const image::Image picture = draw(realtime::View::lit);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_picture(o.output, picture, o);
  if (!o.png.empty()) write_display(o.png, picture, o);
  const std::filesystem::path output = o.output;
  for (const std::string& aov : o.aovs) {
    using realtime::View;
    const View view = aov == "direct"     ? View::direct
                      : aov == "indirect" ? View::indirect
                      : aov == "albedo"   ? View::albedo
                                          : View::normal;
    image::Image image = draw(view);
    // The view shows 0.5 + 0.5 n, and black where nothing stands.
    if (view == View::normal) {
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const vec3 n = image.rgb(x, y);
          if (n != vec3(0)) image.set_rgb(x, y, 2.0f * n - 1.0f);
        }
      }
    }
    image::write_image((output.parent_path() / output.stem()).string() + "." + aov + ".exr", image);
  }
  const auto mean = mean_radiance(picture);
  context.result(
      {{"output", o.output},
       {"method", o.method},
       {"backend", "gl"},
       {"renderer", gl.info().renderer},
       {"width", picture.width},
       {"height", picture.height},
       {"samples", side * side},
       {"seconds", seconds},
       {"mean", mean}},
      fmt::format("{}: {}×{}, {} samples per pixel in {:.2f} s on {}, mean radiance {:.4g} {:.4g} {:.4g}",
                  o.output, picture.width, picture.height, side * side, seconds, gl.info().renderer, mean[0],
                  mean[1], mean[2]));
}

}  // namespace ssphh::app
