#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/probes/blend.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/study/lint.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/session_sets.h>

#include "commands/relight.h"
#include "commands/relight_animation.h"
#include "options/picture_options.h"
#include "options/probe_options.h"
#include "results/geometry_builds.h"
#include "results/pictures.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

/// Warns of places inside bodies, and of those that a moving part passes if parts are to move.
void warn_about_places(const std::vector<scene::ProbePlace>& places, const rays::TransportSource& source,
                       const std::vector<vec3>& interest, bool parts_move, const Control& control) {
  probes::ProbeSet set;
  for (const scene::ProbePlace& place : places) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = place.name;
    probe.position = place.position;
    probe.radius = place.radius;
  }
  study::LintParams params;
  params.interest = interest;
  for (const study::LintProblem& problem : study::lint_places(set, source, params, control)) {
    const bool swept = problem.kind == study::ProbeProblem::swept;
    if (problem.kind != study::ProbeProblem::inside && !(swept && parts_move)) continue;
    log_warning("probe \"{}\" {}", set.probes[problem.probe].name, problem.message);
  }
}

/// Warns of probes that see nothing, and of a network in which no surface sees another.
void warn_about_network(const transport::RelightSession& session) {
  const transport::TransportNetwork& network = session.network();
  const auto directions = static_cast<std::ptrdiff_t>(network.gbuffer().directions.size());
  for (std::size_t i = 0; i < session.places().size(); ++i) {
    const auto begin = network.seen().begin() + static_cast<std::ptrdiff_t>(i) * directions;
    if (std::all_of(begin, begin + directions, [](const auto& patch) { return patch.index < 0; }))
      log_warning("probe \"{}\" sees no surface: it holds no light", session.places()[i].name);
  }
  if (network.links().link_count() == 0)
    log_warning("no surface sees another: there is no light from surface to surface, only to the probes");
}

/// "door-3.sphl" of door.sphl: the file of a key.
std::string key_file(const std::string& name, int key) {
  const std::size_t ending = name.rfind(".sphl");
  return fmt::format("{}-{}{}", name.substr(0, ending), key, name.substr(ending));
}

/// A frame whose light is kept for what comes after the timed run.
struct KeptFrame {
  int frame;
  scene::LightingState state;
  probes::ProbeSet light;
};

class Relighting {
 public:
  Relighting(const RelightOptions& options, const Control& control)
      : control_(control),
        o_(options),
        moves_(options.animate),
        scene_(load_lit_scene(at_start_of_day(options.scene, moves_))),
        geometry_(std::make_shared<const trace::SceneGeometry>(scene_)),
        source_(geometry_, scene_),
        animation_(source_, scene_, options.scene.time, moves_),
        exposure_(options.exposure),
        farm_(farm_session(options.farm)) {
    if (farm_) drawn_by_.emplace();
  }

  RelightResult run() {
    run_.frames_asked = o_.frames;
    run_.fps = o_.fps;
    if (!o_.output.empty() && o_.pictures > 0)  // Fails before the work rather than after it.
      start_ = camera_of(scene_, o_.camera, o_.scene.time, geometry_);
    pipeline::warn_about_lamps(geometry_, scene_, o_.scene.time);
    std::vector<scene::ProbePlace> places = find_places();
    warn_about_places(places, source_, place::place_params(scene_, o_.scene.time).interest,
                      animation_.moves_time(), control_);
    const Stopwatch watch;
    transport::RelightParams params = o_.params;
    if (o_.weights == probes::WeightMethod::surface &&
        (o_.truth > 0 || o_.key_frames > 0 || !o_.output.empty() || !o_.save.empty()))
      params.records.points = transport::usual_records;
    transport::RelightSession session(source_, std::move(places), params, animation_.frame(0).time, control_);
    run_.build_ms = 1e3 * watch.seconds();
    warn_about_network(session);
    try {
      if (o_.key_frames > 0) find_keys(session);
      play(session);
      if (o_.key_frames > 0) compare_keys(session);
      if (!o_.save.empty() && o_.key_frames == 0) save(session, o_.save);
      look_back(session);
    } catch (const Cancelled&) {
      if (run_.updates.empty()) throw;
      run_.cancelled = true;
      log(LogLevel::error, "cancelled");
    }
    if (!o_.output.empty() && !run_.errors.empty())
      write_error_curve(fs::path(o_.output) / "error.svg", run_);
    const transport::TransportNetwork& network = session.network();
    return {std::move(run_),
            session.places(),
            network.surfel_count(),
            network.links().link_count(),
            network.params().surfel_size,
            shown_at_,
            saved_,
            builds_.count(),
            drawn_by_};
  }

 private:
  std::vector<scene::ProbePlace> find_places() {
    std::vector<scene::ProbePlace> places;
    if (is_probe_file(o_.place)) {
      places = scene::places_of(read_probes_of(scene_, o_.place.probes, {}, o_.force).probes);
    } else if (const auto placed = place_for(geometry_, scene_, o_.scene.time, o_.place, "", control_)) {
      places = scene::places_of(placed->placement.probes);
    } else {
      places = scene::sphl_places(scene_, o_.scene.time);
    }
    if (places.empty()) throw Error("--probes", "there are no probes", "let --probes auto find places");
    return places;
  }

  static bool is_due(int frame, int every) { return every > 0 && frame % every == 0; }
  float share(int frame) const {
    return o_.frames > 1 ? static_cast<float>(frame) / static_cast<float>(o_.frames - 1) : 0;
  }

  /// All frames one after the other, with nothing in between that would disturb their times.
  void play(transport::RelightSession& session) {
    ProgressStage progress(control_, "relighting", static_cast<std::uint64_t>(o_.frames), "frames");
    for (int f = 0; f < o_.frames; ++f) {
      control_.check();
      scene::LightingState state = animation_.frame(share(f));
      run_.updates.push_back(session.update(state));
      if (is_due(f, o_.truth) || (!o_.output.empty() && is_due(f, o_.pictures)))
        kept_.push_back(
            {f, std::move(state),
             keys_.empty() ? transport::lookup_set(session) : probes::light_at(keys_, share(f)).set});
      progress.advance(1);
    }
  }

  /// The light of so many moments, evenly spaced over the run.
  void find_keys(transport::RelightSession& session) {
    const Stopwatch watch;
    for (int k = 0; k < o_.key_frames; ++k) {
      const float u = static_cast<float>(k) / static_cast<float>(o_.key_frames - 1);
      session.update(animation_.frame(u), control_);
      keys_.push_back({u, transport::lookup_set(session)});
      if (!o_.save.empty()) save(session, key_file(o_.save, k));
    }
    run_.keyed.keys = o_.key_frames;
    run_.keyed.find_ms = 1e3 * watch.seconds();
  }

  /// Blended light against that of the frame itself, at the same points.
  void compare_keys(transport::RelightSession& session) {
    ProgressStage progress(control_, "comparing blended light", static_cast<std::uint64_t>(o_.frames),
                           "frames");
    const Control quiet{nullptr, control_.cancel};
    for (int f = 0; f < o_.frames; ++f) {
      const scene::LightingState state = animation_.frame(share(f));
      session.update(state, quiet);
      const Stopwatch watch;
      const probes::ProbeSet blended = probes::light_at(keys_, share(f)).set;
      run_.keyed.blend_ms.push_back(1e3 * watch.seconds());
      const scene::Scene lit = scene::with_lighting(scene_, state);
      const trace::PathTracer tracer(geometry_, lit, state.time);
      const std::vector<rays::SurfacePoint> points = points_of(session, state.time, quiet);
      std::vector<rays::IrradianceEstimate> exact;
      for (const vec3& e : look_up(transport::lookup_set(session), tracer, points))
        exact.push_back({.indirect = e});
      run_.keyed.errors.push_back({f, study::lookup_error(look_up(blended, tracer, points), exact)});
      progress.advance(1);
    }
  }

  std::vector<vec3> look_up(const probes::ProbeSet& light, const trace::PathTracer& tracer,
                            const std::vector<rays::SurfacePoint>& points) const {
    probes::LookupParams params;
    params.weights.method = o_.weights;
    const probes::IrradianceLookup lookup(light, tracer, params);
    std::vector<vec3> found;
    for (const rays::SurfacePoint& point : points) found.push_back(lookup.irradiance(point));
    return found;
  }

  /// Of surfaces that cameras and probes can reach.
  std::vector<rays::SurfacePoint> points_of(const transport::RelightSession& session, float time,
                                            const Control& control) const {
    std::vector<vec3> origins;
    const std::vector<mat4> world = scene::world_matrices(scene_, time);
    for (const scene::Camera& camera : scene_.cameras) origins.emplace_back(world[camera.node][3]);
    for (const scene::ProbePlace& place : session.places()) origins.push_back(place.position);
    return study::reachable_points(source_, origins, time, {o_.points, o_.seed}, control);
  }

  void save(const transport::RelightSession& session, const std::string& file) {
    probes::write_probe_file(
        pipeline::baked_session(session, scene_, source_.light_groups(), o_.params.op, control_), file);
    saved_ = true;
  }

  /// Truth and pictures of the frames kept.
  void look_back(transport::RelightSession& session) {
    if (kept_.empty()) return;
    ProgressStage progress(control_, o_.truth > 0 ? "path tracing the truth" : "pictures", kept_.size(),
                           "frames");
    const Control quiet{nullptr, control_.cancel};
    probes::LookupParams params;
    params.weights.method = o_.weights;
    std::optional<probes::FittedPoints> fitted;
    if (params.weights.method == probes::WeightMethod::fitted) fitted = fit(session, quiet);
    for (KeptFrame& kept : kept_) {
      const scene::Scene lit = scene::with_lighting(scene_, kept.state);
      const trace::PathTracer tracer(geometry_, lit, kept.state.time);
      kept.light.fitted = fitted;
      const probes::IrradianceLookup lookup(kept.light, tracer, params);
      if (is_due(kept.frame, o_.truth)) measure(session, kept, tracer, lookup, quiet);
      if (!o_.output.empty() && is_due(kept.frame, o_.pictures)) draw(kept, lit, tracer, lookup, quiet);
      progress.advance(1);
    }
  }

  /// Weights that serve the whole run: fitted at once to frames evenly spaced over it.
  probes::FittedPoints fit(transport::RelightSession& session, const Control& control) {
    transport::WeightFit fit(transport::surfel_points(session.network()));
    const int count = std::min(o_.fit_frames, o_.frames);
    for (int k = 0; k < count; ++k) {
      session.update(animation_.frame(count > 1 ? static_cast<float>(k) / static_cast<float>(count - 1) : 0),
                     control);
      fit.add_pose(session.network(), source_, session.direct_by_group(), control);
    }
    return fit.solve(control);
  }

  void measure(const transport::RelightSession& session, const KeptFrame& kept,
               const trace::PathTracer& tracer, const rays::IndirectLight& lookup, const Control& control) {
    const std::vector<rays::SurfacePoint> points = points_of(session, kept.state.time, control);

    std::vector<vec3> looked_up;
    for (const rays::SurfacePoint& point : points) looked_up.push_back(lookup.irradiance(point));
    const auto truth = tracer.surface_irradiance(
        points, {.max_depth = o_.max_depth, .passes = 1, .spp = o_.truth_spp, .seed = o_.seed}, control);
    run_.errors.push_back({kept.frame, study::lookup_error(looked_up, truth)});
  }

  void draw(const KeptFrame& kept, const scene::Scene& lit, const trace::PathTracer& tracer,
            const rays::IndirectLight& lookup, const Control& control) {
    trace::RenderParams params;
    params.width = o_.width;
    params.height = o_.height;
    params.camera = scene_.cameras.empty() ? start_ : scene::camera_pose(lit, o_.camera, kept.state.time);
    params.projection = projection_of(PictureProjection::camera, params.camera.camera);
    params.path = {.max_depth = rays::usual_max_depth, .passes = 1, .spp = o_.spp, .seed = o_.seed};
    trace::RenderState state;
    if (farm_) {
      const farm::RenderProbes probes{&kept.light, {.weights = o_.weights}};
      state = farm::render(farm_->options(), lit, kept.state.time, params, probes,
                           {trace::RenderLayer::color}, *drawn_by_, control);
    } else {
      tracer.render_with(lookup, params, state, control);
    }
    const image::Image picture = trace::resolve(state.color, state.passes_done);
    const fs::path path = fs::path(o_.output) / fmt::format("frame-{:04}.{}", kept.frame, name_of(o_.format));
    if (is_display_format(path)) shown_at_ = exposure_.of(picture);
    write_picture(path, picture, {.exposure = shown_at_.value_or(0)});
  }

  const Control& control_;
  const RelightOptions& o_;
  GeometryBuilds builds_;
  std::vector<std::string> moves_;  ///< --animate, and a day that --time-of-day tells of
  scene::Scene scene_;
  trace::SharedGeometry geometry_;
  trace::TransportScene source_;
  RelightAnimation animation_;
  RelightRun run_;
  scene::CameraPose start_;  ///< where pictures are taken from a camera that the scene lacks
  std::vector<KeptFrame> kept_;
  std::vector<probes::KeyedSet> keys_;  ///< by share of the run
  SharedExposure exposure_;
  std::optional<float> shown_at_;  ///< EV of the frames that were written
  bool saved_ = false;
  std::optional<FarmSession> farm_;
  std::optional<farm::FarmReport> drawn_by_;
};

}  // namespace

RelightResult run_relight(const RelightOptions& options, const Control& control) {
  if (options.frames < 1) throw Error("relight", "needs a frame");
  if (options.params.op == probes::LightOperator::bounce && options.params.poses != 0)
    throw Error("--poses", "is of --operator surfel");
  if (options.key_frames == 1) throw Error("--key-frames", "one key is no motion", "give 2 or more");
  if (options.key_frames > 0 && options.weights == probes::WeightMethod::fitted)
    throw Error("--key-frames", "blends light, not fitted weights", "choose other --weights");
  if (options.farm.any() && (options.output.empty() || options.pictures == 0))
    throw Error("--broker, --local", "a farm draws the pictures of relight, and none are asked for",
                "give a folder with -o, or leave them out");
  if (!options.output.empty()) {
    std::error_code error;
    fs::create_directories(options.output, error);
    if (!fs::is_directory(options.output))
      throw Error(options.output, "cannot make this folder for the frames");
  }
  return Relighting(options, control).run();
}

bool has_failed(const RelightResult& result, const RelightOptions&) {
  return result.run.cancelled;
}

json::Value to_json(const RelightResult& result, const RelightOptions& options) {
  json::Value object = relight_json(result.run);
  object["operator"] = name_of(options.params.op);
  object["weights"] = name_of(options.weights);
  object["probes"] = result.places.size();
  object["surfels"] = result.surfels;
  object["surfel_size"] = result.surfel_size;
  object["links"] = result.links;
  object["geometry_builds"] = result.geometry_builds;
  if (result.exposure) object["exposure"] = *result.exposure;
  if (result.saved) object["saved"] = options.save;
  if (result.farm) object["farm"] = farm_json(*result.farm);
  return object;
}

std::string to_text(const RelightResult& result, const RelightOptions&) {
  std::string text = fmt::format("{}, {} of {:.3g} m, {}\n{}", counted(result.places.size(), "probe"),
                                 counted(result.surfels, "surfel"), result.surfel_size,
                                 counted(result.links, "link"), relight_text(result.run));
  if (result.exposure) text += "\nframes at " + exposure_text(*result.exposure);
  if (result.farm) text += "\n" + farm_text(*result.farm);
  return text;
}

}  // namespace ssphh::app
