#include <algorithm>
#include <cmath>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/quadrature.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::sh {
namespace {

// P_0..P_degree(x), at most max_degree.
std::array<double, max_degree + 1> legendre(int degree, double x) {
  std::array<double, max_degree + 1> p{};
  p[0] = 1;
  if (degree >= 1) p[1] = x;
  for (int l = 2; l <= degree; ++l) {
    const auto i = static_cast<std::size_t>(l);
    p[i] = ((2 * l - 1) * x * p[i - 1] - (l - 1) * p[i - 2]) / l;
  }
  return p;
}

double zonal_norm(int l) {
  return std::sqrt((2 * l + 1) / (4 * pi_d));
}

int zonal_degree(const ZonalSh& zonal) {
  const int degree = static_cast<int>(zonal.size()) - 1;
  require_degree(degree, "zonal harmonics");
  return degree;
}

constexpr int roughness_steps = 128;
using GlossyTable = std::array<std::array<float, max_degree + 1>, roughness_steps + 1>;

// λ_0..λ_max_degree of the GGX lobe. With x = tan²θ_h the half vector's density is α²/(α² + x)² dx on θ_h ≤
// 45°, where the reflected direction leaves the hemisphere. x = α² (e^s − 1) flattens it to e^{−s} ds: smooth
// for every α.
std::array<double, max_degree + 1> ggx_band_scales(double alpha) {
  static const LineQuadrature rule = gauss_legendre(64);
  const double alpha2 = alpha * alpha, length = std::log1p(1 / alpha2);
  std::array<double, max_degree + 1> sums{};
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double s = 0.5 * length * (rule.nodes[i] + 1);
    const double x = alpha2 * std::expm1(s);
    const double cos_theta = (1 - x) / (1 + x);  // θ = 2 θ_h
    const double weight = rule.weights[i] * std::exp(-s) * cos_theta;
    const auto p = legendre(max_degree, cos_theta);
    for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += weight * p[l];
  }
  for (std::size_t l = sums.size(); l-- > 0;) sums[l] /= sums[0];
  return sums;
}

GlossyTable make_glossy_table() {
  GlossyTable table{};
  table[0].fill(1);
  for (int i = 1; i <= roughness_steps; ++i) {
    const double roughness = static_cast<double>(i) / roughness_steps;
    const auto scales = ggx_band_scales(roughness * roughness);
    std::ranges::transform(scales, table[i].begin(), [](double scale) { return static_cast<float>(scale); });
  }
  return table;
}

}  // namespace

ZonalSh zonal_from_function(int degree, const std::function<double(double)>& f, double from, int nodes) {
  require_degree(degree, "zonal harmonics");
  require(from >= -1 && from < 1, "zonal harmonics", "the interval must begin in [-1, 1)");
  require(f != nullptr, "zonal harmonics", "there is no function to project");
  const LineQuadrature rule = gauss_legendre(nodes);
  const double half = 0.5 * (1 - from);
  ZonalSh zonal(static_cast<std::size_t>(degree) + 1, 0.0);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = from + half * (rule.nodes[i] + 1);
    const double weight = 2 * pi_d * half * rule.weights[i] * f(x);
    const auto p = legendre(degree, x);
    for (int l = 0; l <= degree; ++l) {
      zonal[l] += weight * zonal_norm(l) * p[l];
    }
  }
  return zonal;
}

ZonalSh zonal_cosine_lobe(int degree) {
  require_degree(degree, "zonal harmonics");
  ZonalSh zonal;
  for (int l = 0; l <= degree; ++l) zonal.push_back(cosine_band_factor(l) * zonal_norm(l));
  return zonal;
}

double eval_zonal(const ZonalSh& zonal, double cos_theta) {
  const int degree = zonal_degree(zonal);
  const auto p = legendre(degree, cos_theta);
  double sum = 0;
  for (int l = 0; l <= degree; ++l) {
    sum += zonal[l] * zonal_norm(l) * p[l];
  }
  return sum;
}

void rotate_zonal(const ZonalSh& zonal, const vec3& axis, std::span<float> out) {
  const int degree = zonal_degree(zonal);
  eval_basis(degree, axis, out);
  for (int l = 0; l <= degree; ++l) {
    const auto factor = static_cast<float>(zonal[l] / zonal_norm(l));
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) out[k] *= factor;
  }
}

RadianceSh convolve(const RadianceSh& sh, const ZonalSh& kernel) {
  RadianceSh result = sh;
  for (int l = 0; l <= sh.degree(); ++l) {
    const auto i = static_cast<std::size_t>(l);
    const auto factor = i < kernel.size() ? static_cast<float>(kernel[i] / zonal_norm(l)) : 0.0f;
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) result[k] *= factor;
  }
  return result;
}

double ggx_band_scale(double alpha, int l) {
  require_degree(l, "glossy band scale");
  require(alpha > 0, "glossy band scale", "alpha must be over 0");
  return ggx_band_scales(alpha)[l];
}

double gaussian_band_scale(double sigma, int l) {
  return std::exp(-0.5 * l * (l + 1) * sigma * sigma);
}

std::array<float, max_degree + 1> glossy_band_scales(float roughness) {
  static const GlossyTable table = make_glossy_table();
  const float place =
      (roughness > 0 ? std::min(roughness, 1.0f) : 0.0f) * roughness_steps;  // NaN counts as 0
  const int first = std::min(static_cast<int>(place), roughness_steps - 1);
  const float t = place - static_cast<float>(first);
  const auto &a = table[first], &b = table[static_cast<std::size_t>(first) + 1];
  std::array<float, max_degree + 1> scales;
  for (std::size_t l = 0; l < scales.size(); ++l) scales[l] = a[l] + t * (b[l] - a[l]);
  return scales;
}

vec3 eval_glossy(const RadianceSh& radiance, const vec3& mirror, float roughness) {
  const int degree = radiance.degree();
  if (degree < 0) return vec3(0);
  std::array<float, max_coefficient_count> basis;
  eval_basis(degree, mirror, basis);
  const auto scales = glossy_band_scales(roughness);
  vec3 sum(0);
  for (int l = 0; l <= degree; ++l) {
    vec3 band(0);
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) {
      band += basis[k] * radiance[k];
    }
    sum += scales[l] * band;
  }
  return sum;
}

}  // namespace ssphh::sh
