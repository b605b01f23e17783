#pragma once
/// GGX microfacet reflection (Trowbridge and Reitz 1975; Walter et al. 2007), isotropic, height-correlated
/// Smith masking-shadowing (Heitz 2014), sampled by visible normals (Heitz 2018; drawn with the spherical
/// caps of Dupuy and Benyoub 2023, the same distribution). Local frame, z the normal. All values without
/// Fresnel.

#include <cmath>

#include <ssphh/core/sphere.h>

namespace ssphh::shading {

/// D(h) [sr⁻¹]; ∫ D cos θ_h dω_h = 1. Uses sin² of h so that it stays exact for small α.
inline float ggx_distribution(float alpha, const vec3& h) {
  const float a2 = alpha * alpha;
  const float t = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (pi * t * t);
}

/// √(cos² + α² sin²), the root in Smith's Λ.
inline float ggx_root(float alpha, float c) {
  const float a2 = alpha * alpha;
  return std::sqrt(a2 + (1 - a2) * c * c);
}

/// D G₂ / (4 cos θ_o): f · cos θ_i for a Fresnel term of 1.
inline float ggx(float alpha, const vec3& wo, const vec3& wi, const vec3& h) {
  const float visibility = 0.5f / (wi.z * ggx_root(alpha, wo.z) + wo.z * ggx_root(alpha, wi.z));
  return ggx_distribution(alpha, h) * visibility * wi.z;
}

/// Density of wi reflected at a visible normal: G₁(wo) D(h) / (4 cos θ_o).
inline float ggx_pdf(float alpha, const vec3& wo, const vec3& h) {
  return ggx_distribution(alpha, h) / (2 * (wo.z + ggx_root(alpha, wo.z)));
}

/// A normal visible from wo (wo.z > 0).
inline vec3 sample_ggx_normal(float alpha, const vec3& wo, const vec2& u) {
  // Stretch the view to the hemisphere configuration
  const vec3 v = glm::normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));

  // Sample the spherical cap of reflected directions
  const float z = (1 - u.x) * (1 + v.z) - v.z;
  const float r = std::sqrt(glm::clamp(1 - z * z, 0.0f, 1.0f));
  const vec3 h = vec3(r * unit_circle(u.y), z) + v;

  // Back to the ellipsoid
  return glm::normalize(vec3(alpha * h.x, alpha * h.y, glm::max(h.z, 1e-7f)));
}

}  // namespace ssphh::shading
