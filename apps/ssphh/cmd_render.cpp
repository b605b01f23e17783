#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/trace/path_tracer.h>

#include "command.h"
#include "farm_options.h"
#include "gl_options.h"
#include "probe_options.h"
#include "scene_options.h"

namespace ssphh::app {
namespace {

struct RenderOptions {
  SceneOptions scene;
  FarmChoice farm;
  std::string output, png, method = "path", probes, lookup = "irradiance", weights, light = "sum", camera,
                           projection = "camera", tonemap = "clip", backend = "cpu";
  std::vector<std::string> aovs;
  int width = 1280, height = 720, max_depth = 3, passes = 1, spp = 16;
  float exposure = 0;
  bool resume = false, force = false;
};

const std::vector<std::string> aov_names = {"direct", "indirect", "albedo", "normal", "depth", "groups"};

std::filesystem::path checkpoint_path(const RenderOptions& o) {
  return o.output + ".state";
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
  return params;
}

void write_display(const std::filesystem::path& path, const image::Image& linear, const RenderOptions& o) {
  const auto curve = o.tonemap == "filmic" ? image::ToneCurve::filmic : image::ToneCurve::clip;
  image::write_image(path, image::tone_map(linear, {.exposure = o.exposure, .curve = curve}));
}

bool is_display_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

void write_picture(const std::filesystem::path& path, const image::Image& linear, const RenderOptions& o) {
  if (is_display_format(path)) {
    write_display(path, linear, o);
  } else {
    image::write_image(path, linear);
  }
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

void render_path(const trace::PathTracer& tracer, const scene::Scene&, const RenderOptions&,
                 const trace::RenderParams& params, trace::RenderState& state, const Control& control) {
  tracer.render(params, state, control);
}

gi::ProbeSet read_probes(const RenderOptions& o, const trace::PathTracer& tracer, const scene::Scene& scene) {
  if (o.probes.empty()) {
    throw Error("--probes", "method ssphh needs a probe file",
                fmt::format("make one with `ssphh bake {} -o probes.sphl`", o.scene.source));
  }
  gi::ProbeSet probes = gi::read_probe_file(o.probes);
  require_same_scene(o.probes, probes, scene, tracer.light_groups(), o.scene.time, o.force);
  return probes;
}

void render_ssphh(const trace::PathTracer& tracer, const scene::Scene& scene, const RenderOptions& o,
                  const trace::RenderParams& params, trace::RenderState& state, const Control& control) {
  const gi::ProbeSet probes = read_probes(o, tracer, scene);
  gi::LookupParams lookup;
  if (o.light == "self") lookup.layer = gi::ProbeLayer::self;
  std::unique_ptr<scene::IndirectLight> indirect;
  if (o.lookup == "light") {
    indirect = std::make_unique<gi::LightLookup>(probes, tracer, lookup);
  } else {
    lookup.weights = weight_params(o.probes, probes, o.weights);
    indirect = std::make_unique<gi::IrradianceLookup>(probes, tracer, lookup);
  }
  tracer.render_with(*indirect, params, state, control);
}

// What decides the pixels beside the parameters: the scene, the method and its probes.
Hash128 content_hash(const RenderOptions& o, const scene::Scene& scene) {
  const Hash128 hash = scene::scene_hash(scene);
  Hasher hasher;
  hasher.value(hash.high).value(hash.low).text(o.method);
  if (!o.probes.empty()) hasher.bytes(read_file(o.probes)).text(o.lookup).text(o.weights).text(o.light);
  return hasher.finish();
}

struct Method {
  const char* name;
  const char* description;
  void (*render)(const trace::PathTracer&, const scene::Scene&, const RenderOptions&,
                 const trace::RenderParams&, trace::RenderState&, const Control&);
};

constexpr Method methods[] = {
    {"path", "path tracing, the ground truth", render_path},
    {"ssphh", "direct light traced, indirect light looked up from SPHLs at the first hit", render_ssphh},
};

const Method& find_method(const std::string& name) {
  for (const Method& method : methods) {
    if (name == method.name) return method;
  }
  SSPHH_CHECK(!"the option's check admits known methods only");
  return methods[0];
}

/// The images that are written, in the order of farm::layer_names().
std::vector<std::string> wanted_layers(const RenderOptions& o) {
  std::vector<std::string> layers = {"color"};
  for (const std::string& aov : aov_names)
    if (std::ranges::find(o.aovs, aov) != o.aovs.end()) layers.push_back(aov);
  return layers;
}

trace::RenderState render_on_farm(const FarmSession& session, const trace::PathTracer& tracer,
                                  const scene::Scene& scene, const RenderOptions& o,
                                  const trace::RenderParams& params, farm::FarmReport& report,
                                  const Control& control) {
  std::optional<gi::ProbeSet> set;
  std::optional<farm::RenderProbes> probes;
  if (o.method == "ssphh") {
    set = read_probes(o, tracer, scene);
    probes = farm::RenderProbes{&*set, o.lookup, o.weights, o.light};
  }
  return farm::render(session.options(), scene, o.scene.time, params, probes, wanted_layers(o), report,
                      control);
}

std::array<double, 3> mean_radiance(const image::Image& picture) {
  std::array<double, 3> mean{};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c)
        mean[static_cast<std::size_t>(c)] += static_cast<double>(picture.rgb(x, y)[c]);
    }
  }
  for (double& m : mean) m /= static_cast<double>(picture.width) * picture.height;
  return mean;
}

void refuse_with_gl(const RenderOptions& o) {
  const auto refuse = [](const std::string& option, const std::string& problem) {
    throw Error(option, problem + " is not for --backend gl", "leave it out, or take --backend cpu");
  };
  if (o.method != "ssphh") refuse("--method", "path tracing");
  if (o.projection != "camera") refuse("--projection", "a picture of the whole sphere");
  if (o.weights == "trilinear" || o.weights == "fitted") refuse("--weights", o.weights);
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

// One frame of the real-time renderer; samples per pixel stand on a square grid.
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

void render(const RenderOptions& o, const Context& context) {
  if (o.backend == "gl") return render_gl(o, context);
  if (o.farm.any() && o.resume)
    throw Error("--resume", "is of renders in this process; a farm keeps finished tiles in --cache",
                "repeat the command without it");
  std::optional<FarmSession> session;  // first: its processes start while this one reads the scene
  if (o.farm.any()) session.emplace(o.farm);
  if (!o.weights.empty() && o.lookup == "light")
    throw Error("--weights", "blends probes, but --lookup light takes one alone", "leave out one of them");
  const scene::Scene scene = load_scene(o.scene);
  trace::RenderParams params = render_params(o, context, scene);
  const trace::PathTracer tracer(scene, o.scene.time);
  if (tracer.light_groups().empty()) {
    log_warning(
        "{}: no lights: the picture will be black (add lights to the file, --overlay, --environment or "
        "--sun-sky)",
        o.scene.source);
  }
  const Method& method = find_method(o.method);

  trace::RenderState state;
  const Hash128 key = trace::render_key(content_hash(o, scene), o.scene.time, params);
  state.key = key;
  if (o.resume && std::filesystem::exists(checkpoint_path(o))) {
    state = trace::load_state(checkpoint_path(o), key);
    log_info("resuming after {} passes", state.passes_done);
  }
  const auto start = std::chrono::steady_clock::now();
  farm::FarmReport farm_report;
  if (session) {
    state = render_on_farm(*session, tracer, scene, o, params, farm_report, context.control);
  } else {
    run_passes(o, state, [&] { method.render(tracer, scene, o, params, state, context.control); });
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const image::Image picture = trace::resolve(state.color, state.passes_done);
  write_picture(o.output, picture, o);
  if (!o.png.empty()) write_display(o.png, picture, o);
  write_aovs(o, state, tracer.light_groups());

  const auto mean = mean_radiance(picture);
  nlohmann::ordered_json object = {
      {"output", o.output},       {"method", o.method},          {"width", picture.width},
      {"height", picture.height}, {"passes", state.passes_done}, {"seconds", seconds},
      {"rays", state.rays},       {"paths", state.paths},        {"mean", mean}};
  std::string text =
      fmt::format("{}: {}×{}, {} paths, {} rays in {:.2f} s, mean radiance {:.4g} {:.4g} {:.4g}", o.output,
                  picture.width, picture.height, state.paths, state.rays, seconds, mean[0], mean[1], mean[2]);
  if (session) {
    object["farm"] = farm_json(farm_report);
    text += "\n" + farm_text(farm_report);
  }
  context.result(object, text);
}

}  // namespace

void add_render_command(CLI::App& app, Context& context) {
  auto options = std::make_shared<RenderOptions>();
  RenderOptions& o = *options;
  CLI::App* command = add_command(app, context, "render", "Render a picture",
                                  [options, &context] { render(*options, context); });
  add_scene_options(*command, o.scene);
  add_farm_options(*command, o.farm);

  std::vector<std::string> names;
  std::string description = "How indirect light is found:";
  for (const Method& method : methods) {
    names.emplace_back(method.name);
    description += fmt::format(" {} ({});", method.name, method.description);
  }
  description.pop_back();
  command->add_option("--method", o.method, description)->check(CLI::IsMember(names))->capture_default_str();
  command
      ->add_option("-o,--output", o.output,
                   "Picture: .exr or .hdr (linear radiance), .png or .jpg (tone mapped)")
      ->required();
  command->add_option("--png", o.png, "Also write a tone-mapped PNG here");
  command->add_option("--width", o.width, "Pixels")->check(CLI::Range(1, 65536))->capture_default_str();
  command->add_option("--height", o.height, "Pixels")->check(CLI::Range(1, 65536))->capture_default_str();
  command->add_option("--camera", o.camera, "Camera by name; default: the scene's first");
  command
      ->add_option(
          "--projection", o.projection,
          "camera; or the whole sphere at its position: equirect, or cube (6×1 strip, width = 6 × height)")
      ->check(CLI::IsMember({"camera", "equirect", "cube"}))
      ->capture_default_str();

  const std::string paths = "Light paths";
  command
      ->add_option("--max-depth", o.max_depth,
                   "Scattering events: 0 emitters only, 1 direct light, 2 one bounce …")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str()
      ->group(paths);
  command->add_option("--passes", o.passes, "Progressive passes; Ctrl-C keeps the finished ones")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->group(paths);
  command->add_option("--spp", o.spp, "Samples per pixel and pass")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str()
      ->group(paths);
  command
      ->add_flag("--resume", o.resume, "Continue from OUT.state, left by a cancelled run of the same command")
      ->group(paths);

  const std::string probes = "Method ssphh";
  command->add_option("--probes", o.probes, "Probe file (.sphl or .sphl.json)")->group(probes);
  command
      ->add_option("--lookup", o.lookup,
                   "irradiance: blend of visible SPHLs; light: nearest visible SPHL, as the paper")
      ->check(CLI::IsMember({"light", "irradiance"}))
      ->capture_default_str()
      ->group(probes);
  command
      ->add_option(
          "--backend", o.backend,
          "cpu: traced, any number of samples; gl: a frame of the real-time renderer, up to 4×4 samples "
          "per pixel (docs/methods/realtime.md)")
      ->check(CLI::IsMember({"cpu", "gl"}))
      ->capture_default_str()
      ->group(probes);
  add_weights_option(*command, o.weights)->group(probes);
  command
      ->add_option("--light", o.light,
                   "sum: own and neighbours' light where HIER was run; self: own light only")
      ->check(CLI::IsMember({"sum", "self"}))
      ->capture_default_str()
      ->group(probes);

  add_force_option(*command, o.force)->group(probes);

  const std::string output = "Output";
  command
      ->add_option("--aov", o.aovs,
                   "Extra float images beside the output: direct indirect albedo normal depth groups")
      ->delimiter(',')
      ->check(CLI::IsMember(aov_names))
      ->group(output);
  command->add_option("--exposure", o.exposure, "Exposure of tone-mapped output in stops")
      ->capture_default_str()
      ->group(output);
  command->add_option("--tonemap", o.tonemap, "clip at white, or filmic")
      ->check(CLI::IsMember({"clip", "filmic"}))
      ->capture_default_str()
      ->group(output);
}

}  // namespace ssphh::app
