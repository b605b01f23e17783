#include <ssphh/core/error.h>
#include <ssphh/pipeline/places.h>

#include "arrays.h"
#include "probes_argument.h"
#include "work.h"

namespace ssphh::python {
namespace {

FloatArray placed_positions(const place::Placement& self) {
  std::vector<vec3> all;
  for (const place::PlacedProbe& probe : self.probes) all.push_back(probe.position);
  return array_of(std::move(all));
}

py::array_t<std::uint32_t> placed_edges(const place::Placement& self) {
  py::array_t<std::uint32_t> array({static_cast<py::ssize_t>(self.edges.size()), py::ssize_t{2}});
  std::uint32_t* out = array.mutable_data();
  for (const place::PlacedEdge& edge : self.edges) *out++ = edge.a, *out++ = edge.b;
  return array;
}

template <class Value, class Get>
std::vector<Value> each(const place::Placement& self, const Get& get) {
  std::vector<Value> all;
  for (const place::PlacedProbe& probe : self.probes) all.push_back(get(probe));
  return all;
}

const char* kind_name(place::PlaceKind kind) {
  switch (kind) {
    case place::PlaceKind::manual:
      return "manual";
    case place::PlaceKind::grid:
      return "grid";
    case place::PlaceKind::refined:
      return "refined";
    case place::PlaceKind::passage:
      return "passage";
  }
  return "";
}

place::Placement find_places(const LoadedScene& scene, const py::object& probes, float clearance, int refine,
                             int max_probes, const py::object& progress) {
  const pipeline::PlaceOptions options{places_in_words(probes), clearance, refine, max_probes};
  return run(progress, [&](const Control& control) {
    const auto placed =
        pipeline::place_for(scene.geometry(), scene.scene(), scene.time(), options, "auto", control);
    if (!placed)
      throw Error("probes", "are those of the scene: there is nothing to place", "see Scene.probe_places");
    return placed->placement;
  });
}

}  // namespace

std::string places_in_words(const py::object& probes) {
  if (probes.is_none()) return "";
  if (py::isinstance<py::int_>(probes) || py::isinstance<py::str>(probes)) {
    const std::string words = py::str(probes);
    if (const std::string problem = pipeline::places_problem(words); !problem.empty())
      throw Error("probes", problem);
    return words;
  }
  throw Error("probes", "are neither a number nor one of: scene, auto, auto:METRES",
              "for places of your own write scene.with_probes(positions)");
}

void add_place(py::module_& m) {
  using place::Placement;
  py::class_<Placement> type(m, "Placement", "Places that place() found.");
  at_home(type)
      .def("__len__", [](const Placement& p) { return p.probes.size(); })
      .def_property_readonly("positions", &placed_positions, "Nx3 [m], the scene's own first.")
      .def_property_readonly("names",
                             [](const Placement& p) {
                               return each<std::string>(p, [](const auto& probe) { return probe.name; });
                             })
      .def_property_readonly(
          "kinds",
          [](const Placement& p) {
            return each<std::string>(p, [](const auto& probe) { return kind_name(probe.kind); });
          },
          "manual, grid, refined or passage, of each.")
      .def_property_readonly(
          "radii",
          [](const Placement& p) {
            return py::array_t<float>(
                py::cast(each<float>(p, [](const auto& probe) { return probe.radius; })));
          },
          "Of the spheres that VIZ lights [m], N.")
      .def_property_readonly("edges", &placed_edges, "Pairs of neighbours that see each other, Mx2.")
      .def_readonly("spacing", &Placement::spacing, "Of the coarse grid [m].")
      .def_readonly("warnings", &Placement::warnings)
      .def("__repr__", [](const Placement& p) {
        return "<ssphh.Placement of " + std::to_string(p.probes.size()) + " probes>";
      });
  m.def("place", &find_places, "Finds places for probes, as `ssphh place` does.", "scene"_a,
        "probes"_a = py::none(), py::kw_only(), py::arg_v("clearance", 0.04f, "0.04"), "refine"_a = 1,
        "max_probes"_a = 65536, "progress"_a = py::none());
}

}  // namespace ssphh::python
