#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>

#include "arrays.h"
#include "work.h"

namespace ssphh::python {
namespace {

using probes::GroupLight;
using probes::Probe;
using probes::ProbeSet;
using Handle = std::shared_ptr<ProbeSet>;

std::size_t group_index(const ProbeSet& self, const std::string& name) {
  std::vector<std::string> names;
  for (const probes::LightGroup& group : self.light_groups) names.push_back(group.name);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw Error("light group " + name, "the probes have none of this name", nearest_hint(name, names));
  return static_cast<std::size_t>(found - names.begin());
}

FloatArray positions_of(const ProbeSet& self) {
  std::vector<vec3> all;
  for (const Probe& probe : self.probes) all.push_back(probe.position);
  return array_of(std::move(all));
}

/// Light as baked is never changed, so that numpy may look at it where it lies.
py::array view_of(const sh::RadianceSh& function, const Handle& owner) {
  const auto k = static_cast<py::ssize_t>(function.values.size());
  py::array_t<float> array({k, py::ssize_t{3}}, reinterpret_cast<const float*>(function.values.data()),
                           py::cast(owner));
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::dict light_at(const Handle& self, std::ptrdiff_t index) {
  const auto count = static_cast<std::ptrdiff_t>(self->probes.size());
  if (index < -count || index >= count)
    throw py::index_error(fmt::format("there is no probe {}: there are {}", index, count));
  const Probe& probe = self->probes[index < 0 ? index + count : index];
  py::dict groups;
  for (std::size_t g = 0; g < probe.groups.size(); ++g) {
    const GroupLight& light = probe.groups[g];
    groups[py::str(self->light_groups[g].name)] =
        py::make_tuple(view_of(light.emitted, self), view_of(light.reflected, self));
  }
  return groups;
}

FloatArray of_group(const ProbeSet& self, const std::string& name, bool emitted) {
  const std::size_t g = group_index(self, name);
  return array_of_functions(self.probes, self.degree, [&](const Probe& probe) -> const sh::RadianceSh& {
    return emitted ? probe.groups[g].emitted : probe.groups[g].reflected;
  });
}

py::dict groups_of(const ProbeSet& self) {
  py::dict all;
  for (const probes::LightGroup& group : self.light_groups) all[py::str(group.name)] = array_of(group.scale);
  return all;
}

py::dict modes_of(const ProbeSet& self) {
  py::dict all;
  for (const probes::LightGroup& group : self.light_groups)
    all[py::str(group.name)] = std::string(name_of(group.mode));
  return all;
}

py::dict generator_of(const ProbeSet& self) {
  const probes::GeneratorInfo& g = self.generator;
  return py::dict("operator"_a = std::string(name_of(g.op)), "viz"_a = std::string(name_of(g.viz)),
                  "gen"_a = std::string(name_of(g.gen)), "max_depth"_a = g.max_depth, "passes"_a = g.passes,
                  "spp"_a = g.spp, "face"_a = g.face_size, "seed"_a = g.seed, "directions"_a = g.directions,
                  "surfel_size"_a = g.surfel_size, "link_rays"_a = g.link_rays, "scene"_a = g.scene,
                  "scene_hash"_a = g.scene_hash.hex(), "time"_a = g.time);
}

/// From, to and P of every edge.
py::tuple edges_of(const ProbeSet& self) {
  const auto count = static_cast<py::ssize_t>(probes::edge_count(self));
  py::array_t<int> ends({count, py::ssize_t{2}});
  py::array_t<float> transfer(count);
  int* end = ends.mutable_data();
  float* share = transfer.mutable_data();
  for (std::size_t to = 0; to < self.probes.size(); ++to) {
    for (const probes::Edge& edge : self.probes[to].edges) {
      *end++ = edge.from, *end++ = static_cast<int>(to);
      *share++ = edge.transfer;
    }
  }
  return py::make_tuple(ends, transfer);
}

py::object records_of(const Handle& self) {
  if (!self->surface) return py::none();
  const std::vector<rays::SurfacePoint>& points = self->surface->points;
  const auto count = static_cast<py::ssize_t>(points.size());
  const auto view = [&](const vec3& first) {
    py::array_t<float> array(
        {count, py::ssize_t{3}},
        {static_cast<py::ssize_t>(sizeof(rays::SurfacePoint)), py::ssize_t{sizeof(float)}}, &first.x,
        py::cast(self));
    array.attr("flags").attr("writeable") = false;
    return array;
  };
  if (points.empty()) return py::none();
  std::vector<vec3> light;
  for (std::size_t i = 0; i < points.size(); ++i)
    light.push_back(self->surface->light[i] * vec4(points[i].normal, 1));
  return py::make_tuple(view(points.front().position), view(points.front().normal),
                        array_of(std::move(light)));
}

std::size_t run_hier(ProbeSet& self, const std::string& op, int neighbors, float threshold) {
  const probes::HierParams params{enum_named<probes::HierOperator>("operator", op), neighbors, threshold};
  return probes::hier(self, params);
}

/// Reflected light of each of `groups` light groups at `n` probes.
struct LightArray {
  int degree = 0;
  std::vector<std::vector<sh::RadianceSh>> groups;  ///< [group][probe]
};

/// Of groups × N × K × 3, or of one group N × K × 3. Throws Error for other shapes.
LightArray light_of(const py::object& object, std::size_t groups, std::size_t n) {
  py::array given = py::array::ensure(object);
  if (!given) PyErr_Clear();
  const auto size = static_cast<py::ssize_t>(n);
  const bool grouped = groups != 1 || (given && given.ndim() == 4);
  const FloatArray values =
      numbers(object, "reflected",
              grouped ? Shape{static_cast<py::ssize_t>(groups), size, -1, 3} : Shape{size, -1, 3});
  const auto k = static_cast<std::size_t>(values.shape(grouped ? 2 : 1));
  LightArray light;
  const auto all = rows(values);
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<sh::RadianceSh>& functions = light.groups.emplace_back(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto part = all.subspan((g * n + i) * k, k);
      functions[i].values.assign(part.begin(), part.end());
    }
  }
  light.degree = light.groups.front().front().degree();
  if (light.degree > sh::max_degree || sh::coefficient_count(light.degree) != static_cast<int>(k))
    throw Error("reflected", fmt::format("has {} coefficients a probe, and not 1, 4, 9, ... 121", k));
  return light;
}

/// Gives a set of probes this light and no other.
void set_light(ProbeSet& set, LightArray light) {
  set.degree = light.degree;
  set.hierarchy.reset();
  set.fitted.reset();
  set.surface.reset();
  set.baseline.reset();
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    Probe& probe = set.probes[i];
    probe.edges.clear();
    probe.groups.clear();
    for (std::vector<sh::RadianceSh>& group : light.groups) probe.groups.push_back({{}, std::move(group[i])});
  }
  probes::validate(set, "probes from arrays");
  probes::merge_groups(set);
}

Handle from_arrays(const py::object& positions_, const py::object& reflected,
                   const std::vector<std::string>& light_groups,
                   const std::optional<std::vector<std::string>>& names, float radius) {
  const FloatArray places = positions(positions_, "positions");
  const auto n = static_cast<std::size_t>(places.shape(0));
  if (light_groups.empty()) throw Error("light_groups", "there must be one");
  for (std::size_t g = 1; g < light_groups.size(); ++g)
    if (std::find(light_groups.begin(), light_groups.begin() + static_cast<std::ptrdiff_t>(g),
                  light_groups[g]) != light_groups.begin() + static_cast<std::ptrdiff_t>(g))
      throw Error("light_groups", fmt::format("two are named \"{}\"", light_groups[g]));
  if (names && names->size() != n) throw Error("names", "must be as many as positions");
  LightArray light = light_of(reflected, light_groups.size(), n);
  auto set = std::make_shared<ProbeSet>();
  for (const std::string& group : light_groups) set->light_groups.push_back({group});
  for (std::size_t i = 0; i < n; ++i) {
    Probe& probe = set->probes.emplace_back();
    probe.name = names ? (*names)[i] : fmt::format("probe{}", i);
    probe.position = rows(places)[i];
    probe.radius = radius;
  }
  set_light(*set, std::move(light));
  return set;
}

Handle with_light(const ProbeSet& self, const py::object& reflected) {
  if (self.probes.empty()) throw Error("probes", "there are none");
  LightArray light = light_of(reflected, self.light_groups.size(), self.probes.size());
  auto set = std::make_shared<ProbeSet>(self);
  set->generator.viz = probes::VizMethod::none;
  for (probes::LightGroup& group : set->light_groups) group.mode = scene::LightMode::realtime;
  set_light(*set, std::move(light));
  return set;
}

Handle load_probes(const py::object& path, const SceneHandle& scene, bool force) {
  const std::string file = path_of(path);
  return run(py::none(), [&](const Control&) {
    return std::make_shared<ProbeSet>(
        scene ? pipeline::read_probes_of(scene->scene(), file, scene->time(), force)
              : probes::read_probe_file(file));
  });
}

/// Under the GIL, as everything that looks at a set: another thread might dim its lamps meanwhile.
void save_probes(const ProbeSet& self, const py::object& path) {
  probes::write_probe_file(self, path_of(path));
}

}  // namespace

void add_probe_set(py::module_& m) {
  py::class_<ProbeSet, Handle> type(m, "ProbeSet",
                                    "Probes and their light: what a bake makes and a file holds.");
  at_home(type)
      .def_static("load", &load_probes, "Reads a probe file; with `scene`, refuses probes of another one.",
                  "path"_a, "scene"_a = SceneHandle(), py::kw_only(), "force"_a = false)
      .def_static("from_arrays", &from_arrays,
                  "A set of N positions and reflected light NxKx3, or light groups x N x K x 3.",
                  "positions"_a, "reflected"_a, py::kw_only(),
                  "light_groups"_a = std::vector<std::string>{"light"}, "names"_a = py::none(),
                  py::arg_v("radius", 0.1f, "0.1"))
      .def("with_light", &with_light,
           "The same probes with other reflected light, as from_arrays() takes it, and nothing else.",
           "reflected"_a)
      .def("save", &save_probes, "Writes .sphl (binary) or .sphl.json (five digits).", "path"_a)
      .def("__len__", [](const ProbeSet& s) { return s.probes.size(); })
      .def(
          "__eq__", [](const ProbeSet& a, const ProbeSet& b) { return a == b; }, py::is_operator())
      .def_property_readonly(
          "degree", [](const ProbeSet& s) { return s.degree; }, "Highest band.")
      .def_property_readonly("positions", &positions_of, "Nx3 [m].")
      .def_property_readonly("names",
                             [](const ProbeSet& s) {
                               std::vector<std::string> names;
                               for (const Probe& probe : s.probes) names.push_back(probe.name);
                               return names;
                             })
      .def_property_readonly(
          "radii",
          [](const ProbeSet& s) {
            py::array_t<float> radii(static_cast<py::ssize_t>(s.probes.size()));
            std::ranges::transform(s.probes, radii.mutable_data(), &Probe::radius);
            return radii;
          },
          "N [m].")
      .def_property_readonly("light_groups", &groups_of, "Factor of each light group, by name.")
      .def_property_readonly("light_modes", &modes_of, "Mode of each light group, by name.")
      .def_property_readonly("generator", &generator_of, "How the set was made.")
      .def_property_readonly(
          "reflected",
          [](const ProbeSet& s) {
            return array_of_functions(
                s.probes, s.degree, [](const Probe& p) -> const auto& { return p.reflected; });
          },
          "What surfaces look up: all groups times their factors, NxKx3.")
      .def_property_readonly(
          "radiance",
          [](const ProbeSet& s) {
            return array_of_functions(
                s.probes, s.degree, [](const Probe& p) -> const auto& { return p.self; });
          },
          "The same with emitters seen directly, NxKx3.")
      .def_property_readonly(
          "hierarchy",
          [](const ProbeSet& s) -> py::object {
            if (!s.hierarchy) return py::none();
            return array_of_functions(
                s.hierarchy->sum, s.degree, [](const auto& f) -> const auto& { return f; });
          },
          "What hier() found, NxKx3; None before.")
      .def(
          "group",
          [](const ProbeSet& s, const std::string& name) {
            return py::make_tuple(of_group(s, name, true), of_group(s, name, false));
          },
          "Emitted and reflected light of one group as baked, NxKx3 each.", "name"_a)
      .def("light", &light_at,
           "Emitted and reflected light of each group as baked, of one probe: Kx3 views without a copy, read "
           "only; 0x3 where nothing emits.",
           "index"_a)
      .def_property_readonly("edges", &edges_of, "(from, to) of every edge, Mx2, and its P, M.")
      .def_property_readonly("records", &records_of,
                             "Positions, normals and irradiance of surface records, Mx3 each; None without.")
      .def(
          "relight",
          [](ProbeSet& s, const std::string& group, const py::object& scale) {
            probes::relight(s, group, color_of(scale, "scale"));
          },
          "Dims or colours a light group without a bake, relative to it.", "group"_a, "scale"_a)
      .def("hier", &run_hier, "Adds neighbours' light; returns the number of edges used.",
           "operator"_a = name_of(probes::HierOperator::coefficient), py::kw_only(), "neighbors"_a = -1,
           "threshold"_a = 0.0f)
      .def("__repr__", [](const ProbeSet& s) {
        return fmt::format("<ssphh.ProbeSet of {} probes, degree {}, {} light groups, {} edges>",
                           s.probes.size(), s.degree, s.light_groups.size(), probes::edge_count(s));
      });
  type.attr("__hash__") = py::none();
}

}  // namespace ssphh::python
