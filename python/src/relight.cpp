#include <algorithm>
#include <atomic>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/pipeline/places.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/turn_surroundings.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/session_sets.h>

#include "arrays.h"
#include "picture.h"
#include "probes_argument.h"
#include "surface_light.h"
#include "work.h"

namespace ssphh::python {
namespace {

using probes::ProbeSet;
using scene::ProbePlace;

/// Held while a session is at work: the GIL is free then, and its other methods must wait for a better time.
class AtWork {
 public:
  explicit AtWork(std::atomic<bool>& busy) : busy_(busy) {
    if (busy_.exchange(true))
      throw Error("relight session", "is at work, in another thread or below its own progress",
                  "wait until it is done, or make one for each thread");
  }
  ~AtWork() { busy_ = false; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  std::atomic<bool>& busy_;
};

struct LightChange {
  std::optional<vec3> position, direction, color;
  std::optional<float> intensity;
};

std::size_t index_of(const std::string& kind, const std::string& name,
                     const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw Error(kind + " " + name, "the scene has none of this name",
              names.empty() ? "" : fmt::format("it has: {}", fmt::join(names, ", ")));
}

/// Probes that follow lamps and doors: transport::RelightSession with the changes that were asked for, and
/// lookups of its light.
class Session {
 public:
  Session(SceneHandle scene, const py::object& probes, const std::string& op, int degree, int records,
          std::optional<int> directions, std::optional<float> surfel_size, std::optional<int> link_rays,
          bool warm_start, const py::object& progress)
      : scene_(std::move(scene)), time_(scene_->time()) {
    params_.op = enum_named<probes::LightOperator>("operator", op);
    params_.degree = degree;
    params_.warm_start = warm_start;
    params_.records.points = records;
    if (directions) params_.transport.directions = *directions;
    if (surfel_size) params_.transport.surfel_size = *surfel_size;
    if (link_rays) params_.transport.link_rays = *link_rays;
    std::vector<ProbePlace> places;
    std::string words;
    if (py::isinstance<ProbeSet>(probes)) {
      places = scene::places_of(probes.cast<const ProbeSet&>().probes);
    } else {
      words = places_in_words(probes);
    }
    do_work(progress, [&](const Control& control) {
      source_.emplace(scene_->geometry(), scene_->scene());
      if (places.empty()) places = find_places(words, control);
      if (places.empty()) throw Error("probes", "there are none", "let auto find places");
      session_.emplace(*source_, std::move(places), params_, time_, control);
    });
  }

  float time() const { return time_; }
  void set_time(float time) { time_ = time; }
  float environment_rotation() const { return turn_degrees_; }
  void set_environment_rotation(float degrees) { turn_degrees_ = degrees; }

  void set_light(const std::string& name, const py::object& position, const py::object& direction,
                 const py::object& color, std::optional<float> intensity) {
    LightChange& change = changes_[index_of("light", name, source_->light_names())];
    if (!position.is_none()) change.position = vector_of(position, "position");
    if (!direction.is_none()) {
      const vec3 along = vector_of(direction, "direction");
      if (!(glm::length(along) > 0)) throw Error("direction", "has no length");
      change.direction = along;
    }
    if (!color.is_none()) change.color = color_of(color, "color");
    if (intensity) change.intensity = *intensity;
  }
  void set_group(const std::string& name, const py::object& scale) {
    scales_[index_of("light group", name, source_->light_groups())] = color_of(scale, "scale");
  }

  py::dict update(const py::object& progress) {
    const AtWork work(busy_);
    const scene::LightingState state = wanted();
    light_.reset();
    const transport::RelightReport r =
        run(progress, [&](const Control& control) { return session_->update(state, control); });
    return py::dict("milliseconds"_a = r.total_ms(), "iterations"_a = r.solve.iterations,
                    "converged"_a = r.solve.converged, "rays"_a = r.pose_rays + r.direct_rays,
                    "changed_probes"_a = std::vector<int>(r.changed_probes.begin(), r.changed_probes.end()));
  }

  FloatArray positions() const {
    std::vector<vec3> all;
    for (const ProbePlace& place : session_->places()) all.push_back(place.position);
    return array_of(std::move(all));
  }
  FloatArray reflected() const {
    const AtWork work(busy_);
    require_light();
    return array_of_functions(
        session_->reflected(), params_.degree, [](const auto& f) -> const auto& { return f; });
  }

  FloatArray irradiance(const py::object& points, const py::object& normals, const py::object& moves,
                        const py::object& progress) {
    const AtWork work(busy_);
    const std::vector<rays::SurfacePoint> at = surface_points(points, normals, moves);
    return irradiance_of(light().lookup, at, progress);
  }

  FloatArray render(const std::string& camera, int width, int height, int max_depth, int spp,
                    std::uint64_t seed, const py::object& progress) {
    const AtWork work(busy_);
    Light& light = this->light();
    return array_of(run(progress, [&](const Control& control) {
      trace::RenderParams params;
      params.width = width;
      params.height = height;
      params.camera = pipeline::camera_of(light.scene, camera, session_->lighting().time, scene_->geometry());
      params.projection = pipeline::projection_of(pipeline::PictureProjection::camera, params.camera.camera);
      params.path = {max_depth, 1, spp, seed};
      require_picture(params);
      trace::RenderState state;
      light.tracer.render_with(light.lookup, params, state, control);
      return trace::resolve(state.color, state.passes_done);
    }));
  }

  /// What there is to see, path traced: the truth.
  py::tuple trace_irradiance(const py::object& points, const py::object& normals, int spp, int max_depth,
                             std::uint64_t seed, const py::object& progress) {
    const AtWork work(busy_);
    const std::vector<rays::SurfacePoint> at = surface_points(points, normals, py::none());
    Light& light = this->light();
    return traced_at(progress, [&](const Control& control) {
      return light.tracer.surface_irradiance(at, {max_depth, 1, spp, seed}, control);
    });
  }

  /// The light as a bake stores it.
  std::shared_ptr<ProbeSet> probe_set(const py::object& progress) const {
    const AtWork work(busy_);
    require_light();
    return run(progress, [&](const Control& control) {
      return std::make_shared<ProbeSet>(
          pipeline::baked_session(*session_, scene_->scene(), source_->light_groups(), params_.op, control));
    });
  }

 private:
  /// The scene as it is lit now, and lookups in it.
  struct Light {
    Light(const Session& self, scene::Scene lit)
        : scene(std::move(lit)),
          tracer(self.scene_->geometry(), scene, self.session_->lighting().time),
          set(transport::lookup_set(*self.session_)),
          lookup(set, tracer) {}
    scene::Scene scene;
    trace::PathTracer tracer;
    ProbeSet set;
    probes::IrradianceLookup lookup;
  };

  std::vector<ProbePlace> find_places(const std::string& words, const Control& control) const {
    const auto placed =
        pipeline::place_for(scene_->geometry(), scene_->scene(), time_, {.probes = words}, "", control);
    return placed ? scene::places_of(placed->placement.probes) : scene::sphl_places(scene_->scene(), time_);
  }

  scene::LightingState wanted() const {
    scene::LightingState state = rays::lighting_at(*source_, time_);
    scene::turn_surroundings(state, scene_->scene(), glm::radians(turn_degrees_));
    for (const auto& [group, scale] : scales_) state.group_scales[group] = scale;
    for (const auto& [index, change] : changes_) {
      scene::LightState& light = state.lights[index];
      if (change.position) light.world[3] = vec4(*change.position, 1);
      if (change.direction)
        light.world = pipeline::aimed(scene_->scene().lights[index].type, light.world, *change.direction);
      if (change.color) light.color = *change.color;
      if (change.intensity) light.intensity = *change.intensity;
    }
    return state;
  }

  void require_light() const {
    if (session_->reflected().empty())
      throw Error("relight session", "has no light yet", "call update() first");
  }

  Light& light() {
    require_light();
    if (!light_)
      do_work(py::none(), [&](const Control&) {
        light_ = std::make_unique<Light>(*this, scene::with_lighting(scene_->scene(), session_->lighting()));
      });
    return *light_;
  }

  mutable std::atomic<bool> busy_ = false;
  SceneHandle scene_;
  float time_, turn_degrees_ = 0;
  transport::RelightParams params_;
  std::optional<trace::TransportScene> source_;
  std::optional<transport::RelightSession> session_;
  std::map<std::size_t, LightChange> changes_;
  std::map<std::size_t, vec3> scales_;
  std::unique_ptr<Light> light_;  ///< of the last update; none: not asked for yet
};

}  // namespace

void add_relight(py::module_& m) {
  const py::none none;
  py::class_<Session> type(m, "RelightSession", "Probes that follow lamps and doors, update by update.");
  at_home(type)
      .def(py::init<SceneHandle, const py::object&, const std::string&, int, int, std::optional<int>,
                    std::optional<float>, std::optional<int>, bool, const py::object&>(),
           "scene"_a, "probes"_a = none, py::kw_only(), "operator"_a = name_of(probes::LightOperator::surfel),
           "degree"_a = 4, "records"_a = transport::usual_records, "directions"_a = none,
           "surfel_size"_a = none, "link_rays"_a = none, "warm_start"_a = true, "progress"_a = none)
      .def_property("time", &Session::time, &Session::set_time, "Pose of doors and whatever moves [s].")
      .def_property("environment_rotation", &Session::environment_rotation,
                    &Session::set_environment_rotation,
                    "Turn of sky and sun about +y beyond the scene's own [degrees].")
      .def("set_light", &Session::set_light, "Moves, turns, colours or dims a lamp; what is None stays.",
           "name"_a, py::kw_only(), "position"_a = none, "direction"_a = none, "color"_a = none,
           "intensity"_a = none)
      .def("set_group", &Session::set_group, "Factor on all light of a group: a number or three.", "name"_a,
           "scale"_a)
      .def("update", &Session::update, "Brings the probes up to date; returns what that took.",
           "progress"_a = none)
      .def_property_readonly("positions", &Session::positions, "Of the probes, Nx3 [m].")
      .def_property_readonly("reflected", &Session::reflected, "Light of the last update, NxKx3.")
      .def("irradiance", &Session::irradiance, "Indirect irradiance [W/m2] at surface points: Nx3.",
           "points"_a, "normals"_a, "moves"_a = none, py::kw_only(), "progress"_a = none)
      .def("trace_irradiance", &Session::trace_irradiance,
           "Direct and indirect irradiance [W/m2] by path tracing, Nx3 each: the truth for irradiance().",
           "points"_a, "normals"_a, py::kw_only(), "spp"_a = 512, "max_depth"_a = rays::usual_max_depth,
           "seed"_a = 0, "progress"_a = none)
      .def("render", &Session::render, "A picture of the last update: radiance, height x width x 3.",
           py::kw_only(), "camera"_a = "", "width"_a = 640, "height"_a = 360,
           "max_depth"_a = rays::usual_max_depth, "spp"_a = 8, "seed"_a = 0, "progress"_a = none)
      .def("probe_set", &Session::probe_set, "The light of the last update as a bake would store it.",
           "progress"_a = none);
}

}  // namespace ssphh::python
