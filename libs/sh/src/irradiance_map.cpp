#include "irradiance_map.h"

#include <cmath>

#include <ssphh/core/octahedral.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

namespace ssphh::sh {
namespace {

/// Solves A X = B for n rows, A symmetric and positive definite; X takes B's place. A is destroyed.
void solve(std::span<double> a, std::span<double> b, std::size_t n) {
  const std::size_t columns = b.size() / n;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const double factor = a[j * n + i] / a[i * n + i];
      for (std::size_t k = i; k < n; ++k) a[j * n + k] -= factor * a[i * n + k];
      for (std::size_t k = 0; k < columns; ++k) b[j * columns + k] -= factor * b[i * columns + k];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < columns; ++k) b[i * columns + k] /= a[i * n + i];
}

/// out[row] = Σ matrix[row][i] values[i]
std::vector<vec3> product(std::span<const double> matrix, std::span<const vec3> values) {
  std::vector<vec3> out;
  for (std::size_t row = 0; row < matrix.size(); row += values.size()) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < values.size(); ++i) sum += matrix[row + i] * glm::dvec3(values[i]);
    out.emplace_back(sum);
  }
  return out;
}

}  // namespace

IrradianceMap::IrradianceMap(int side, int degree) : side_(side), degree_(degree) {
  const auto texels = static_cast<std::size_t>(side * side);
  const auto count = static_cast<std::size_t>(coefficient_count(degree));
  to_texels_.resize(texels * count);
  for (std::size_t t = 0; t < texels; ++t) {
    const std::span<double> row = std::span(to_texels_).subspan(t * count, count);
    eval_basis(degree, glm::normalize(glm::dvec3(octahedral_texel(static_cast<int>(t), side))), row);
    for (int l = 0; l <= degree; ++l)
      for (int m = -l; m <= l; ++m) row[coefficient_index(l, m)] *= cosine_band_factor(l);
  }

  // The normal equations; of bands without irradiance both sides are 0, and so shall the coefficients be.
  std::vector<double> gram(count * count, 0);
  from_texels_.resize(count * texels);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t t = 0; t < texels; ++t) {
      const double* row = &to_texels_[t * count];
      from_texels_[i * texels + t] = row[i];
      for (std::size_t j = 0; j < count; ++j) gram[i * count + j] += row[i] * row[j];
    }
    if (gram[i * count + i] == 0) gram[i * count + i] = 1;
  }
  solve(gram, from_texels_, count);
}

std::vector<vec3> IrradianceMap::texels(const RadianceSh& radiance) const {
  return product(to_texels_, radiance.values);
}

RadianceSh IrradianceMap::radiance(std::span<const vec3> texels) const {
  RadianceSh radiance(degree_);
  radiance.values = product(from_texels_, texels);
  return radiance;
}

}  // namespace ssphh::sh
