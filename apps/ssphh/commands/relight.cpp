#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/gi/fitted_weights.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/probe_file.h>
#include <ssphh/gi/session_sets.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "commands/relight_animation.h"
#include "commands/relight_check.h"
#include "options/place_options.h"
#include "options/probe_options.h"
#include "options/scene_options.h"
#include "results/geometry_builds.h"
#include "results/relight_report.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

struct RelightOptions {
  SceneOptions scene;
  PlaceOptions place;
  std::vector<std::string> animate;
  std::string output, save, camera, format = "png";
  gi::WeightMethod weights = gi::WeightMethod::mls;
  int frames = 60, truth = 0, pictures = 1, points = 256, truth_spp = 1024, max_depth = 25, fit_frames = 3;
  int width = 640, height = 360, spp = 8;
  float exposure = 0;
  double fps = 30;
  bool force = false;
  gi::RelightParams params;
};

/// A frame whose light is kept for what comes after the timed run.
struct KeptFrame {
  int frame;
  scene::LightingState state;
  std::vector<sh::RadianceSh> reflected;
};

class Relighting {
 public:
  Relighting(Context& context, const RelightOptions& options)
      : context_(context),
        o_(options),
        scene_(load_scene(options.scene)),
        geometry_(std::make_shared<const trace::SceneGeometry>(scene_)),
        source_(geometry_, scene_),
        animation_(source_, scene_, options.scene.time, options.animate) {}

  void run() {
    run_.frames_asked = o_.frames;
    run_.fps = o_.fps;
    if (!o_.output.empty() && o_.pictures > 0)  // Fails before the work rather than after it.
      scene::camera_pose(scene_, o_.camera, o_.scene.time);
    std::vector<gi::ProbePlace> places = find_places();
    warn_about_places(places, source_, gi::place_params(scene_, o_.scene.time).interest,
                      animation_.moves_time(), context_.control);
    const auto start = std::chrono::steady_clock::now();
    gi::RelightSession session(source_, std::move(places), o_.params, animation_.frame(0).time,
                               context_.control);
    run_.build_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    warn_about_network(session);
    try {
      play(session);
      if (!o_.save.empty()) save(session);
      look_back(session);
    } catch (const Cancelled&) {
      if (run_.updates.empty()) throw;
      run_.cancelled = true;
      context_.exit_code = 1;
      log(LogLevel::error, "cancelled");
    }
    if (!o_.output.empty() && !run_.errors.empty())
      write_error_curve(fs::path(o_.output) / "error.svg", run_);
    report(session);
  }

 private:
  std::vector<gi::ProbePlace> find_places() {
    std::vector<gi::ProbePlace> places;
    if (is_probe_file(o_.place)) {
      const gi::ProbeSet set = gi::read_probe_file(o_.place.probes);
      require_same_scene(o_.place.probes, set, scene_, source_.light_groups(), {}, o_.force);
      for (const gi::Probe& probe : set.probes) places.push_back({probe.name, probe.position, probe.radius});
    } else if (const auto placed =
                   place_for(geometry_, scene_, o_.scene.time, o_.place, "", context_.control)) {
      for (const gi::PlacedProbe& probe : placed->placement.probes)
        places.push_back({probe.name, probe.position, probe.radius});
    } else {
      for (const scene::SphlPlace& sphl : scene::sphl_places(scene_, o_.scene.time))
        places.push_back({sphl.name, sphl.position, sphl.radius});
    }
    if (places.empty()) throw Error("--probes", "there are no probes", "let --probes auto find places");
    return places;
  }

  static bool is_due(int frame, int every) { return every > 0 && frame % every == 0; }
  float share(int frame) const {
    return o_.frames > 1 ? static_cast<float>(frame) / static_cast<float>(o_.frames - 1) : 0;
  }

  /// All frames one after the other, with nothing in between that would disturb their times.
  void play(gi::RelightSession& session) {
    ProgressStage progress(context_.control, "relighting", static_cast<std::uint64_t>(o_.frames), "frames");
    for (int f = 0; f < o_.frames; ++f) {
      context_.control.check();
      scene::LightingState state = animation_.frame(share(f));
      run_.updates.push_back(session.update(state));
      if (is_due(f, o_.truth) || (!o_.output.empty() && is_due(f, o_.pictures)))
        kept_.push_back({f, std::move(state), session.reflected()});
      progress.advance(1);
    }
  }

  void save(const gi::RelightSession& session) {
    scene::LightingState unscaled = session.lighting();
    unscaled.group_scales.assign(unscaled.group_scales.size(), vec3(1));
    gi::GeneratorInfo generator;
    generator.op = o_.params.op;
    generator.scene = scene_.name;
    generator.scene_hash = scene::light_hash(scene::with_lighting(scene_, unscaled));
    gi::write_probe_file(gi::baked_set(session, source_.light_groups(), generator, context_.control),
                         o_.save);
    saved_ = true;
  }

  /// Truth and pictures of the frames kept.
  void look_back(gi::RelightSession& session) {
    if (kept_.empty()) return;
    ProgressStage progress(context_.control, o_.truth > 0 ? "path tracing the truth" : "pictures",
                           kept_.size(), "frames");
    const Control quiet{nullptr, context_.control.cancel};
    gi::LookupParams params;
    params.weights.method = o_.weights;
    std::optional<gi::FittedPoints> fitted;
    if (params.weights.method == gi::WeightMethod::fitted) fitted = fit(session, quiet);
    for (const KeptFrame& kept : kept_) {
      const scene::Scene lit = scene::with_lighting(scene_, kept.state);
      const trace::PathTracer tracer(geometry_, lit, kept.state.time);
      gi::ProbeSet set = gi::lookup_set(session.places(), kept.reflected);
      set.fitted = fitted;
      const gi::IrradianceLookup lookup(set, tracer, params);
      if (is_due(kept.frame, o_.truth)) measure(session, kept, tracer, lookup, quiet);
      if (!o_.output.empty() && is_due(kept.frame, o_.pictures)) draw(kept, lit, tracer, lookup, quiet);
      progress.advance(1);
    }
  }

  /// Weights that serve the whole run: fitted at once to frames evenly spaced over it.
  gi::FittedPoints fit(gi::RelightSession& session, const Control& control) {
    gi::WeightFit fit(gi::surfel_points(session.network()));
    const int count = std::min(o_.fit_frames, o_.frames);
    for (int k = 0; k < count; ++k) {
      session.update(animation_.frame(count > 1 ? static_cast<float>(k) / static_cast<float>(count - 1) : 0),
                     control);
      fit.add_pose(session.network(), source_, session.direct_by_group(), control);
    }
    return fit.solve(control);
  }

  void measure(const gi::RelightSession& session, const KeptFrame& kept, const trace::PathTracer& tracer,
               const scene::IndirectLight& lookup, const Control& control) {
    std::vector<vec3> origins;
    const std::vector<mat4> world = scene::world_matrices(scene_, kept.state.time);
    for (const scene::Camera& camera : scene_.cameras)
      origins.emplace_back(world[static_cast<std::size_t>(camera.node)][3]);
    for (const gi::ProbePlace& place : session.places()) origins.push_back(place.position);
    const std::vector<scene::SurfacePoint> points =
        gi::reachable_points(source_, origins, kept.state.time, {o_.points, context_.seed}, control);

    std::vector<vec3> looked_up;
    for (const scene::SurfacePoint& point : points) looked_up.push_back(lookup.irradiance(point));
    const auto truth = tracer.surface_irradiance(
        points, {.max_depth = o_.max_depth, .passes = 1, .spp = o_.truth_spp, .seed = context_.seed},
        control);
    run_.errors.push_back({kept.frame, gi::lookup_error(looked_up, truth)});
  }

  void draw(const KeptFrame& kept, const scene::Scene& lit, const trace::PathTracer& tracer,
            const scene::IndirectLight& lookup, const Control& control) const {
    trace::RenderParams params;
    params.width = o_.width;
    params.height = o_.height;
    params.camera = scene::camera_pose(lit, o_.camera, kept.state.time);
    if (params.camera.camera.orthographic) params.projection = trace::Projection::orthographic;
    params.path = {.max_depth = 3, .passes = 1, .spp = o_.spp, .seed = context_.seed};
    trace::RenderState state;
    tracer.render_with(lookup, params, state, control);
    const image::Image picture = trace::resolve(state.color, state.passes_done);
    const fs::path path = fs::path(o_.output) / fmt::format("frame-{:04}.{}", kept.frame, o_.format);
    image::write_image(path,
                       o_.format == "png" ? image::tone_map(picture, {.exposure = o_.exposure}) : picture);
  }

  void report(const gi::RelightSession& session) const {
    json::Value object = relight_json(run_);
    object["operator"] = name_of(o_.params.op);
    object["weights"] = name_of(o_.weights);
    object["probes"] = session.places().size();
    object["surfels"] = session.network().surfel_count();
    object["surfel_size"] = session.network().params().surfel_size;
    object["links"] = session.network().links().link_count();
    object["geometry_builds"] = builds_.count();
    if (saved_) object["saved"] = o_.save;
    context_.result(object,
                    fmt::format("{} probes, {} surfels of {:.3g} m, {} links\n{}", session.places().size(),
                                session.network().surfel_count(), session.network().params().surfel_size,
                                session.network().links().link_count(), relight_text(run_)));
  }

  Context& context_;
  const RelightOptions& o_;
  GeometryBuilds builds_;
  scene::Scene scene_;
  trace::SharedGeometry geometry_;
  trace::TransportScene source_;
  RelightAnimation animation_;
  RelightRun run_;
  std::vector<KeptFrame> kept_;
  bool saved_ = false;
};

void relight(Context& context, RelightOptions& options) {
  if (options.params.op == gi::LightOperator::bounce && options.params.poses != 0)
    throw Error("--poses", "is of --operator surfel");
  if (!options.output.empty()) {
    std::error_code error;
    fs::create_directories(options.output, error);
    if (!fs::is_directory(options.output))
      throw Error(options.output, "cannot make this folder for the frames");
  }
  Relighting(context, options).run();
}

void add_transport_options(Command command, RelightOptions& o) {
  const std::string group = "Transport";
  command
      .choice("--operator", o.params.op,
              "surfel: light goes from surface patch to patch until it settles; bounce: from probe to "
              "probe, each surface looking up the probes around it",
              {"surfel", "bounce"})
      .group(group);
  command.option("--degree", o.params.degree, "Highest band of the probes' functions")
      .range(0, sh::max_degree)
      .group(group);
  command.option("--directions", o.params.transport.directions, "Rays of a probe")
      .range(16, 65536)
      .group(group);
  command
      .option("--surfel-size", o.params.transport.surfel_size,
              "Edge of a surface patch [m]; 0: a twentieth of the scene's radius, 0.05 to 0.5")
      .non_negative()
      .group(group);
  command
      .option("--poses", o.params.poses,
              "Blend doors and the like between so many poses found beforehand, 2 or more; 0: pose exactly")
      .range(0, 1 << 16)
      .group(group);
  command.option("--link-rays", o.params.transport.link_rays, "Rays of a surface patch")
      .range(8, 65536)
      .group(group);
}

void add_truth_options(Command command, RelightOptions& o) {
  const std::string group = "Truth";
  command
      .option("--truth", o.truth, "Path trace every so-many-th frame and report the lookup's error; 0: never")
      .range(0, 1 << 20)
      .group(group);
  command.option("--points", o.points, "Surface points at which the error is measured")
      .range(1, 1 << 24)
      .group(group);
  command.option("--truth-spp", o.truth_spp, "Paths per point").range(2, 1 << 22).group(group);
  command.option("--max-depth", o.max_depth, "Scattering events of a path").range(2, 1000).group(group);
  command
      .choice("--weights", o.weights,
              "How probes are blended: distance, trilinear, mls; fitted to the light transport, once for "
              "the run, at --fit-frames of its frames")
      .group(group);
  command
      .option("--fit-frames", o.fit_frames,
              "With --weights fitted: frames, evenly spaced over the run, whose light and poses they fit")
      .range(1, 256)
      .group(group);
}

void add_output_options(Command command, RelightOptions& o) {
  const std::string group = "Output";
  command
      .option("-o,--output", o.output, "Folder for frame-0000.png and so on, and for error.svg with --truth")
      .group(group);
  command.option("--pictures", o.pictures, "Draw every so-many-th frame; 0: none")
      .range(0, 1 << 20)
      .group(group);
  command.option("--format", o.format, "Of the frames: png (tone mapped) or exr (linear)")
      .one_of({"png", "exr"})
      .group(group);
  command.option("--camera", o.camera, "Camera by name; default: the scene's first").group(group);
  command.option("--width", o.width, "Pixels").range(1, 16384).group(group);
  command.option("--height", o.height, "Pixels").range(1, 16384).group(group);
  command.option("--spp", o.spp, "Samples per pixel").range(1, 65536).group(group);
  command.option("--exposure", o.exposure, "Of .png frames, in stops").group(group);
  add_probe_file(command, "--save", o.save, "Write the probes of the last frame here").group(group);
}

}  // namespace

void add_relight_command(Command app, Context& context) {
  auto options = std::make_shared<RelightOptions>();
  RelightOptions& o = *options;
  Command command =
      add_command(app, context, "relight", "Move lamps and doors and keep the probes lit, frame by frame",
                  [&context, options] { relight(context, *options); });
  add_scene_options(command, o.scene);
  add_place_options(command, o.place, true);
  add_force_option(command, o.force);
  command.option("--animate", o.animate, animation_help).repeatable();
  command.option("--frames", o.frames, "Frames; their keys go from the first to the last").range(1, 1 << 20);
  command.option("--fps", o.fps, "Frames a second: the curve's time axis, and the time a frame may take")
      .range(0.001, 10000.0);
  add_transport_options(command, o);
  add_truth_options(command, o);
  add_output_options(command, o);
  command.footer("Frames are timed first, one after the other; truth, pictures and --save come after.");
}

}  // namespace ssphh::app
