#pragma once
/// Burley's diffuse model ("Physically-based shading at Disney", SIGGRAPH 2012 course, §5.3):
/// retro-reflection that grows with roughness. As published it reflects up to 1.56 ρ; here it is divided by
/// its largest directional albedo where that exceeds 1.

#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::shading {

/// (1 − c)⁵ of Schlick's Fresnel approximation.
inline float schlick_weight(float c) {
  const float m = glm::clamp(1 - c, 0.0f, 1.0f);
  const float m2 = m * m;
  return m2 * m2 * m;
}

/// Largest directional albedo of the published model, at least 1. At grazing view (with k = 1/2 + roughness)
/// and at normal view it is a closed integral over the hemisphere; around roughness 1/2, where these are
/// equal, the largest lies at an angle in between and up to 2 % higher.
inline float disney_diffuse_peak(float roughness) {
  const float k = 0.5f + roughness;
  const float grazing = k + (k * k - k) / 21 + 11 * roughness * roughness / 504;
  const float normal = 1 + (roughness - 0.5f) / 21 + roughness / 84;
  const float between = 0.02f * glm::max(0.0f, 1 - 12 * std::abs(roughness - 0.5f));
  return glm::max(1.0f, glm::max(grazing, normal)) + between;
}

/// f · cos θ_i for ρ = 1. `roughness` in [0, 1]. Reciprocal.
inline float disney_diffuse(float roughness, const vec3& wo, const vec3& wi) {
  const float cos_d2 = 0.5f * (1 + glm::dot(wo, wi));  // cos² of the angle between wi and the half vector
  const float rise = 2 * roughness * cos_d2 - 0.5f;    // F_D90 − 1
  const float shape = (1 + rise * schlick_weight(wo.z)) * (1 + rise * schlick_weight(wi.z));
  return wi.z * shape / (pi * disney_diffuse_peak(roughness));
}

}  // namespace ssphh::shading
