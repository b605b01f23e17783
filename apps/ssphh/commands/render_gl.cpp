#include <optional>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/image/io.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/realtime/renderer.h>

#include "commands/render.h"
#include "options/gl_options.h"
#include "results/geometry_builds.h"
#include "results/pictures.h"

namespace ssphh::app {
namespace {

/// Whether the real-time renderer draws the method's light; method direct has none.
bool gl_method(const std::string& name) {
  return name == "direct" || methods::find_method(name).has_light_data;
}

/// How the real-time renderer draws a layer; none: it cannot.
std::optional<realtime::View> view_of(trace::RenderLayer layer) {
  using trace::RenderLayer;
  if (layer == RenderLayer::direct) return realtime::View::direct;
  if (layer == RenderLayer::indirect) return realtime::View::indirect;
  if (layer == RenderLayer::albedo) return realtime::View::albedo;
  if (layer == RenderLayer::normal) return realtime::View::normal;
  return {};
}

void refuse_with_gl(const RenderOptions& o) {
  const auto refuse = [](const std::string& option, const std::string& problem) {
    throw Error(option, problem + " is not for --backend gl", "leave it out, or take --backend cpu");
  };
  pipeline::check_method(o.method, !o.parameters.empty(), !o.probes.empty());
  if (o.method == "path") refuse("--method path", "path tracing");
  if (!gl_method(o.method))
    throw Error("--method " + o.method, "has no OpenGL version",
                "take --backend cpu, or one of ssphh, vct, vpl, direct");
  if (o.projection != PictureProjection::camera) refuse("--projection", "a picture of the whole sphere");
  if (o.resume) refuse("--resume", "resuming");
  if (o.farm.any()) refuse("--broker or --local", "a farm");
  pipeline::check_drawings(o.method, !o.probes.empty(), drawings_of(o));
  for (const trace::RenderLayer layer : o.aovs) {
    if (!view_of(layer)) refuse("--aov", std::string(name_of(layer)));
  }
}

}  // namespace

RenderResult render_gl(const RenderOptions& o, const Control& control) {
  refuse_with_gl(o);
  const GeometryBuilds builds;
  const scene::Scene scene = load_lit_scene(o.scene);
  const Stopwatch watch;
  std::optional<pipeline::LiveMethod> live;
  trace::SharedGeometry geometry;
  if (o.probes.empty() && o.max_depth >= 2) {  // with less there is none
    geometry = std::make_shared<const trace::SceneGeometry>(scene);
    live.emplace(o.method, o.parameters, geometry, scene, control, true);
    live->update(rays::lighting_at(live->source(), o.scene.time), control);
    log_info("{}: {}", o.method, live->text());
  }
  gl::Context gl = gl::Context::headless();
  realtime::Renderer renderer(gl, scene, {}, o.scene.time);
  const GlLookup lookup{o.max_depth >= 2 ? o.probes : "", o.lookup, o.force};
  set_probes(renderer, lookup, scene, o.scene.time);
  if (live && methods::find_method(o.method).has_light_data)
    set_method(renderer, live->method().light_data(), o.lookup, geometry, scene, o.scene.time);
  int side = 1;
  while (side < 4 && side * side < o.spp * o.passes) ++side;
  realtime::FrameSettings settings = still_settings(lookup, side);
  settings.indirect_scale = o.indirect_scale;
  settings.ambient_occlusion = o.occlusion > 0;
  if (o.occlusion > 0) settings.occlusion_radius = o.occlusion;
  const scene::CameraPose camera = camera_of(scene, o.camera, o.scene.time, geometry);
  const auto draw = [&](realtime::View view) {
    settings.view = view;
    renderer.draw(camera, settings, {.width = o.width, .height = o.height});
    return renderer.read_back();
  };
  RenderResult result;
  result.picture = draw(realtime::View::lit);
  result.seconds = watch.seconds();
  sketch::Sketch marks;
  if (live)
    marks = pipeline::drawn_of(live->method(), drawings_of(o));
  else if (!o.draw.empty())
    marks = pipeline::drawn_of(read_probes_of(scene, o.probes, o.scene.time, o.force), drawings_of(o));
  trace::RenderParams params;
  params.width = o.width, params.height = o.height, params.camera = camera;
  params.projection = pipeline::projection_of(o.projection, camera.camera);
  draw_and_write(result, o, marks, geometry, scene, params, control);
  for (const trace::RenderLayer layer : o.aovs) {
    image::Image image = draw(*view_of(layer));
    // The view shows 0.5 + 0.5 n, and black where nothing stands.
    if (layer == trace::RenderLayer::normal) {
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const vec3 n = image.rgb(x, y);
          if (n != vec3(0)) image.set_rgb(x, y, 2.0f * n - 1.0f);
        }
      }
    }
    image::write_image(beside(o.output, fmt::format("{}.exr", name_of(layer))), image);
  }
  if (live) result.method = live->figures();
  result.gl = {gl.info().renderer, side * side, renderer.method_numbers()};
  result.geometry_builds = builds.count();
  return result;
}

}  // namespace ssphh::app
