#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/study/default_view.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::pipeline {

trace::Projection projection_of(PictureProjection projection, const scene::Camera& camera) {
  using enum trace::Projection;
  if (projection == PictureProjection::equirect) return equirect;
  if (projection == PictureProjection::cube) return cube_strip;
  return camera.orthographic ? orthographic : pinhole;
}

scene::CameraPose camera_of(const scene::Scene& scene, const std::string& name, float time,
                            trace::SharedGeometry geometry) {
  if (!name.empty() || !scene.cameras.empty()) return scene::camera_pose(scene, name, time);
  if (!geometry) geometry = std::make_shared<const trace::SceneGeometry>(scene);
  return study::default_view(scene, trace::TransportScene(geometry, scene), time);
}

void check_method(const std::string& method, bool with_parameters, bool with_probes) {
  if (with_probes && method != "ssphh")
    throw Error("--probes", fmt::format("is of method ssphh, not of {}", method));
  if (with_parameters && method == "path")
    throw Error("--param", "method path has none", "see --max-depth, --spp and --passes");
  if (with_parameters && with_probes)
    throw Error("--param", "tells how probes are made, and --probes gives made ones",
                "leave out one of them");
}

std::optional<MethodFigures> render_scene(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                          float time, const LightFinder& finder,
                                          const trace::RenderParams& params, trace::RenderState& state,
                                          const Control& control) {
  check_method(finder.method, !finder.parameters.empty(), finder.probes != nullptr);
  warn_about_lamps(geometry, scene, time);
  const trace::PathTracer tracer(geometry, scene, time);
  if (finder.method == "path") {
    tracer.render(params, state, control);
    return std::nullopt;
  }
  if (finder.probes) {
    const auto indirect =
        probes::make_lookup(finder.lookup.method, *finder.probes, tracer,
                            lookup_params(finder.probes_name, *finder.probes, finder.lookup));
    tracer.render_with(*indirect, params, state, control);
    return std::nullopt;
  }
  LiveMethod live(finder.method, finder.parameters, geometry, scene, control, true);
  live.update(rays::lighting_at(live.source(), time), control);
  log_info("{}: {}", finder.method, live.text());
  tracer.render_with(live.method().light(), params, state, control);
  return live.figures();
}

}  // namespace ssphh::pipeline
