#include <array>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/enum_names.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/window.h>

#include "arrays.h"

namespace ssphh::python {
namespace {

/// N×3 of unit vectors. Throws Error where one is none.
FloatArray directions_of(const py::object& object, const std::string& where) {
  FloatArray array = positions(object, where);
  const auto all = rows(array);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(glm::length(all[i]) - 1) > 1e-3f)
      throw Error(where,
                  fmt::format("number {} is no unit vector: its length is {:.4g}", i, glm::length(all[i])));
  }
  return array;
}

FloatArray basis(int degree, const py::object& directions) {
  sh::require_degree(degree, "degree");
  const FloatArray array = directions_of(directions, "directions");
  const auto all = rows(array);
  const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
  FloatArray out({static_cast<py::ssize_t>(all.size()), static_cast<py::ssize_t>(k)});
  float* at = out.mutable_data();
  for (const vec3& direction : all) {
    sh::eval_basis(degree, direction, std::span(at, k));
    at += k;
  }
  return out;
}

FloatArray evaluate(const py::object& coefficients, const py::object& directions) {
  const sh::RadianceSh function = sh_of(coefficients, "coefficients");
  const FloatArray array = directions_of(directions, "directions");
  std::vector<vec3> values(rows(array).size());
  sh::eval(function, rows(array), values);
  return array_of(std::move(values));
}

FloatArray project(int degree, const py::object& directions, const py::object& weights,
                   const py::object& radiance) {
  sh::require_degree(degree, "degree");
  const FloatArray toward = directions_of(directions, "directions");
  const py::ssize_t n = toward.shape(0);
  const FloatArray angles = numbers(weights, "weights", {n}), light = numbers(radiance, "radiance", {n, 3});
  return array_of(std::move(
      sh::project(degree, rows(toward), std::span(angles.data(), static_cast<std::size_t>(n)), rows(light))
          .values));
}

FloatArray project_cube(int degree, const py::object& faces) {
  sh::require_degree(degree, "degree");
  py::array given = py::array::ensure(faces);
  if (!given) PyErr_Clear();
  const py::ssize_t n = given && given.ndim() == 4 ? given.shape(1) : -1;
  const FloatArray array = numbers(faces, "faces", {6, n, n, 3});
  const auto texels = static_cast<std::size_t>(array.size()) / 6;
  sh::CubeFaces cube;
  for (std::size_t f = 0; f < 6; ++f) cube[f] = {array.data() + f * texels, texels};
  return array_of(std::move(sh::project_cube(degree, static_cast<int>(array.shape(1)), cube).values));
}

FloatArray irradiance(const py::object& coefficients) {
  return array_of(std::move(sh::irradiance_from_radiance(sh_of(coefficients, "coefficients")).values));
}

glm::dmat3 matrix_of(const py::object& object) {
  const FloatArray array = numbers(object, "matrix", {3, 3});
  glm::dmat3 matrix;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix[c][r] = static_cast<double>(array.at(r, c));
  const glm::dmat3 unit = matrix * glm::transpose(matrix);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(unit[c][r] - (r == c ? 1 : 0)) < 1e-4))
        throw Error("matrix", "is no rotation: its rows are not at right angles and of length 1");
  return matrix;
}

FloatArray rotate(const py::object& coefficients, const py::object& matrix) {
  const sh::RadianceSh function = sh_of(coefficients, "coefficients");
  return array_of(std::move(sh::Rotation(function.degree(), matrix_of(matrix)).apply(function).values));
}

FloatArray window(const py::object& coefficients, const std::string& kind, std::optional<double> width) {
  const sh::RadianceSh function = sh_of(coefficients, "coefficients");
  if (kind == "auto") {
    if (width)
      throw Error("width", "is found by the window auto", "leave it out, or choose hanning or lanczos");
    return array_of(std::move(sh::dering(function).values));
  }
  if (kind != "hanning" && kind != "lanczos")
    throw Error("window", none_of(kind, {"auto", "hanning", "lanczos"}));
  if (!width || !(*width > 0)) throw Error("width", "must be above 0, in bands", "try degree + 1");
  const sh::BandScales scales = kind == "hanning" ? sh::hanning_window(*width) : sh::lanczos_window(*width);
  return array_of(std::move(sh::apply_window(function, scales).values));
}

FloatArray convert(const py::object& coefficients, const std::string& to, const std::string& from) {
  const auto source = enum_named<sh::Convention>("from_convention", from),
             target = enum_named<sh::Convention>("to", to);
  const FloatArray array = numbers(coefficients, "coefficients", {-1, 3});
  return array_of(sh::to_convention(sh::from_convention(rows(array), source), target));
}

FloatArray minimum(const py::object& coefficients) {
  return array_of(sh::minimum(sh_of(coefficients, "coefficients")));
}

}  // namespace

void add_sh(py::module_& parent) {
  py::module_ m =
      parent.def_submodule("sh", "Spherical harmonics: real, orthonormal, no Condon-Shortley sign.");
  m.attr("__name__") = "ssphh.sh";
  m.attr("max_degree") = sh::max_degree;
  m.def(
      "coefficient_count",
      [](int degree) {
        sh::require_degree(degree, "degree");
        return sh::coefficient_count(degree);
      },
      "(degree + 1)^2.", "degree"_a);
  m.def("basis", &basis, "Values of all Y_k in unit directions Nx3: NxK.", "degree"_a, "directions"_a);
  m.def("evaluate", &evaluate, "The function of coefficients Kx3 in unit directions Nx3: Nx3.",
        "coefficients"_a, "directions"_a);
  m.def("project", &project,
        "Coefficients Kx3 of radiance Nx3 in unit directions Nx3, each of a solid angle `weights` [sr].",
        "degree"_a, "directions"_a, "weights"_a, "radiance"_a);
  m.def("project_cube", &project_cube, "Coefficients Kx3 of six faces +X -X +Y -Y +Z -Z, 6xMxMx3.",
        "degree"_a, "faces"_a);
  m.def("irradiance", &irradiance,
        "Coefficients of E(n) [W/m2] of those of radiance: the cosine convolution, without a hidden 1/pi.",
        "coefficients"_a);
  m.def("rotate", &rotate, "The function turned by an orthogonal 3x3 matrix: (R f)(w) = f(R^-1 w).",
        "coefficients"_a, "matrix"_a);
  m.def("window", &window,
        "Higher bands damped: auto (just enough that E(n) is nowhere negative), hanning or lanczos of a "
        "width in "
        "bands.",
        "coefficients"_a, "window"_a = "auto", py::kw_only(), "width"_a = py::none());
  m.def("minimum", &minimum, "Lowest value over the sphere, of each colour.", "coefficients"_a);
  m.def("convert", &convert, "Coefficients in the convention of another program.", "coefficients"_a, "to"_a,
        py::kw_only(), "from_convention"_a = name_of(sh::Convention::ssphh));
}

}  // namespace ssphh::python
