#include "albedo_table.h"

#include "specular.h"

namespace ssphh::shading {
namespace {

/// (A, B) by a lattice of visible GGX normals, which suits both models: Blinn–Phong's tail is the shorter. No
/// two points have the same polar angle: where wo is the normal all of a ring goes below the surface at once.
vec2 integrate_lobe(bool phong, float alpha, const vec3& wo) {
  constexpr int points = 377, stride = 233;  // neighbours in Fibonacci's sequence
  vec2 sum(0);
  for (int i = 0; i < points; ++i) {
    // Half of the azimuths do: the lobe is symmetric about the plane of wo
    const vec2 u((static_cast<float>(i) + 0.5f) / points,
                 (static_cast<float>(i * stride % points) + 0.5f) / (2 * points));
    const vec3 h = sample_ggx_normal(alpha, wo, u);
    const float cos_h = glm::dot(wo, h);
    const vec3 wi = 2 * cos_h * h - wo;
    if (wi.z <= 0 || cos_h <= 0) continue;
    const float value = phong ? blinn_phong(alpha, wo, wi, h) : ggx(alpha, wo, wi, h);
    const float weight = value / ggx_pdf(alpha, wo, h);
    const float s = schlick_weight(cos_h);
    sum += weight * vec2(1 - s, s);
  }
  return sum / static_cast<float>(points);
}

}  // namespace

AlbedoTable::AlbedoTable(bool phong) {
  const float step = 1.0f / (size - 1);
  for (int r = 0; r < size; ++r) {
    vec2* row = values_[r].data();
    const float alpha = alpha_of_roughness(static_cast<float>(r) * step);
    for (int m = 0; m < size; ++m) {
      const float mu = glm::max(static_cast<float>(m) * step, 1e-3f);
      row[m] = integrate_lobe(phong, alpha, vec3(std::sqrt(1 - mu * mu), 0, mu));
    }
    // 2 ∫ E μ dμ of the piecewise linear E
    vec2 mean(0);
    for (int m = 0; m + 1 < size; ++m) {
      const float mu = static_cast<float>(m) * step;
      const vec2 slope = row[m + 1] - row[m];
      mean += 2 * step * (row[m] * (mu + step / 2) + slope * (mu / 2 + step / 3));
    }
    means_[r] = mean;
  }
}

const AlbedoTable& albedo_table(bool phong) {
  // Each at its own first use: few scenes have both models
  if (phong) {
    static const AlbedoTable phong_table(true);
    return phong_table;
  }
  static const AlbedoTable ggx_table(false);
  return ggx_table;
}

}  // namespace ssphh::shading
