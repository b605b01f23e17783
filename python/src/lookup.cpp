#include <ssphh/core/parallel.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>

#include "arrays.h"
#include "surface_light.h"
#include "work.h"

namespace ssphh::python {
namespace {

using probes::ProbeSet;

/// Light looked up from probes in a scene that stands still.
class Lookup {
 public:
  Lookup(SceneHandle scene, const ProbeSet& set, const std::string& lookup,
         const std::optional<std::string>& weights, const std::string& light, bool force)
      : scene_(std::move(scene)), set_(set) {
    spec_.method = enum_named<probes::LookupMethod>("lookup", lookup);
    if (weights) spec_.weights = enum_named<probes::WeightMethod>("weights", *weights);
    spec_.layer = enum_named<probes::ProbeLayer>("light", light);
    do_work(py::none(), [&](const Control&) {
      pipeline::require_same_scene("probes", set_, scene_->scene(), scene::light_groups(scene_->scene()),
                                   scene_->time(), force);
      tracer_.emplace(scene_->geometry(), scene_->scene(), scene_->time());
      light_ = lookup_of(set_);
    });
  }

  FloatArray irradiance(const py::object& points, const py::object& normals, const py::object& moves,
                        const py::object& progress) const {
    return irradiance_of(*light_, surface_points(points, normals, moves), progress);
  }

  /// Of each light group alone, times its factor.
  py::dict irradiance_by_group(const py::object& points, const py::object& normals, const py::object& moves,
                               const py::object& progress) const {
    if (set_.hierarchy)
      throw Error("irradiance_by_group", "the probes hold light of HIER, which is not told apart by groups",
                  "look them up before hier()");
    const std::vector<rays::SurfacePoint> at = surface_points(points, normals, moves);
    py::dict all;
    for (std::size_t g = 0; g < set_.light_groups.size(); ++g) {
      const auto light = run(py::none(), [&](const Control&) {
        ProbeSet alone = set_;
        for (std::size_t other = 0; other < set_.light_groups.size(); ++other)
          if (other != g) alone.light_groups[other].scale = vec3(0);
        probes::merge_groups(alone);
        return lookup_of(alone);
      });
      all[py::str(set_.light_groups[g].name)] = irradiance_of(*light, at, progress);
    }
    return all;
  }

  std::vector<std::string> direct_groups() const { return light_->direct_groups(); }

 private:
  std::unique_ptr<rays::IndirectLight> lookup_of(const ProbeSet& set) const {
    return probes::make_lookup(spec_.method, set, *tracer_, pipeline::lookup_params("probes", set, spec_));
  }

  SceneHandle scene_;
  ProbeSet set_;
  probes::LookupSpec spec_;
  std::optional<trace::PathTracer> tracer_;
  std::unique_ptr<rays::IndirectLight> light_;
};

py::tuple traced_irradiance(const LoadedScene& scene, const py::object& points, const py::object& normals,
                            int spp, int passes, int max_depth, std::uint64_t seed,
                            const py::object& progress) {
  const std::vector<rays::SurfacePoint> at = surface_points(points, normals, py::none());
  return traced_at(progress, [&](const Control& control) {
    const trace::PathTracer tracer(scene.geometry(), scene.scene(), scene.time());
    return tracer.surface_irradiance(at, {max_depth, passes, spp, seed}, control);
  });
}

}  // namespace

FloatArray irradiance_of(const rays::IndirectLight& light, const std::vector<rays::SurfacePoint>& points,
                         const py::object& progress) {
  return array_of(run(progress, [&](const Control& control) {
    std::vector<vec3> found(points.size());
    ProgressStage stage(control, "looking up", points.size(), "points");
    parallel_for(
        points.size(), 64,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) found[i] = light.irradiance(points[i]);
          stage.advance(end - begin);
        },
        control);
    return found;
  }));
}

py::tuple traced_at(const py::object& progress,
                    const std::function<std::vector<rays::IrradianceEstimate>(const Control&)>& trace) {
  std::vector<vec3> direct, indirect;
  for (const rays::IrradianceEstimate& e : run(progress, trace)) {
    direct.push_back(e.direct);
    indirect.push_back(e.indirect);
  }
  return py::make_tuple(array_of(std::move(direct)), array_of(std::move(indirect)));
}

void add_lookup(py::module_& m) {
  const py::none none;
  py::class_<Lookup> type(m, "Lookup", "Indirect light of surfaces, looked up from probes.");
  at_home(type)
      .def(py::init<SceneHandle, const ProbeSet&, const std::string&, const std::optional<std::string>&,
                    const std::string&, bool>(),
           "scene"_a, "probes"_a, py::kw_only(), "lookup"_a = name_of(probes::LookupSpec{}.method),
           "weights"_a = none, "light"_a = name_of(probes::LookupSpec{}.layer), "force"_a = false)
      .def("irradiance", &Lookup::irradiance,
           "Irradiance [W/m2] at points Nx3 of surfaces with normals Nx3: Nx3.", "points"_a, "normals"_a,
           "moves"_a = none, py::kw_only(), "progress"_a = none)
      .def("irradiance_by_group", &Lookup::irradiance_by_group,
           "The same of each light group alone, by name.", "points"_a, "normals"_a, "moves"_a = none,
           py::kw_only(), "progress"_a = none)
      .def_property_readonly("direct_groups", &Lookup::direct_groups,
                             "Light groups whose direct light is in it, too.");
  m.def("trace_irradiance", &traced_irradiance,
        "Direct and indirect irradiance [W/m2] at surface points by path tracing, Nx3 each.", "scene"_a,
        "points"_a, "normals"_a, py::kw_only(), "spp"_a = 512, "passes"_a = 1,
        "max_depth"_a = rays::usual_max_depth, "seed"_a = 0, "progress"_a = none);
}

}  // namespace ssphh::python
