#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
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
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
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

void check_drawings(const std::string& method, bool with_probes, std::span<const methods::Drawing> drawings) {
  for (const methods::Drawing what : drawings) {
    const auto has = [&](const methods::MethodEntry& entry) {
      return std::ranges::find(entry.drawings, what) != entry.drawings.end();
    };
    const std::string where = fmt::format("--draw {}", name_of(what));
    if (with_probes && what != methods::Drawing::hierarchy)
      throw Error(where, "a probe file holds a hierarchy alone", "leave out --probes");
    if (method != "path" && has(methods::find_method(method))) continue;
    std::string names;
    for (const methods::MethodEntry& entry : methods::all_methods())
      if (has(entry)) names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
    throw Error(where, fmt::format("method {} has none", method), "take --method " + names);
  }
}

sketch::Sketch drawn_of(const methods::Method& method, std::span<const methods::Drawing> drawings) {
  sketch::Sketch marks;
  for (const methods::Drawing what : drawings) {
    const sketch::Sketch found = method.drawing(what);
    if (found.empty()) log_warning("--draw {}: with these parameters the method has none", name_of(what));
    marks += found;
  }
  return marks;
}

sketch::Sketch drawn_of(const probes::ProbeSet& set, std::span<const methods::Drawing> drawings) {
  return drawings.empty() ? sketch::Sketch{} : methods::hierarchy_drawing(set);
}

std::optional<MethodFigures> render_scene(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                          float time, const LightFinder& finder,
                                          const trace::RenderParams& params, trace::RenderState& state,
                                          const Control& control, std::span<const methods::Drawing> drawings,
                                          sketch::Sketch* drawn, const trace::SeePass& see) {
  check_drawings(finder.method, finder.probes != nullptr, drawings);
  check_method(finder.method, !finder.parameters.empty(), finder.probes != nullptr);
  warn_about_lamps(geometry, scene, time);
  const trace::PathTracer tracer(geometry, scene, time);
  if (finder.method == "path") {
    tracer.render(params, state, control, see);
    return std::nullopt;
  }
  if (finder.probes) {
    const auto indirect =
        probes::make_lookup(finder.lookup.method, *finder.probes, tracer,
                            lookup_params(finder.probes_name, *finder.probes, finder.lookup));
    tracer.render_with(*indirect, params, state, control, see);
    if (drawn) *drawn = drawn_of(*finder.probes, drawings);
    return std::nullopt;
  }
  LiveMethod live(finder.method, finder.parameters, geometry, scene, control, true);
  live.update(rays::lighting_at(live.source(), time), control);
  log_info("{}: {}", finder.method, live.text());
  tracer.render_with(live.method().light(), params, state, control, see);
  if (drawn) *drawn = drawn_of(live.method(), drawings);
  return live.figures();
}

}  // namespace ssphh::pipeline
