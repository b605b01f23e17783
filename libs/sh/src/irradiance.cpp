#include <array>

#include <ssphh/core/math.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

namespace ssphh::sh {
namespace {

constexpr std::array<double, max_degree + 1> make_factors() {
  std::array<double, max_degree + 1> factors{};
  factors[0] = pi_d;
  factors[1] = 2 * pi_d / 3;
  // A_l = 2π (−1)^{l/2−1} / ((l+2)(l−1)) · l! / (2^l (l/2)!²) for even l; the last factor is a product of
  // (2i−1)/2i.
  double central = 1;
  for (int l = 2; l <= max_degree; l += 2) {
    central *= (l - 1.0) / l;
    factors[l] = (l % 4 == 2 ? 1 : -1) * 2 * pi_d / ((l + 2.0) * (l - 1.0)) * central;
  }
  return factors;
}

constexpr std::array<double, max_degree + 1> factors = make_factors();

constexpr float c1 = 0.42904277f, c2 = 0.51166335f, c3 = 0.74312387f, c4 = 0.88622693f, c5 = 0.24770796f;

// Coefficients of degree 2, missing ones 0.
std::array<vec3, 9> first_bands(const RadianceSh& radiance) {
  std::array<vec3, 9> bands{};
  for (std::size_t k = 0; k < std::min<std::size_t>(9, radiance.values.size()); ++k)
    bands[k] = radiance.values[k];
  return bands;
}

}  // namespace

double cosine_band_factor(int l) {
  require_degree(l, "cosine band factor");
  return factors[l];
}

IrradianceSh irradiance_from_radiance(const RadianceSh& radiance) {
  IrradianceSh result;
  result.values = radiance.values;
  for (int l = 0; l <= radiance.degree(); ++l) {
    for (int m = -l; m <= l; ++m)
      result[coefficient_index(l, m)] *= static_cast<float>(cosine_band_factor(l));
  }
  return result;
}

vec3 irradiance(const RadianceSh& radiance, const vec3& normal) {
  const int degree = radiance.degree();
  if (degree < 0) return vec3(0);
  std::array<float, max_coefficient_count> basis;
  eval_basis(degree, normal, basis);
  vec3 sum(0);
  for (int l = 0; l <= degree; ++l) {
    const auto factor = static_cast<float>(cosine_band_factor(l));
    if (factor == 0) continue;
    for (int m = -l; m <= l; ++m) {
      const int k = coefficient_index(l, m);
      sum += factor * basis[k] * radiance[k];
    }
  }
  return sum;
}

vec3 irradiance_polynomial(const RadianceSh& radiance, const vec3& n) {
  const std::array<vec3, 9> l = first_bands(radiance);
  return c1 * l[8] * (n.x * n.x - n.y * n.y) + c3 * l[6] * (n.z * n.z) + c4 * l[0] - c5 * l[6] +
         2 * c1 * (l[4] * (n.x * n.y) + l[7] * (n.x * n.z) + l[5] * (n.y * n.z)) +
         2 * c2 * (l[3] * n.x + l[1] * n.y + l[2] * n.z);
}

IrradianceMatrices irradiance_matrices(const RadianceSh& radiance) {
  const std::array<vec3, 9> l = first_bands(radiance);
  IrradianceMatrices matrices;
  for (int c = 0; c < 3; ++c) {
    const auto at = [&](std::size_t k) { return l[k][c]; };
    matrices.channel[c] = mat4(vec4(c1 * at(8), c1 * at(4), c1 * at(7), c2 * at(3)),
                               vec4(c1 * at(4), -c1 * at(8), c1 * at(5), c2 * at(1)),
                               vec4(c1 * at(7), c1 * at(5), c3 * at(6), c2 * at(2)),
                               vec4(c2 * at(3), c2 * at(1), c2 * at(2), c4 * at(0) - c5 * at(6)));
  }
  return matrices;
}

vec3 irradiance(const IrradianceMatrices& matrices, const vec3& normal) {
  const vec4 n(normal, 1);
  return {glm::dot(n, matrices.channel[0] * n), glm::dot(n, matrices.channel[1] * n),
          glm::dot(n, matrices.channel[2] * n)};
}

}  // namespace ssphh::sh
