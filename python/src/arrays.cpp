#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ssphh::python {
namespace {

static_assert(sizeof(vec3) == 3 * sizeof(float));

std::string shape_text(const Shape& shape) {
  if (shape.empty()) return "a single number";
  std::vector<std::string> sizes;
  for (std::size_t i = 0; i < shape.size(); ++i)
    sizes.push_back(shape[i] >= 0 ? fmt::format("{}", shape[i]) : i == 0 ? "N" : "K");
  return fmt::format("of shape {}", fmt::join(sizes, " x "));
}

Shape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

bool fits(const Shape& shape, const Shape& wanted) {
  if (shape.size() != wanted.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (wanted[i] < 0 ? shape[i] == 0 : shape[i] != wanted[i]) return false;
  return true;
}

/// float32, contiguous, of any shape.
FloatArray floats(const py::handle& object, const std::string& where) {
  const py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw Error(where, "is no array of numbers");
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw Error(where, fmt::format("holds {}, not numbers", std::string(py::str(array.dtype()))));
  return py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
}

/// Keeps what owns an array's memory.
template <class Owner>
FloatArray with_owner(std::unique_ptr<Owner> owner, const float* data, const Shape& shape) {
  const py::capsule keep(owner.get(), [](void* p) { delete static_cast<Owner*>(p); });
  owner.release();
  return FloatArray(shape, data, keep);
}

}  // namespace

FloatArray numbers(const py::handle& object, const std::string& where, const Shape& shape) {
  FloatArray array = floats(object, where);
  if (!fits(shape_of(array), shape))
    throw Error(where, fmt::format("must be {}, not {}", shape_text(shape), shape_text(shape_of(array))));
  return array;
}

std::span<const vec3> rows(const FloatArray& array) {
  return {reinterpret_cast<const vec3*>(array.data()), static_cast<std::size_t>(array.size()) / 3};
}

FloatArray positions(const py::handle& object, const std::string& where) {
  FloatArray array = numbers(object, where, {-1, 3});
  const auto all = rows(array);
  const auto wrong = std::ranges::find_if(all, [](const vec3& p) { return !is_finite(p); });
  if (wrong != all.end())
    throw Error(where, fmt::format("number {} is infinite or NaN", wrong - all.begin()));
  return array;
}

std::vector<rays::SurfacePoint> surface_points(const py::handle& points, const py::handle& normals,
                                               const py::handle& moves) {
  const FloatArray places = positions(points, "points");
  const FloatArray directions = numbers(normals, "normals", {places.shape(0), 3});
  const auto p = rows(places), n = rows(directions);
  std::vector<rays::SurfacePoint> all(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const float length = glm::length(n[i]);
    if (!(length > 0) || !std::isfinite(length))
      throw Error("normals", fmt::format("number {} has no direction", i));
    all[i] = {p[i], n[i] / length, false};
  }
  if (!moves.is_none()) {
    const auto truths = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(moves);
    if (!truths || truths.ndim() != 1 || truths.shape(0) != places.shape(0)) {
      PyErr_Clear();
      throw Error("moves", fmt::format("must be {} truths, one for each point", p.size()));
    }
    for (std::size_t i = 0; i < p.size(); ++i) all[i].moves = truths.data()[i];
  }
  return all;
}

vec3 vector_of(const py::handle& object, const std::string& where) {
  const vec3 value = rows(numbers(object, where, {3})).front();
  if (!is_finite(value)) throw Error(where, "is infinite or NaN");
  return value;
}

vec3 color_of(const py::handle& object, const std::string& where) {
  const FloatArray array = floats(object, where);
  return array.ndim() == 0 ? vec3(*array.data()) : vector_of(object, where);
}

FloatArray array_of(std::span<const vec3> values) {
  FloatArray array({static_cast<py::ssize_t>(values.size()), py::ssize_t{3}});
  std::ranges::copy(values, reinterpret_cast<vec3*>(array.mutable_data()));
  return array;
}

FloatArray array_of(std::vector<vec3>&& values) {
  auto owner = std::make_unique<std::vector<vec3>>(std::move(values));
  const Shape shape = {static_cast<py::ssize_t>(owner->size()), 3};
  const auto* data = reinterpret_cast<const float*>(owner->data());
  return with_owner(std::move(owner), data, shape);
}

FloatArray array_of(const vec3& value) {
  FloatArray array(Shape{3});
  std::memcpy(array.mutable_data(), &value, sizeof value);
  return array;
}

FloatArray array_of(image::Image&& image) {
  Shape shape = {image.height, image.width};
  if (image.channels > 1) shape.push_back(image.channels);
  auto owner = std::make_unique<std::vector<float>>(std::move(image.pixels));
  const float* data = owner->data();
  return with_owner(std::move(owner), data, shape);
}

image::Image image_of(const py::handle& object, const std::string& where) {
  const FloatArray array = floats(object, where);
  const Shape shape = shape_of(array);
  const auto channels = shape.size() == 3 ? shape[2] : 1;
  const bool sound = (shape.size() == 2 || shape.size() == 3) && array.size() > 0 &&
                     (channels == 1 || channels == 3 || channels == 4) && shape[0] <= 65536 &&
                     shape[1] <= 65536;
  if (!sound)
    throw Error(where, fmt::format("must be height x width, or height x width x 1, 3 or 4, not {}",
                                   shape_text(shape)));
  image::Image image(static_cast<int>(shape[1]), static_cast<int>(shape[0]), static_cast<int>(channels));
  std::memcpy(image.pixels.data(), array.data(), image.pixels.size() * sizeof(float));
  return image;
}

sh::RadianceSh sh_of(const py::handle& object, const std::string& where) {
  const FloatArray array = numbers(object, where, {-1, 3});
  sh::RadianceSh function;
  const auto values = rows(array);
  function.values.assign(values.begin(), values.end());
  if (sh::coefficient_count(function.degree()) != static_cast<int>(values.size()) ||
      function.degree() > sh::max_degree)
    throw Error(where, fmt::format("has {} coefficients, and not 1, 4, 9, ... 121", values.size()),
                "a function of degree d has (d + 1)^2, rows of red, green and blue");
  return function;
}

}  // namespace ssphh::python
