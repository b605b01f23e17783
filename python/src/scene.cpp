#include <algorithm>

#include <ssphh/core/error.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/transport_scene.h>

#include "arrays.h"
#include "work.h"

namespace ssphh::python {
namespace {

struct Lamp {
  std::string name, group, type;
  vec3 position, direction, color;
  float intensity, radius;
  vec2 size;
};
struct View {
  std::string name;
  vec3 position, direction, up;
  bool orthographic;
  float yfov_degrees;
};

std::vector<Lamp> lamps(const LoadedScene& self) {
  const scene::Scene& scene = self.scene();
  const std::vector<mat4> world = scene::world_matrices(scene, self.time());
  std::vector<Lamp> all;
  for (const scene::Light& light : scene.lights) {
    const mat4& pose = world[light.node];
    all.push_back({light.name, scene::light_group(light), std::string(name_of(light.type)), vec3(pose[3]),
                   -glm::normalize(vec3(pose[2])), light.color, light.intensity, light.radius, light.size});
  }
  return all;
}

std::vector<View> views(const LoadedScene& self) {
  const scene::Scene& scene = self.scene();
  const std::vector<mat4> world = scene::world_matrices(scene, self.time());
  std::vector<View> all;
  for (const scene::Camera& camera : scene.cameras) {
    const mat4& pose = world[camera.node];
    all.push_back({camera.name, vec3(pose[3]), -glm::normalize(vec3(pose[2])), glm::normalize(vec3(pose[1])),
                   camera.orthographic, glm::degrees(camera.yfov)});
  }
  return all;
}

FloatArray bounds(const LoadedScene& self) {
  const scene::Bounds box =
      scene::world_bounds(self.scene(), scene::world_matrices(self.scene(), self.time()));
  if (box.empty()) throw Error(self.source(), "has no surfaces, so there is no box around them");
  return array_of(std::array{box.min, box.max});
}

py::tuple points_on_surfaces(const LoadedScene& self, int count, std::uint64_t seed, float clearance,
                             const py::object& progress) {
  const auto points = run(progress, [&](const Control& control) {
    const trace::TransportScene source(self.geometry(), self.scene());
    const std::vector<vec3> origins = pipeline::viewpoints(self.scene(), source, {}, self.time());
    return study::reachable_points(source, origins, self.time(),
                                   {.count = count, .seed = seed, .clearance = clearance}, control);
  });
  std::vector<vec3> places, normals;
  py::array_t<bool> moves(static_cast<py::ssize_t>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    places.push_back(points[i].position);
    normals.push_back(points[i].normal);
    moves.mutable_data()[i] = points[i].moves;
  }
  return py::make_tuple(array_of(std::move(places)), array_of(std::move(normals)), moves);
}

SceneHandle with_probes(const LoadedScene& self, const py::object& positions_, float radius,
                        const std::vector<std::string>& names) {
  const FloatArray places = positions(positions_, "positions");
  if (!names.empty() && names.size() != static_cast<std::size_t>(places.shape(0)))
    throw Error("names", "must be as many as positions");
  return run(py::none(), [&](const Control&) {
    scene::Scene scene = self.scene();
    scene.sphls.clear();
    for (const vec3& place : rows(places)) {
      const std::size_t i = scene.sphls.size();
      scene::Node& node = scene.nodes.emplace_back();
      node.name = names.empty() ? "probe" + std::to_string(i) : names[i];
      node.local.translation = place;
      scene.sphls.push_back({node.name, static_cast<int>(scene.nodes.size()) - 1, radius});
    }
    scene::validate(scene);
    return std::make_shared<LoadedScene>(std::move(scene), self.source(), self.time());
  });
}

SceneHandle load_scene(const py::object& source, const py::object& overlay, const std::string& unit,
                       const py::object& environment, float environment_intensity, float environment_rotation,
                       bool lambert, bool sun_sky, float sun_elevation, float sun_azimuth, float turbidity,
                       float time, const std::map<std::string, std::string>& light_mode) {
  const auto path = [](const py::object& object) { return object.is_none() ? "" : path_of(object); };
  pipeline::SceneOptions options;
  options.source = path_of(source);
  if (options.source.empty()) throw Error("source", "names no scene", "see builtin_scenes()");
  options.overlay = path(overlay);
  options.unit = unit;
  options.environment = path(environment);
  options.environment_intensity = environment_intensity;
  options.environment_rotation = environment_rotation;
  options.lambert = lambert;
  options.sky.preetham = sun_sky;
  options.sky.elevation = sun_elevation;
  options.sky.azimuth = sun_azimuth;
  options.sky.turbidity = turbidity;
  options.time = time;
  for (const auto& [group, mode] : light_mode) options.light_modes.push_back(group + "=" + mode);
  if (sun_sky && !options.environment.empty())
    throw Error("sun_sky", "takes the place of the environment", "leave out one of them");
  return run(py::none(), [&](const Control&) {
    return std::make_shared<LoadedScene>(pipeline::load_lit_scene(options), options.source, time);
  });
}

std::map<std::string, std::string> builtin_scenes() {
  std::map<std::string, std::string> all;
  for (const scene::BuiltinScene& scene : scene::builtin_scenes())
    all["builtin:" + scene.name] = scene.description;
  return all;
}

std::map<std::string, std::string> light_modes(const LoadedScene& self) {
  const std::vector<std::string> groups = scene::light_groups(self.scene());
  const std::vector<scene::LightMode> modes = scene::light_modes(self.scene());
  std::map<std::string, std::string> all;
  for (std::size_t i = 0; i < groups.size(); ++i) all[groups[i]] = name_of(modes[i]);
  return all;
}

std::string text_of(const LoadedScene& self) {
  const scene::Scene& scene = self.scene();
  return "<ssphh.Scene '" + scene.name + "': " + std::to_string(scene::triangle_count(scene)) +
         " triangles, " + std::to_string(scene::light_groups(scene).size()) + " light groups, " +
         std::to_string(scene.cameras.size()) + " cameras>";
}

}  // namespace

void add_scene(py::module_& m) {
  py::class_<Lamp> light(m, "Light", "A lamp of a scene that is no surface, posed at the scene's time.");
  at_home(light)
      .def_readonly("name", &Lamp::name)
      .def_readonly("group", &Lamp::group, "Light group by which it is dimmed.")
      .def_readonly("type", &Lamp::type, "point, spot, directional, sphere, sphl, rectangle or disc.")
      .def_property_readonly(
          "position", [](const Lamp& l) { return array_of(l.position); }, "World [m].")
      .def_property_readonly("direction", [](const Lamp& l) { return array_of(l.direction); })
      .def_property_readonly("color", [](const Lamp& l) { return array_of(l.color); })
      .def_readonly("intensity", &Lamp::intensity,
                    "Point and spot [W/sr], directional [W/m2], sphere, rectangle and disc [W/sr/m2].")
      .def_readonly("radius", &Lamp::radius, "Of a sphere, an SPHL or a disc [m].")
      .def_property_readonly(
          "size", [](const Lamp& l) { return std::pair(l.size.x, l.size.y); },
          "Width and height of a rectangle [m].")
      .def("__repr__", [](const Lamp& l) { return "<ssphh.Light '" + l.name + "': " + l.type + ">"; });
  py::class_<View> camera(m, "Camera", "A camera of a scene, posed at the scene's time.");
  at_home(camera)
      .def_readonly("name", &View::name)
      .def_property_readonly(
          "position", [](const View& v) { return array_of(v.position); }, "World [m].")
      .def_property_readonly("direction", [](const View& v) { return array_of(v.direction); })
      .def_property_readonly("up", [](const View& v) { return array_of(v.up); })
      .def_readonly("orthographic", &View::orthographic)
      .def_readonly("yfov_degrees", &View::yfov_degrees, "Vertical field of view.")
      .def("__repr__", [](const View& v) { return "<ssphh.Camera '" + v.name + "'>"; });
  py::class_<scene::ProbePlace> sphl(m, "ProbePlace", "A place that a scene names for a probe.");
  at_home(sphl)
      .def_readonly("name", &scene::ProbePlace::name)
      .def_property_readonly(
          "position", [](const scene::ProbePlace& s) { return array_of(s.position); }, "World [m].")
      .def_readonly("radius", &scene::ProbePlace::radius, "[m].")
      .def("__repr__", [](const scene::ProbePlace& s) { return "<ssphh.ProbePlace '" + s.name + "'>"; });

  py::class_<LoadedScene, SceneHandle> scene(m, "Scene", "A scene as load() read it; it never changes.");
  at_home(scene)
      .def_property_readonly("name", [](const LoadedScene& s) { return s.scene().name; })
      .def_property_readonly("source", &LoadedScene::source, "What load() was given.")
      .def_property_readonly("time", &LoadedScene::time, "Pose of what moves [s].")
      .def_property_readonly(
          "duration", [](const LoadedScene& s) { return scene::animation_duration(s.scene()); },
          "Time of the last key of any animation [s].")
      .def_property_readonly("lights", &lamps, "Lamps that are no surfaces.")
      .def_property_readonly(
          "light_groups", [](const LoadedScene& s) { return scene::light_groups(s.scene()); },
          "Names of the groups in which all emitters are, surfaces and sky included.")
      .def_property_readonly("light_modes", &light_modes, "Mode of each light group.")
      .def_property_readonly("cameras", &views)
      .def_property_readonly(
          "probe_places", [](const LoadedScene& s) { return scene::sphl_places(s.scene(), s.time()); },
          "Places that the scene names for probes.")
      .def_property_readonly("bounds", &bounds, "Lowest and highest corner of all surfaces, 2x3 [m].")
      .def_property_readonly("triangle_count",
                             [](const LoadedScene& s) { return scene::triangle_count(s.scene()); })
      .def_property_readonly(
          "ignored", [](const LoadedScene& s) { return s.scene().ignored; },
          "What the file holds and nobody uses.")
      .def(
          "surface_points", &points_on_surfaces,
          "Points uniform by area over what cameras, lamps and probes can reach: positions Nx3, unit normals "
          "Nx3, and whether each stands on a moving part, N.",
          "count"_a = 1024, py::kw_only(), "seed"_a = 0, "clearance"_a = 0.0f, "progress"_a = py::none())
      .def("with_probes", &with_probes,
           "The same scene with these places for probes, Nx3 [m], instead of its own.", "positions"_a,
           py::kw_only(), py::arg_v("radius", 0.1f, "0.1"), "names"_a = std::vector<std::string>())
      .def("__repr__", &text_of);
  m.def("load", &load_scene, "Reads a scene: a file, an overlay or builtin:NAME.", "source"_a, py::kw_only(),
        "overlay"_a = py::none(), "unit"_a = "", "environment"_a = py::none(),
        "environment_intensity"_a = 1.0f, "environment_rotation"_a = 0.0f, "lambert"_a = false,
        "sun_sky"_a = false, "sun_elevation"_a = 45.0f, "sun_azimuth"_a = 120.0f, "turbidity"_a = 3.0f,
        "time"_a = 0.0f, "light_mode"_a = std::map<std::string, std::string>());
  m.def("builtin_scenes", &builtin_scenes, "Every built-in scene and what it is.");
}

}  // namespace ssphh::python
