#include "tile_basis.h"

#include <algorithm>

#include <ssphh/core/octahedral.h>
#include <ssphh/sh/evaluate.h>

namespace ssphh::realtime {

TileBasis::TileBasis(int size, int degree) : size_(size), degree_(degree) {
  const auto count = static_cast<std::size_t>(sh::coefficient_count(degree));
  basis_.resize(count * texels());
  std::array<float, sh::max_coefficient_count> y;
  for (std::size_t t = 0; t < texels(); ++t) {
    const auto column = static_cast<float>(t % static_cast<std::size_t>(side()));
    const auto row = static_cast<float>(t / static_cast<std::size_t>(side()));
    const auto n = static_cast<float>(size_);
    const vec2 place((2 * column - 1) / n - 1, (2 * row - 1) / n - 1);
    sh::eval_basis(degree_, octahedral_direction(place), y);
    for (std::size_t k = 0; k < count; ++k) basis_[k * texels() + t] = y[k];
  }
}

void TileBasis::evaluate(std::span<const vec3> coefficients, std::span<const float> band_factors,
                         std::span<vec4> out) const {
  const std::size_t n = texels();
  SSPHH_CHECK(out.size() == n && band_factors.size() > static_cast<std::size_t>(degree_));
  std::ranges::fill(out, vec4(0));
  for (int l = 0; l <= degree_; ++l) {
    const float factor = band_factors[l];
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (factor == 0 || i >= coefficients.size()) continue;
      const vec4 c(factor * coefficients[i], 0);
      const float* y = basis_.data() + i * n;
      for (std::size_t t = 0; t < n; ++t) out[t] += y[t] * c;
    }
  }
  for (vec4& texel : out) texel = glm::max(texel, vec4(0));
}

}  // namespace ssphh::realtime
