#pragma once
/// Between numpy's arrays and the library's values.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include <ssphh/core/math.h>
#include <ssphh/image/image.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/sh/coefficients.h>

#include "binding.h"

namespace ssphh::python {

using FloatArray = py::array_t<float, py::array::c_style>;
using Shape = std::vector<py::ssize_t>;

/// Numbers of a shape, of which -1 stands for any size from 1: the array itself where it is float32 and
/// contiguous, else a copy. Throws Error(where, …) that tells of both shapes for others, and for what holds
/// no numbers.
FloatArray numbers(const py::handle& object, const std::string& where, const Shape& shape);

/// Rows of three, where the array lies.
std::span<const vec3> rows(const FloatArray& array);

/// N×3 finite numbers. Throws Error as numbers() does.
FloatArray positions(const py::handle& object, const std::string& where);

/// Surface points of N×3 positions and N×3 normals, which are made unit vectors; `moves`: None, or N truths.
/// Throws Error for arrays of other shapes and normals that have no direction.
std::vector<rays::SurfacePoint> surface_points(const py::handle& points, const py::handle& normals,
                                               const py::handle& moves);

/// Of three numbers.
vec3 vector_of(const py::handle& object, const std::string& where);
/// Of three numbers, or one for all.
vec3 color_of(const py::handle& object, const std::string& where);

/// A new array of N×3.
FloatArray array_of(std::span<const vec3> values);
/// The vector (or what it is a part of), in numpy's hands: no number is copied.
FloatArray array_of(std::vector<vec3>&& values);
/// Of three numbers.
FloatArray array_of(const vec3& value);

/// height×width×channels; of one channel height×width. No pixel is copied.
FloatArray array_of(image::Image&& image);
/// A copy of an array of height×width, or height×width×(1, 3 or 4).
image::Image image_of(const py::handle& object, const std::string& where);

/// Coefficients K×3, K = 1, 4, 9 … 121.
sh::RadianceSh sh_of(const py::handle& object, const std::string& where);

/// N×K×3 of as many functions of one degree; an empty one is zero.
template <class Functions, class Get>
FloatArray array_of_functions(const Functions& functions, int degree, const Get& get) {
  const auto k = static_cast<std::size_t>(sh::coefficient_count(degree));
  FloatArray array({static_cast<py::ssize_t>(functions.size()), static_cast<py::ssize_t>(k), py::ssize_t{3}});
  auto* out = reinterpret_cast<vec3*>(array.mutable_data());
  for (const auto& function : functions) {
    const std::vector<vec3>& values = get(function).values;
    out = values.empty() ? std::fill_n(out, k, vec3(0)) : std::copy(values.begin(), values.end(), out);
  }
  return array;
}

}  // namespace ssphh::python
