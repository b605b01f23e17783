#pragma once
/// Blinn–Phong as a microfacet model: D = (n + 2)/2π cosⁿθ_h, which is normalised so that ∫ D cos θ_h dω_h =
/// 1, with exponent n = 2/α² − 2 and height-correlated Smith masking-shadowing. Never reflects more than its
/// Fresnel term, and becomes a mirror as α → 0 at every angle, unlike the (n + 8)/8π form, which loses cos²θ.
/// Local frame, z the normal. All values without Fresnel.

#include <cmath>

#include <ssphh/core/math.h>

#include "ggx.h"

namespace ssphh::shading {

inline float blinn_phong_exponent(float alpha) {
  return 2 / (alpha * alpha) - 2;
}

inline float blinn_phong_distribution(float alpha, const vec3& h) {
  const float n = blinn_phong_exponent(alpha);
  const float sin2 = glm::min(h.x * h.x + h.y * h.y, 0.9999999f);
  return (n + 2) / (2 * pi) * std::exp(0.5f * n * std::log1p(-sin2));
}

/// Smith's Λ of a direction with cosine c. The distribution lies between Beckmann's, which it becomes for α →
/// 0 (Walter et al., Microfacet Models for Refraction, 2007, §5.2), and GGX, which it is for α = 1; so does
/// Λ, with a weight that was fitted to its integral (within 2 %, see the tests).
inline float blinn_phong_lambda(float alpha, float c) {
  const float a = c / (alpha * std::sqrt(glm::max(1 - c * c, 1e-12f)));
  const float beckmann = a >= 1.6f ? 0 : (1 - 1.259f * a + 0.396f * a * a) / (a * (3.535f + 2.181f * a));
  const float a2 = alpha * alpha;
  const float ggx_lambda = 0.5f * (ggx_root(alpha, c) / c - 1);
  return glm::mix(beckmann, ggx_lambda, a2 * (0.54f + 0.46f * a2 * a2));
}

/// D G₂ / (4 cos θ_o): f · cos θ_i for a Fresnel term of 1.
inline float blinn_phong(float alpha, const vec3& wo, const vec3& wi, const vec3& h) {
  const float g = 1 / (1 + blinn_phong_lambda(alpha, wo.z) + blinn_phong_lambda(alpha, wi.z));
  return blinn_phong_distribution(alpha, h) * g / (4 * wo.z);
}

/// Density of wi reflected at a normal drawn from D cos θ_h.
inline float blinn_phong_pdf(float alpha, const vec3& wo, const vec3& h) {
  return blinn_phong_distribution(alpha, h) * h.z / (4 * glm::max(glm::dot(wo, h), 1e-7f));
}

inline vec3 sample_blinn_phong_normal(float alpha, const vec2& u) {
  // cos θ = (1 − u)^(1/(n+2)); 1/(n+2) = α²/2
  const float log_cos2 = std::log1p(-u.x) * alpha * alpha;
  const float sin_theta = std::sqrt(-std::expm1(log_cos2));
  return {sin_theta * unit_circle(u.y), std::exp(0.5f * log_cos2)};
}

}  // namespace ssphh::shading
