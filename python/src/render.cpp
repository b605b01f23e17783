#include <map>
#include <variant>

#include <fmt/format.h>

#include <ssphh/methods/method_list.h>
#include <ssphh/pipeline/scene_probes.h>

#include "arrays.h"
#include "picture.h"
#include "work.h"

namespace ssphh::python {
namespace {

using Parameters = std::map<std::string, std::variant<double, std::string>>;

std::vector<std::string> settings_of(const Parameters& parameters) {
  std::vector<std::string> all;
  for (const auto& [name, value] : parameters)
    all.push_back(std::visit([&](const auto& v) { return fmt::format("{}={}", name, v); }, value));
  return all;
}

trace::RenderState rendered(const LoadedScene& scene, const std::string& method, const probes::ProbeSet* set,
                            const Parameters& param, const std::string& camera, int width, int height,
                            const std::string& projection, const py::object& at, int max_depth, int passes,
                            int spp, std::uint64_t seed, const std::string& lookup,
                            const std::optional<std::string>& weights, const std::string& light, bool force,
                            bool per_group, const py::object& progress) {
  // Its own copy: another thread may dim the lamps of the caller's.
  const std::optional<probes::ProbeSet> own = set ? std::optional(*set) : std::nullopt;
  pipeline::LightFinder finder{method, settings_of(param), own ? &*own : nullptr, "probes"};
  finder.lookup.method = enum_named<probes::LookupMethod>("lookup", lookup);
  if (weights) finder.lookup.weights = enum_named<probes::WeightMethod>("weights", *weights);
  finder.lookup.layer = enum_named<probes::ProbeLayer>("light", light);
  if (method != "path") methods::find_method(method);
  pipeline::check_method(method, !param.empty(), set != nullptr);
  const auto projected = enum_named<pipeline::PictureProjection>("projection", projection);
  trace::RenderParams params;
  params.width = width;
  params.height = height;
  params.path = {max_depth, passes, spp, seed};
  params.per_group = per_group;
  require_picture(params);
  const std::optional<vec3> place = at.is_none() ? std::nullopt : std::optional(vector_of(at, "at"));
  if (place && projected == pipeline::PictureProjection::camera)
    throw Error("at", "is the place of a picture of the whole sphere", "add projection='cube' or 'equirect'");
  return run(progress, [&](const Control& control) {
    if (own)
      pipeline::require_same_scene("probes", *own, scene.scene(), scene::light_groups(scene.scene()),
                                   scene.time(), force);
    params.camera = pipeline::camera_of(scene.scene(), camera, scene.time(), scene.geometry());
    params.projection = pipeline::projection_of(projected, params.camera.camera);
    if (place) {
      params.camera.world = mat4(1);
      params.camera.world[3] = vec4(*place, 1);
    }
    trace::RenderState state;
    pipeline::render_scene(scene.geometry(), scene.scene(), scene.time(), finder, params, state, control);
    return state;
  });
}

py::dict layers(const LoadedScene& scene, trace::RenderState state) {
  py::dict all;
  const auto add = [&](const std::string& name, const image::Image& sum) {
    all[py::str(name)] = array_of(trace::resolve(sum, state.passes_done));
  };
  const std::vector<std::string> groups = scene::light_groups(scene.scene());
  for (const trace::RenderLayer layer : trace::render_layers()) {
    if (layer == trace::RenderLayer::coverage) continue;
    const std::span<const image::Image> images = trace::images_of(state, layer);
    for (std::size_t i = 0; i < images.size(); ++i)
      add(layer == trace::RenderLayer::groups ? "group " + groups[i] : std::string(name_of(layer)),
          images[i]);
  }
  return all;
}

py::dict methods_and_parameters() {
  py::dict all;
  all["path"] = py::dict("about"_a = "path tracing, the ground truth", "parameters"_a = py::dict());
  for (const methods::MethodEntry& entry : methods::all_methods()) {
    py::dict parameters;
    for (const methods::MethodParameter& p : entry.parameters)
      parameters[p.name] =
          py::dict("default"_a = p.choices.empty() ? py::object(py::float_(p.value))
                                                   : py::object(py::str(p.choices[p.value])),
                   "least"_a = p.least, "most"_a = p.most, "choices"_a = p.choices, "about"_a = p.about);
    all[entry.name] = py::dict("about"_a = entry.about, "parameters"_a = parameters);
  }
  return all;
}

}  // namespace

void require_picture(const trace::RenderParams& params) {
  constexpr int most = 65536;
  if (params.width < 1 || params.height < 1 || params.width > most || params.height > most)
    throw Error("width and height",
                fmt::format("must be 1 to {} pixels, not {} x {}", most, params.width, params.height));
  if (params.path.spp < 1 || params.path.passes < 1) throw Error("spp and passes", "must be 1 or more");
  if (params.path.max_depth < 0) throw Error("max_depth", "must not be negative");
}

void add_render(py::module_& m) {
  const py::none none;
  const auto picture = [](const LoadedScene& scene, const std::string& method, const probes::ProbeSet* probes,
                          const Parameters& param, const std::string& camera, int width, int height,
                          const std::string& projection, const py::object& at, int max_depth, int passes,
                          int spp, std::uint64_t seed, const std::string& lookup,
                          const std::optional<std::string>& weights, const std::string& light, bool force,
                          const py::object& progress) {
    const trace::RenderState state =
        rendered(scene, method, probes, param, camera, width, height, projection, at, max_depth, passes, spp,
                 seed, lookup, weights, light, force, false, progress);
    return array_of(trace::resolve(state.color, state.passes_done));
  };
  const auto pictures = [](const LoadedScene& scene, const std::string& method,
                           const probes::ProbeSet* probes, const Parameters& param, const std::string& camera,
                           int width, int height, const std::string& projection, const py::object& at,
                           int max_depth, int passes, int spp, std::uint64_t seed, const std::string& lookup,
                           const std::optional<std::string>& weights, const std::string& light, bool force,
                           const py::object& progress) {
    return layers(scene,
                  rendered(scene, method, probes, param, camera, width, height, projection, at, max_depth,
                           passes, spp, seed, lookup, weights, light, force, true, progress));
  };
  const auto add = [&](const char* name, const auto& function, const char* about) {
    m.def(name, function, about, "scene"_a, "method"_a = "path", py::kw_only(), "probes"_a = none,
          "param"_a = Parameters(), "camera"_a = "", "width"_a = 1280, "height"_a = 720,
          "projection"_a = name_of(pipeline::PictureProjection::camera), "at"_a = none,
          "max_depth"_a = rays::usual_max_depth, "passes"_a = 1, "spp"_a = 16, "seed"_a = 0,
          "lookup"_a = name_of(probes::LookupSpec{}.method), "weights"_a = none,
          "light"_a = name_of(probes::LookupSpec{}.layer), "force"_a = false, "progress"_a = none);
  };
  add("render", picture, "A picture of a scene: linear radiance, height x width x 3.");
  add("render_layers", pictures,
      "The same picture and what it is made of, by name: color, direct, indirect, albedo, normal, depth, and "
      "\"group NAME\" for each light group.");
  m.def("methods", &methods_and_parameters, "What finds indirect light, and the parameters of each.");
}

}  // namespace ssphh::python
