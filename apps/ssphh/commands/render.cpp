#include "commands/render.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/image/io.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/tile_folder.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "results/geometry_builds.h"
#include "results/pictures.h"
#include "results/tev.h"

namespace ssphh::app {
namespace {

std::filesystem::path checkpoint_path(const RenderOptions& o) {
  return o.output + ".state";
}

trace::RenderParams render_params(const RenderOptions& o, const scene::Scene& scene,
                                  const trace::SharedGeometry& geometry) {
  trace::RenderParams params;
  params.width = o.width;
  params.height = o.height;
  params.camera = camera_of(scene, o.camera, o.scene.time, geometry);
  params.path = {o.max_depth, o.passes, o.spp, o.seed};
  params.per_group = std::ranges::count(o.aovs, trace::RenderLayer::groups) > 0;
  params.projection = projection_of(o.projection, params.camera.camera);
  if (!o.at.empty()) {
    if (o.projection == PictureProjection::camera)
      throw Error("--at", "is the place of a picture of the whole sphere",
                  "add --projection cube or equirect");
    params.camera.world = mat4(1);
    params.camera.world[3] = vec4(place_of(scene, o.at, o.scene.time), 1);
  }
  return params;
}

// OUT.exr gives OUT.albedo.exr and so on: float data, whatever the format of the picture.
void write_aovs(const RenderOptions& o, const trace::RenderState& state,
                const std::vector<std::string>& groups) {
  for (const trace::RenderLayer layer : o.aovs) {
    std::vector<std::string> names = {std::string(name_of(layer))};
    if (layer == trace::RenderLayer::groups) {
      names = file_parts(groups);
      for (std::string& name : names) name = "group." + name;
    }
    const std::span<const image::Image> images = trace::images_of(state, layer);
    for (std::size_t i = 0; i < images.size(); ++i)
      image::write_image(beside(o.output, names[i] + ".exr"), trace::resolve(images[i], state.passes_done));
  }
}

// Finished passes survive Ctrl-C in a checkpoint beside the output; --resume continues it.
template <class Render>
void run_passes(const RenderOptions& o, trace::RenderState& state, const Render& render) {
  try {
    render();
  } catch (const Cancelled&) {
    if (state.passes_done > 0) {
      trace::save_state(state, checkpoint_path(o));
      log_info("stopped after {} of {} passes; continue with --resume", state.passes_done, o.passes);
    }
    throw;
  }
  std::error_code ignored;
  std::filesystem::remove(checkpoint_path(o), ignored);
}

probes::ProbeSet read_probes(const RenderOptions& o, const scene::Scene& scene) {
  if (o.probes.empty()) {
    throw Error("--probes", "a farm needs a probe file for the method ssphh",
                fmt::format("make one with `ssphh bake {} -o probes.sphl`", o.scene.source));
  }
  return read_probes_of(scene, o.probes, o.scene.time, o.force);
}

// What decides the pixels beside the parameters: the scene, the method and its probes.
Hash128 content_hash(const RenderOptions& o, const scene::Scene& scene) {
  const Hash128 hash = scene::scene_hash(scene);
  Hasher hasher;
  hasher.value(hash.high).value(hash.low).text(o.method);
  for (const std::string& parameter : o.parameters) hasher.text(parameter);
  if (!o.probes.empty()) {
    const std::vector<probes::ProbeKey> keys = probes::read_probe_keys(o.probes);
    for (const probes::ProbeKey& key : keys) {
      if (probes::is_tile_folder(key.file)) {
        hasher.text(probes::TileFolder(key.file).content().hex());
      } else {
        hasher.bytes(read_file(key.file));
      }
    }
    if (keys.size() > 1) hasher.text(o.probes);
    hasher.text(name_of(o.lookup.method)).text(name_of(o.lookup.layer));
    hasher.text(o.lookup.weights ? name_of(*o.lookup.weights) : "");
  }
  return hasher.finish();
}

std::optional<MethodFigures> render_here(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                         const RenderOptions& o, const trace::RenderParams& params,
                                         trace::RenderState& state, sketch::Sketch& drawn,
                                         const Control& control, const trace::SeePass& see) {
  std::optional<probes::ProbeSet> set;
  if (!o.probes.empty()) {
    set = pipeline::read_probes_in_view(scene, o.probes, o.scene.time, o.force,
                                        trace::TransportScene(geometry, scene), params);
  }
  const pipeline::LightFinder finder{o.method, o.parameters, set ? &*set : nullptr, o.probes, o.lookup};
  return pipeline::render_scene(geometry, scene, o.scene.time, finder, params, state, control, drawings_of(o),
                                &drawn, see);
}

void check_method(const RenderOptions& o) {
  pipeline::check_method(o.method, !o.parameters.empty(), !o.probes.empty());
  if (o.farm.any() && o.method != "path" && o.method != "ssphh")
    throw Error("--method " + o.method, "is rendered in this process only", "leave out --broker and --local");
}

/// The images that are written, in the order of their table.
std::vector<trace::RenderLayer> wanted_layers(const RenderOptions& o) {
  std::vector<trace::RenderLayer> layers;
  for (const trace::RenderLayer layer : trace::render_layers())
    if (layer == trace::RenderLayer::color || std::ranges::count(o.aovs, layer) > 0) layers.push_back(layer);
  return layers;
}

trace::RenderState render_on_farm(const FarmSession& session, const scene::Scene& scene,
                                  const RenderOptions& o, const trace::RenderParams& params,
                                  farm::FarmReport& report, sketch::Sketch& drawn, const Control& control) {
  std::optional<probes::ProbeSet> set;
  std::optional<farm::RenderProbes> probes;
  if (o.method == "ssphh") {
    set = read_probes(o, scene);
    probes = farm::RenderProbes{&*set, o.lookup};
    drawn = pipeline::drawn_of(*set, drawings_of(o));
  }
  return farm::render(session.options(), scene, o.scene.time, params, probes, wanted_layers(o), report,
                      control);
}

void check_backend(const RenderOptions& o) {
  if (o.occlusion > 0)
    throw Error("--occlusion", "is an approximation of the real-time renderer", "add --backend gl");
  if (o.indirect_scale > 1)
    throw Error("--indirect-scale", "is of the real-time renderer", "add --backend gl");
  if (o.farm.any() && o.resume)
    throw Error("--resume", "is of renders in this process; a farm keeps finished tiles in --cache",
                "repeat the command without it");
}

RenderResult render_cpu(const RenderOptions& o, TevViewer& viewer, const Control& control) {
  const GeometryBuilds builds;
  check_method(o);
  check_backend(o);
  pipeline::check_drawings(o.method, !o.probes.empty(), drawings_of(o));
  const std::optional<FarmSession> session = farm_session(o.farm);
  if (o.lookup.weights && o.lookup.method == probes::LookupMethod::light)
    throw Error("--weights", "blends probes, but --lookup light takes one alone", "leave out one of them");
  const scene::Scene scene = load_lit_scene(o.scene);
  trace::SharedGeometry geometry;  // on a farm, the workers build theirs
  if (!session) geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::RenderParams params = render_params(o, scene, geometry);
  const std::vector<std::string> groups = scene::light_groups(scene);
  trace::RenderState state;
  state.key = trace::render_key(content_hash(o, scene), o.scene.time, params);
  if (o.resume && std::filesystem::exists(checkpoint_path(o))) {
    state = trace::load_state(checkpoint_path(o), state.key);
    log_info("resuming after {} passes", state.passes_done);
  }
  const Stopwatch watch;
  RenderResult result;
  sketch::Sketch drawn;
  if (session) {
    state = render_on_farm(*session, scene, o, params, result.farm.emplace(), drawn, control);
  } else {
    const auto see = [&](const trace::RenderState& passes) {
      if (viewer) viewer.show(o.output, trace::resolve(passes.color, passes.passes_done));
    };
    run_passes(o, state,
               [&] { result.method = render_here(geometry, scene, o, params, state, drawn, control, see); });
  }
  result.seconds = watch.seconds();
  result.passes = state.passes_done, result.paths = state.paths, result.rays = state.rays;
  result.picture = trace::resolve(state.color, state.passes_done);
  draw_and_write(result, o, drawn, geometry, scene, params, control);
  write_aovs(o, state, groups);
  result.geometry_builds = builds.count();
  return result;
}

}  // namespace

RenderResult run_render(const RenderOptions& given, const Control& control) {
  RenderOptions o = given;
  o.method = method_of(given);
  TevViewer viewer(o.tev);
  RenderResult result =
      o.backend == RenderBackend::gl ? render_gl(o, control) : render_cpu(o, viewer, control);
  viewer.show(o.output, result.picture);
  return result;
}

void draw_and_write(RenderResult& result, const RenderOptions& o, const sketch::Sketch& marks,
                    trace::SharedGeometry geometry, const scene::Scene& scene,
                    const trace::RenderParams& params, const Control& control) {
  result.marks = marks.size();
  if (marks.empty()) return write_rendered(result, o);
  if (!geometry) geometry = std::make_shared<const trace::SceneGeometry>(scene);
  write_rendered(result, o, [&](image::Image& picture, float white) {
    pipeline::draw_marks(picture, marks, geometry, scene, o.scene.time, params, white, control);
  });
}

void write_rendered(RenderResult& result, const RenderOptions& o, const DrawOver& over) {
  SharedExposure exposure(o.exposure, o.tonemap);
  if (is_display_format(o.output) || !o.png.empty()) result.exposure = exposure.of(result.picture);
  result.mean = mean_radiance(result.picture);
  if (over) over(result.picture, std::exp2(-exposure.of(result.picture)));
  const image::ToneMap map{.exposure = result.exposure.value_or(0), .curve = o.tonemap};
  write_picture(o.output, result.picture, map);
  if (!o.png.empty()) write_display(o.png, result.picture, map);
}

json::Value to_json(const RenderResult& r, const RenderOptions& o) {
  json::Value object = {{"output", o.output}, {"method", method_of(o)}};
  if (r.gl) object.update({{"backend", name_of(o.backend)}, {"renderer", r.gl->renderer}});
  object.update({{"width", r.picture.width}, {"height", r.picture.height}});
  if (r.gl) {
    object.update({{"samples", r.gl->samples}, {"seconds", r.seconds}});
  } else {
    object.update({{"passes", r.passes}, {"seconds", r.seconds}, {"rays", r.rays}, {"paths", r.paths}});
  }
  if (r.exposure) object["exposure"] = *r.exposure;
  object.update({{"mean", r.mean}, {"geometry_builds", r.geometry_builds}});
  if (!o.draw.empty()) object["marks"] = r.marks;
  if (r.method) object.update(to_json(*r.method));
  if (r.gl) {
    for (const auto& [name, value] : r.gl->numbers) object[name] = value;
  }
  if (r.farm) object["farm"] = farm_json(*r.farm);
  return object;
}

std::string to_text(const RenderResult& r, const RenderOptions& o) {
  const std::string work =
      r.gl ? fmt::format("{} samples per pixel in {:.2f} s on {}", r.gl->samples, r.seconds, r.gl->renderer)
           : fmt::format("{} paths, {} rays in {:.2f} s", r.paths, r.rays, r.seconds);
  std::string text = fmt::format("{}: {}×{}, {}, mean radiance {:.4g} {:.4g} {:.4g}", o.output,
                                 r.picture.width, r.picture.height, work, r.mean[0], r.mean[1], r.mean[2]);
  if (r.exposure) text += ", " + exposure_text(*r.exposure);
  if (r.gl) {
    for (const auto& [name, value] : r.gl->numbers) text += fmt::format(", {} {:.6g}", name, value);
  }
  if (!o.draw.empty()) text += fmt::format(", {} marks drawn", r.marks);
  if (r.farm) text += "\n" + farm_text(*r.farm);
  return text;
}

void add_render_command(Command app, Context& context) {
  auto [command, options] = add_command(app, context, "render", "Render a picture", run_render);
  add_render_options(command, options);
}

}  // namespace ssphh::app
