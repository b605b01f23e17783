#include "shaped_intensity.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>

namespace ssphh::shading {
namespace {

constexpr int rows = 20, columns = 40, cells = rows * columns;
constexpr float cell_solid_angle = 4 * pi / cells;

/// Of the unit square on the sphere: x is the row, y around z.
vec3 place_on_sphere(const vec2& place) {
  const float z = 1 - 2 * place.x;
  return {std::sqrt(glm::max(1 - z * z, 0.0f)) * unit_circle(place.y), z};
}

}  // namespace

ShapedIntensity::ShapedIntensity(sh::IntensitySh emission, const mat4& world)
    : emission_(std::move(emission)), axes_(scene::emission_axes(world)) {
  // Eight directions at a time: sessions make one in every frame
  std::vector<float> x, y, z;
  for (int cell = 0; cell < cells; ++cell) {
    const vec3 d = place_on_sphere({(static_cast<float>(cell / columns) + 0.5f) / rows,
                                    (static_cast<float>(cell % columns) + 0.5f) / columns});
    x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
  }
  std::vector<float> basis(emission_.values.size() * cells);
  sh::eval_basis(emission_.degree(), x, y, z, basis);
  std::vector<vec3> sums(cells, vec3(0));
  for (std::size_t k = 0; k < emission_.values.size(); ++k) {
    for (std::size_t i = 0; i < cells; ++i) sums[i] += basis[k * cells + i] * emission_.values[k];
  }
  std::vector<float> weights;
  mean_ = emission_.values[0] / std::sqrt(4 * pi);  // and what is cut off below 0
  for (const vec3& sum : sums) {
    mean_ += glm::max(-sum, vec3(0)) / static_cast<float>(cells);
    weights.push_back(luminance(glm::max(sum, vec3(0))));
  }
  mean_ = glm::max(mean_, vec3(0));
  // A share for each: a cell may be dark in its middle alone
  const float least = std::max(0.05f * luminance(mean_), 1e-20f);
  for (float& weight : weights) weight += least;
  cells_ = Distribution(weights);
}

vec3 ShapedIntensity::toward(const vec3& direction) const {
  return scene::eval_intensity(emission_, to_local(direction));
}

ShapedIntensity::Direction ShapedIntensity::sample(const vec2& u) const {
  const Distribution::Choice choice = cells_.sample(u.x);
  const auto row = static_cast<float>(choice.index / columns),
             column = static_cast<float>(choice.index % columns);
  const vec3 local = place_on_sphere({(row + choice.u) / rows, (column + u.y) / columns});
  return {glm::normalize(axes_ * local), choice.probability / cell_solid_angle};
}

float ShapedIntensity::pdf(const vec3& direction) const {
  const vec3 local = to_local(direction);
  float turn = std::atan2(local.y, local.x) / (2 * pi);
  turn -= std::floor(turn);
  const int row = std::clamp(static_cast<int>((1 - local.z) / 2 * rows), 0, rows - 1);
  const int column = std::clamp(static_cast<int>(turn * columns), 0, columns - 1);
  return cells_.probability(static_cast<std::size_t>(row * columns + column)) / cell_solid_angle;
}

}  // namespace ssphh::shading
