#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/image/io.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>

#include "commands/command.h"
#include "commands/live_method.h"
#include "commands/render_gl.h"
#include "options/method_options.h"
#include "options/probe_options.h"
#include "options/render_options.h"
#include "results/geometry_builds.h"

namespace ssphh::app {
namespace {

const std::vector<std::string> aov_names = {"direct", "indirect", "albedo", "normal", "depth", "groups"};

std::filesystem::path checkpoint_path(const RenderOptions& o) {
  return o.output + ".state";
}

// A SPHL by its name, or "X,Y,Z".
vec3 place_of(const scene::Scene& scene, const std::string& text, float time) {
  std::string names;
  for (const scene::SphlPlace& sphl : scene::sphl_places(scene, time)) {
    if (sphl.name == text) return sphl.position;
    names += (names.empty() ? "" : ", ") + sphl.name;
  }
  vec3 place;
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%f,%f,%f%n", &place.x, &place.y, &place.z, &end);
  if (read == 3 && end == static_cast<int>(text.size()) && std::isfinite(place.x + place.y + place.z))
    return place;
  throw Error("--at " + text, "is neither a SPHL of the scene nor X,Y,Z",
              names.empty() ? "the scene has no SPHLs" : "its SPHLs: " + names);
}

trace::RenderParams render_params(const RenderOptions& o, const Context& context, const scene::Scene& scene) {
  trace::RenderParams params;
  params.width = o.width;
  params.height = o.height;
  params.camera = scene::camera_pose(scene, o.camera, o.scene.time);
  params.path = {o.max_depth, o.passes, o.spp, context.seed};
  for (const std::string& aov : o.aovs) params.per_group |= aov == "groups";
  if (o.projection == "equirect") {
    params.projection = trace::Projection::equirect;
  } else if (o.projection == "cube") {
    params.projection = trace::Projection::cube_strip;
  } else if (params.camera.camera.orthographic) {
    params.projection = trace::Projection::orthographic;
  }
  if (!o.at.empty()) {
    if (o.projection == "camera")
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
  const std::filesystem::path output = o.output;
  const std::string stem = (output.parent_path() / output.stem()).string();
  const auto write = [&](const std::string& name, const image::Image& sum) {
    image::write_image(stem + "." + name + ".exr", trace::resolve(sum, state.passes_done));
  };
  for (const std::string& aov : o.aovs) {
    if (aov == "direct") write(aov, state.direct);
    if (aov == "indirect") write(aov, state.indirect);
    if (aov == "albedo") write(aov, state.albedo);
    if (aov == "normal") write(aov, state.normal);
    if (aov == "depth") write(aov, state.depth);
    if (aov == "groups") {
      for (std::size_t g = 0; g < state.groups.size(); ++g) {
        std::string name = groups[g];
        for (char& c : name)
          c = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
        write("group." + name, state.groups[g]);
      }
    }
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
  probes::ProbeSet probes = probes::read_probe_file(o.probes);
  require_same_scene(o.probes, probes, scene, scene::light_groups(scene), o.scene.time, o.force);
  return probes;
}

void render_with_probes(const trace::PathTracer& tracer, const scene::Scene& scene, const RenderOptions& o,
                        const trace::RenderParams& params, trace::RenderState& state,
                        const Control& control) {
  const probes::ProbeSet probes = read_probes(o, scene);
  const auto indirect =
      probes::make_lookup(o.lookup.method, probes, tracer, lookup_params(o.probes, probes, o.lookup));
  tracer.render_with(*indirect, params, state, control);
}

// What decides the pixels beside the parameters: the scene, the method and its probes.
Hash128 content_hash(const RenderOptions& o, const scene::Scene& scene) {
  const Hash128 hash = scene::scene_hash(scene);
  Hasher hasher;
  hasher.value(hash.high).value(hash.low).text(o.method);
  for (const std::string& parameter : o.parameters) hasher.text(parameter);
  if (!o.probes.empty()) {
    hasher.bytes(read_file(o.probes)).text(name_of(o.lookup.method)).text(name_of(o.lookup.layer));
    hasher.text(o.lookup.weights ? name_of(*o.lookup.weights) : "");
  }
  return hasher.finish();
}

// The method's extra numbers; null for those that have none.
json::Value render_here(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                        const RenderOptions& o, const trace::RenderParams& params, trace::RenderState& state,
                        const Control& control) {
  const trace::PathTracer tracer(geometry, scene, o.scene.time);
  if (o.method == "path") {
    tracer.render(params, state, control);
    return nullptr;
  }
  if (!o.probes.empty()) {
    render_with_probes(tracer, scene, o, params, state, control);
    return nullptr;
  }
  LiveMethod live(o.method, o.parameters, geometry, scene, control);
  live.update(rays::lighting_at(live.source(), o.scene.time), control);
  log_info("{}: {}", o.method, live.text());
  tracer.render_with(live.method().light(), params, state, control);
  return live.json();
}

void check_method(const RenderOptions& o) {
  if (!o.probes.empty() && o.method != "ssphh")
    throw Error("--probes", fmt::format("is of method ssphh, not of {}", o.method));
  if (!o.parameters.empty() && o.method == "path")
    throw Error("--param", "method path has none", "see --max-depth, --spp and --passes");
  if (!o.parameters.empty() && !o.probes.empty())
    throw Error("--param", "tells how probes are made, and --probes gives made ones",
                "leave out one of them");
  if (o.farm.any() && o.method != "path" && o.method != "ssphh")
    throw Error("--method " + o.method, "is rendered in this process only", "leave out --broker and --local");
}

/// The images that are written, in the order of farm::layer_names().
std::vector<std::string> wanted_layers(const RenderOptions& o) {
  std::vector<std::string> layers = {"color"};
  for (const std::string& aov : aov_names)
    if (std::ranges::find(o.aovs, aov) != o.aovs.end()) layers.push_back(aov);
  return layers;
}

trace::RenderState render_on_farm(const FarmSession& session, const scene::Scene& scene,
                                  const RenderOptions& o, const trace::RenderParams& params,
                                  farm::FarmReport& report, const Control& control) {
  std::optional<probes::ProbeSet> set;
  std::optional<farm::RenderProbes> probes;
  if (o.method == "ssphh") {
    set = read_probes(o, scene);
    probes = farm::RenderProbes{&*set, o.lookup};
  }
  return farm::render(session.options(), scene, o.scene.time, params, probes, wanted_layers(o), report,
                      control);
}

void render(const RenderOptions& o, const Context& context) {
  if (o.backend == "gl") return render_gl(o, context);
  const GeometryBuilds builds;
  check_method(o);
  if (o.occlusion > 0)
    throw Error("--occlusion", "is an approximation of the real-time renderer", "add --backend gl");
  if (o.indirect_scale > 1)
    throw Error("--indirect-scale", "is of the real-time renderer", "add --backend gl");
  if (o.farm.any() && o.resume)
    throw Error("--resume", "is of renders in this process; a farm keeps finished tiles in --cache",
                "repeat the command without it");
  std::optional<FarmSession> session;  // first: its processes start while this one reads the scene
  if (o.farm.any()) session.emplace(o.farm);
  if (o.lookup.weights && o.lookup.method == probes::LookupMethod::light)
    throw Error("--weights", "blends probes, but --lookup light takes one alone", "leave out one of them");
  const scene::Scene scene = load_scene(o.scene);
  trace::RenderParams params = render_params(o, context, scene);
  const std::vector<std::string> groups = scene::light_groups(scene);
  if (groups.empty()) {
    log_warning(
        "{}: no lights: the picture will be black (add lights to the file, --overlay, --environment or "
        "--sun-sky)",
        o.scene.source);
  }
  trace::RenderState state;
  const Hash128 key = trace::render_key(content_hash(o, scene), o.scene.time, params);
  state.key = key;
  if (o.resume && std::filesystem::exists(checkpoint_path(o))) {
    state = trace::load_state(checkpoint_path(o), key);
    log_info("resuming after {} passes", state.passes_done);
  }
  trace::SharedGeometry geometry;  // on a farm, the workers build theirs
  if (!session) geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const auto start = std::chrono::steady_clock::now();
  farm::FarmReport farm_report;
  json::Value numbers;
  if (session) {
    state = render_on_farm(*session, scene, o, params, farm_report, context.control);
  } else {
    run_passes(o, state, [&] { numbers = render_here(geometry, scene, o, params, state, context.control); });
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const image::Image picture = trace::resolve(state.color, state.passes_done);
  write_picture(o.output, picture, o);
  if (!o.png.empty()) write_display(o.png, picture, o);
  write_aovs(o, state, groups);

  const auto mean = mean_radiance(picture);
  json::Value object = {{"output", o.output},
                        {"method", o.method},
                        {"width", picture.width},
                        {"height", picture.height},
                        {"passes", state.passes_done},
                        {"seconds", seconds},
                        {"rays", state.rays},
                        {"paths", state.paths},
                        {"mean", mean},
                        {"geometry_builds", builds.count()}};
  std::string text =
      fmt::format("{}: {}×{}, {} paths, {} rays in {:.2f} s, mean radiance {:.4g} {:.4g} {:.4g}", o.output,
                  picture.width, picture.height, state.paths, state.rays, seconds, mean[0], mean[1], mean[2]);
  if (!numbers.is_null()) object.update(numbers);
  if (session) {
    object["farm"] = farm_json(farm_report);
    text += "\n" + farm_text(farm_report);
  }
  context.result(object, text);
}

}  // namespace

void add_render_command(Command app, Context& context) {
  auto options = std::make_shared<RenderOptions>();
  RenderOptions& o = *options;
  Command command = add_command(app, context, "render", "Render a picture",
                                [options, &context] { render(*options, context); });
  add_scene_options(command, o.scene);
  add_farm_options(command, o.farm);

  std::vector<std::string> names = {"path"};
  std::string description = "How indirect light is found: path (path tracing, the ground truth);";
  for (const methods::MethodEntry& entry : methods::method_table()) {
    names.emplace_back(entry.name);
    description += fmt::format(" {} ({});", entry.name, entry.about);
  }
  description.pop_back();
  command.option("--method", o.method, description).one_of(names);
  add_method_parameters(command, o.parameters);
  command
      .option("-o,--output", o.output, "Picture: .exr or .hdr (linear radiance), .png or .jpg (tone mapped)")
      .required();
  command.option("--png", o.png, "Also write a tone-mapped PNG here");
  command.option("--width", o.width, "Pixels").range(1, 65536);
  command.option("--height", o.height, "Pixels").range(1, 65536);
  command.option("--camera", o.camera, "Camera by name; default: the scene's first");
  command
      .option(
          "--projection", o.projection,
          "camera; or the whole sphere at its position: equirect, or cube (6×1 strip, width = 6 × height)")
      .one_of({"camera", "equirect", "cube"});
  command.option(
      "--at", o.at,
      "Place of the sphere, its axes the world's: a SPHL by name, or X,Y,Z; default: the camera's");

  const std::string paths = "Light paths";
  command
      .option("--max-depth", o.max_depth,
              "Scattering events: 0 emitters only, 1 direct light, 2 one bounce …")
      .range(0, 1000)
      .group(paths);
  command.option("--passes", o.passes, "Progressive passes; Ctrl-C keeps the finished ones")
      .range(1, 1000000)
      .group(paths);
  command.option("--spp", o.spp, "Samples per pixel and pass").range(1, 65536).group(paths);
  command.flag("--resume", o.resume, "Continue from OUT.state, left by a cancelled run of the same command")
      .group(paths);

  const std::string probes = "Method ssphh";
  command
      .option("--probes", o.probes,
              "Probe file (.sphl or .sphl.json); none: probes are placed and lit for this picture")
      .group(probes);
  add_lookup_option(command, o.lookup.method).group(probes);
  command
      .option("--backend", o.backend,
              "cpu: traced, any number of samples; gl: a frame of the real-time renderer (methods ssphh, "
              "vct, vpl, direct), up to 4×4 samples per pixel (docs/methods/realtime.md)")
      .one_of({"cpu", "gl"})
      .group(probes);
  command
      .option("--occlusion", o.occlusion,
              "With --backend gl: dim SPHLs' light in corners by what stands within so many metres; 0: off")
      .range(0.0f, 100.0f)
      .group(probes);
  command
      .option("--indirect-scale", o.indirect_scale,
              "With --backend gl: look indirect light up at every n-th pixel each way, and interpolate where "
              "that shows no difference (docs/methods/realtime.md)")
      .range(1, 8)
      .group(probes);
  add_weights_option(command, o.lookup.weights).group(probes);
  add_layer_option(command, o.lookup.layer).group(probes);

  add_force_option(command, o.force).group(probes);

  const std::string output = "Output";
  command
      .option("--aov", o.aovs,
              "Extra float images beside the output: direct indirect albedo normal depth groups")
      .separated_by(',')
      .one_of(aov_names)
      .group(output);
  command.option("--exposure", o.exposure, "Exposure of tone-mapped output in stops").group(output);
  command.choice("--tonemap", o.tonemap, "clip at white, or filmic").group(output);
}

}  // namespace ssphh::app
